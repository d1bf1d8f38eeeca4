#include "ostia/pipeline/exported_meshes.h"

#include <algorithm>

namespace ostia::pipeline {
namespace fs = std::filesystem;

std::vector<ExportedMesh> exported_meshes(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return {{{}, path}};
  if (fs::is_regular_file(path / "mesh.vtu", error)) return {{{}, path / "mesh.vtu"}};
  std::vector<ExportedMesh> found;
  for (fs::directory_iterator at(path, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    const fs::path mesh = at->path() / "mesh.vtu";
    if (fs::is_regular_file(mesh, ignored)) found.push_back({at->path().filename().string(), mesh});
  }
  std::sort(found.begin(), found.end(),
            [](const ExportedMesh& a, const ExportedMesh& b) { return a.name < b.name; });
  return found;
}

}  // namespace ostia::pipeline
