#include "ostia/session/image_digest.h"

#include "ostia/core/path_digest.h"

namespace ostia::session {

namespace {

ImageReference named(const std::string& sha256) {
  return {sha256, "image-" + sha256.substr(0, 8)};
}

}  // namespace

ImageReference image_reference(const std::filesystem::path& path, const core::TaskContext& task) {
  return named(core::sha256_of_path(path, task));
}

ImageReference image_reference(const imaging::DicomSeries& series, const core::TaskContext& task) {
  return named(imaging::series_digest(series, task));
}

}  // namespace ostia::session
