#include "ostia/imaging/files_below.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <string>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_files = 200'000;
constexpr int most_folders = 32;

}  // namespace

std::vector<fs::path> files_below(const fs::path& folder, bool recursive) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
  if (error) throw IoError("cannot read folder '" + folder.string() + "': " + error.message());
  for (; at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (error) throw IoError("cannot read folder '" + folder.string() + "': " + error.message());
    if (at->is_directory(error)) {
      if (!recursive || at.depth() >= most_folders) at.disable_recursion_pending();
      continue;
    }
    if (!at->is_regular_file(error)) continue;
    if (files.size() == most_files) {
      throw InvalidInput("folder '" + folder.string() + "' holds more than " + std::to_string(most_files) +
                         " files; choose a smaller one");
    }
    files.push_back(at->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace ostia::imaging
