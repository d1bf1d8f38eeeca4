#pragma once
/// \file Whose images this machine has shown: what a list of recent cases needs to be read by a person. It
/// stands here and in no case.

#include "ostia/imaging/series_preview.h"

#include <filesystem>
#include <optional>
#include <string>

namespace ostia::session {

/// A file `patients.json` in a folder, for this user alone (0600), replaced whole or not at all; beside
/// machine.json and not in it, so that that one can be shown to others. Not safe from several threads at
/// once.
class KnownPatients {
 public:
  static constexpr std::size_t most = 1000;

  /// Writes nothing yet; the folder is made by the first change.
  explicit KnownPatients(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Nothing for an image that is not known, and where the file cannot be read.
  std::optional<imaging::ShownIdentity> find(const std::string& image_sha256) const;
  /// An image that says of nobody is not kept; beyond `most` those seen longest ago go. A file that is
  /// damaged begins anew. Throws IoError, ResourceError: the file is then what it was.
  void remember(const std::string& image_sha256, const imaging::ShownIdentity& whose);
  /// The file is gone. Throws IoError.
  void forget_all();

 private:
  std::filesystem::path file() const { return folder_ / "patients.json"; }
  std::filesystem::path folder_;
};

}  // namespace ostia::session
