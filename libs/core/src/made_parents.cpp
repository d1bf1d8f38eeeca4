#include "made_parents.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <system_error>

namespace ostia::core {
namespace fs = std::filesystem;
namespace {

fs::path above(const fs::path& folder) {
  return folder.has_parent_path() && folder.parent_path() != folder ? folder.parent_path() : fs::path(".");
}

}  // namespace

fs::path nearest_there(const fs::path& folder) {
  std::error_code error;
  fs::path there = folder;
  while (!fs::exists(there, error)) there = above(there);
  return there;
}

MadeParents::MadeParents(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path one = folder; !fs::exists(one, error); one = above(one)) missing.push_back(one);
  for (auto one = missing.rbegin(); one != missing.rend(); ++one) {
    if (fs::create_directory(*one, error)) made_.push_back(*one);
    if (fs::is_directory(*one)) continue;  // perhaps another program made it just now
    remove_empty();
    throw IoError("cannot make the folder " + one->string() + ": " + error.message());
  }
}

MadeParents::~MadeParents() {
  remove_empty();
}

void MadeParents::remove_empty() {
  std::error_code ignored;
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
  made_.clear();
}

}  // namespace ostia::core
