#pragma once
/// \file A folder of this process alone.

#include <filesystem>

namespace ostia::core {

/// A folder in the system's temporary folder that nobody else may read, gone with this object: for what may
/// hold a patient's data on the way to a child process or a library.
class PrivateFolder {
 public:
  PrivateFolder();  ///< throws IoError where none can be made
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ostia::core
