#include "replaced_folder.h"

#include "ostia/core/error.h"

namespace ostia::io {
namespace fs = std::filesystem;

void require_nothing_lost(const fs::path& staged, const fs::path& path, const std::string& what) {
  if (!fs::is_directory(path)) return;
  for (const auto& found : fs::recursive_directory_iterator(path))
    if (const fs::path inside = found.path().lexically_relative(path); !fs::exists(staged / inside))
      throw InvalidInput(what + " to " + path.string() + ": the folder holds " + inside.string() +
                         ", which would be lost; name a new folder");
}

}  // namespace ostia::io
