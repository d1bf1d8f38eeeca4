#include "ostia/core/strays.h"

#include "part_names.h"

#include "ostia/core/files.h"

#include <algorithm>
#include <set>
#include <system_error>

namespace ostia::core {

namespace fs = std::filesystem;

std::vector<fs::path> strays_below(const fs::path& folder) {
  std::vector<fs::path> strays;
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (!of_dead_process(entry->path().filename().string())) continue;
    strays.push_back(entry->path());
    entry.disable_recursion_pending();  // all below goes with it
  }
  std::sort(strays.begin(), strays.end());
  return strays;
}

std::size_t remove_strays(const std::vector<fs::path>& strays) {
  std::set<fs::path> folders;
  for (const fs::path& stray : strays) folders.insert(stray.parent_path());
  for (const fs::path& folder : folders) remove_dead_parts(folder);
  std::error_code ignored;
  return static_cast<std::size_t>(std::count_if(strays.begin(), strays.end(), [&](const fs::path& stray) {
    return !fs::exists(fs::symlink_status(stray, ignored));
  }));
}

}  // namespace ostia::core
