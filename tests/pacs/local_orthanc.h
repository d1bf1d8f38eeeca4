#pragma once
/// \file Debian's Orthanc on this machine, for a test.

#include "ostia/pacs/server.h"

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace ostia::testing {

/// A port that was free a moment ago.
int free_port();
/// `key.pem` and `certificate.pem`, signed by itself, for the host "localhost".
void make_certificate(const std::filesystem::path& folder);

struct OrthancSetting {
  bool tls = false;  ///< of DICOM's protocol: Debian 12's Orthanc ends at the first request by https
  std::filesystem::path store{};  ///< where it keeps its images; empty: a folder of its own
};

/// Runs as long as this lives, with a user "ostia" of the password "open sesame" and DICOMweb; knows the
/// title "OSTIA" at `receive_port`.
class LocalOrthanc {
 public:
  static bool is_installed();
  explicit LocalOrthanc(const OrthancSetting& setting = {});
  ~LocalOrthanc();
  LocalOrthanc(const LocalOrthanc&) = delete;
  LocalOrthanc& operator=(const LocalOrthanc&) = delete;
  bool running() const { return process_ > 0; }
  std::string log() const;

  pacs::ServerDescription by_get() const, by_move() const, by_web() const;
  pacs::Secrets secrets() const { return {"open sesame", {}}; }
  void kill();  ///< as a power cut does

 private:
  pacs::ServerDescription by_dimse() const;
  bool answers(int port) const;
  std::filesystem::path folder_;
  bool tls_;
  int web_port_, dicom_port_, receive_port_;
  pid_t process_ = -1;
};

/// Skips by name where Orthanc is not installed.
#define OSTIA_REQUIRE_ORTHANC()                        \
  if (!::ostia::testing::LocalOrthanc::is_installed()) \
  GTEST_SKIP() << "needs Debian's orthanc and orthanc-dicomweb"

}  // namespace ostia::testing
