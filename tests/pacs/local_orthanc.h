#pragma once
/// \file Debian's Orthanc on this machine, for a test.

#include "relays.h"
#include "started_program.h"

#include "ostia/pacs/server.h"

#include <filesystem>
#include <memory>
#include <string>

namespace ostia::testing {

struct OrthancSetting {
  /// Of both transports. Debian 12's Orthanc ends at the first request by https: its web server
  /// (CivetWeb 1.15) looks for a function that OpenSSL 3 has under another name. So a relay takes TLS off
  /// before it.
  bool tls = false;
  std::filesystem::path store{};  ///< where it keeps its images; empty: a folder of its own
};

/// Runs as long as this lives, with a user "ostia" of the password "open sesame" and DICOMweb; knows the
/// title "OSTIA" at `receive_port`.
class LocalOrthanc {
 public:
  static bool is_installed();
  explicit LocalOrthanc(const OrthancSetting& setting = {});
  LocalOrthanc(const LocalOrthanc&) = delete;
  LocalOrthanc& operator=(const LocalOrthanc&) = delete;
  bool running() const { return program_ && program_->running(); }
  std::string log() const;
  int dicom_port() const { return dicom_port_; }
  int receive_port() const { return receive_port_; }
  /// Of its own programming interface, behind `by_web`: "http://localhost:8042".
  std::string rest_url() const;

  pacs::ServerDescription by_get() const, by_move() const, by_web() const;
  pacs::Secrets secrets() const { return {"open sesame", {}}; }
  void kill() { program_->kill(); }  ///< as a power cut does

 private:
  pacs::ServerDescription by_dimse() const;
  std::filesystem::path folder_;
  bool tls_;
  int web_port_, dicom_port_, receive_port_;
  std::unique_ptr<StartedProgram> program_;
  std::unique_ptr<TlsFront> front_;
};

/// Skips by name where Orthanc is not installed.
#define OSTIA_REQUIRE_ORTHANC()                        \
  if (!::ostia::testing::LocalOrthanc::is_installed()) \
  GTEST_SKIP() << "needs Debian's orthanc and orthanc-dicomweb"

}  // namespace ostia::testing
