#include "output/outputs.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace ostia::app {

bool has_extension(const std::filesystem::path& path, const std::vector<std::string_view>& extensions) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::any_of(extensions.begin(), extensions.end(), [&](std::string_view extension) {
    return name.size() > extension.size() && name.ends_with(extension);
  });
}

void require_output(const std::filesystem::path& path, const std::vector<std::string_view>& extensions) {
  if (path.empty()) return;
  if (!has_extension(path, extensions)) {
    std::string known;
    for (const std::string_view one : extensions) known += (known.empty() ? "" : ", ") + std::string(one);
    throw UsageError("cannot write " + path.string() + ": its name must end in one of " + known);
  }
  const core::StagedFile probe(path);  // throws where nothing can be written; leaves nothing behind
}

}  // namespace ostia::app
