// OpenFOAM's polyMesh of tetrahedra and prisms.

#include "mesh/formats.h"
#include "mesh/poly_mesh.h"
#include "mesh/text.h"

#include "ostia/geometry/faces.h"

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

PolyMesh poly_mesh_of(const PreparedMesh& mesh) {
  PolyMesh out{mesh.mesh.points, mesh.elements(), {}, {}, {}, {}};
  for (const InnerSide& side : mesh.inner) {
    out.faces.push_back(mesh.corners(side.first));
    out.owner.push_back(side.first.element);
    out.neighbour.push_back(side.second.element);
  }
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    out.patches.push_back({mesh.names[f], is_wall(mesh.mesh.faces[f]), mesh.facets[f].size()});
    for (const Shape shape : facet_shapes)
      for (const std::int32_t facet : mesh.facets[f].of(shape)) {
        const ElementSide side = mesh.parent(shape, facet);
        out.faces.push_back(mesh.corners(side));
        out.owner.push_back(side.element);
      }
  }
  return out;
}

/// A zone of the tetrahedra of layers.
void write_layers(const PreparedMesh& mesh, const fs::path& file) {
  TextFile out(file);
  put_foam_header(out, "regIOobject", "cellZones");
  out << "1\n(\n    " << mesh.title << layers_suffix << "\n    {\n        type            cellZone;\n"
      << "        cellLabels      List<label>\n"
      << mesh.layer_tetrahedra << "\n(\n";
  for (std::size_t i = 0; i < mesh.layer_tetrahedra; ++i)
    out << mesh.mesh.tetrahedra.size() - mesh.layer_tetrahedra + i << '\n';
  out << ")\n;\n    }\n)\n";
  out.close();
}

}  // namespace

void write_openfoam(const PreparedMesh& mesh, const fs::path& folder) {
  const fs::path poly_mesh = write_poly_mesh(poly_mesh_of(mesh), folder);
  if (mesh.layer_tetrahedra > 0) write_layers(mesh, poly_mesh / "cellZones");
}

}  // namespace ostia::io
