#include "ostia/session/image_digest.h"

#include "ostia/core/path_digest.h"

namespace ostia::session {

ImageReference image_reference(const std::filesystem::path& path, const core::TaskContext& task) {
  const std::string sha256 = core::sha256_of_path(path, task);
  return {sha256, "image-" + sha256.substr(0, 8)};
}

}  // namespace ostia::session
