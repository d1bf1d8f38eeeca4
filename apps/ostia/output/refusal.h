#pragma once
/// \file What is refused names the file.

#include "ostia/core/error.h"
#include "ostia/pipeline/source.h"

#include <filesystem>
#include <string>

namespace ostia::app {

/// "an image", "a mask", "a surface", "a DICOM series".
inline std::string with_article(pipeline::SourceKind kind) {
  return (kind == pipeline::SourceKind::image ? "an " : "a ") + name_of(kind);
}

/// The file's or folder's own name, "CT" of "scans/CT/" too.
inline std::string own_name(const std::filesystem::path& file) {
  return (file.has_filename() ? file : file.parent_path()).filename().string();
}

/// Does `work`. What it refuses is told with the name of the file that it was about in front and, where the
/// image or mask lacks what was looked for, with `way_out` behind; `besides` stands behind either. (Reading
/// refuses by name already.)
template <class Work>
auto naming(const std::filesystem::path& file, const Work& work, const std::string& way_out = "",
            const std::string& besides = "") {
  const std::string name = own_name(file) + ": ";
  try {
    return work();
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + error.what() + besides);
  } catch (const GeometryError& error) {
    throw GeometryError(name + error.what() + way_out + besides);
  }
}

}  // namespace ostia::app
