#pragma once
/// \file Folders above a file or folder that is about to be written.

#include <filesystem>
#include <vector>

namespace ostia::core {

/// The folder itself where it is there, else the nearest one above it that is; "." for a relative path.
std::filesystem::path nearest_there(const std::filesystem::path& folder);

/// Makes a folder and those above it that are not there. Unless `keep` is called they are removed again,
/// those that are empty.
class MadeParents {
 public:
  /// Throws IoError that names the folder which cannot be made.
  explicit MadeParents(const std::filesystem::path& folder);
  ~MadeParents();
  MadeParents(const MadeParents&) = delete;
  MadeParents& operator=(const MadeParents&) = delete;
  void keep() { made_.clear(); }

 private:
  void remove_empty();
  std::vector<std::filesystem::path> made_;  ///< the uppermost first
};

}  // namespace ostia::core
