// One binary STL for each face.

#include "ostia/geometry/stl.h"

#include "mesh/formats.h"
#include "mesh/text.h"

#include "ostia/geometry/mixed_mesh_split.h"

namespace ostia::io {

void write_stl_faces(const PreparedMesh& mesh, const std::filesystem::path& folder) {
  geometry::TriMesh surface{mesh.mesh.points, {}};
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    surface.triangles.clear();
    for (const std::int32_t t : mesh.facets[f].triangles)
      surface.triangles.push_back(mesh.mesh.triangles[static_cast<std::size_t>(t)]);
    for (const std::int32_t q : mesh.facets[f].quads) {
      for (const geometry::Triangle& t : geometry::split_quad(mesh.mesh.quads[static_cast<std::size_t>(q)]))
        surface.triangles.push_back(t);
    }
    write_whole(folder / (mesh.names[f] + ".stl"), geometry::binary_stl(surface));
  }
}

}  // namespace ostia::io
