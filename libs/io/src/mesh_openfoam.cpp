// OpenFOAM's polyMesh (User Guide, "Mesh description"): faces with their owner and neighbour cells, inner
// ones first and in upper-triangular order, then one range of faces for each patch. Metres.

#include "mesh_formats.h"
#include "mesh_text.h"

#include "ostia/geometry/faces.h"

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

constexpr double metres = 1e-3;

void put_header(TextFile& out, const char* type, const char* object, const std::string& note = {}) {
  out << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " << type << ";\n";
  if (!note.empty()) out << "    note        \"" << note << "\";\n";
  out << "    location    \"constant/polyMesh\";\n    object      " << object << ";\n}\n\n";
}

void put_face(TextFile& out, const std::array<std::int32_t, 4>& corners) {
  out << (corners[3] < 0 ? "3(" : "4(") << corners[0] << ' ' << corners[1] << ' ' << corners[2];
  if (corners[3] >= 0) out << ' ' << corners[3];
  out << ")\n";
}

/// The boundary's faces, patch by patch.
std::vector<ElementSide> boundary_sides(const PreparedMesh& mesh) {
  std::vector<ElementSide> sides;
  for (const PreparedMesh::Facets& facets : mesh.facets) {
    for (const Shape shape : facet_shapes) {
      for (const std::int32_t facet : facets.of(shape)) sides.push_back(mesh.parent(shape, facet));
    }
  }
  return sides;
}

void write_points(const PreparedMesh& mesh, const fs::path& file) {
  TextFile out(file);
  put_header(out, "vectorField", "points");
  out << mesh.mesh.points.size() << "\n(\n";
  for (const geometry::Vec3& p : mesh.mesh.points)
    out << '(' << p[0] * metres << ' ' << p[1] * metres << ' ' << p[2] * metres << ")\n";
  out << ")\n";
  out.close();
}

void write_faces(const PreparedMesh& mesh, const std::vector<ElementSide>& boundary, const fs::path& folder) {
  const std::string note = "nPoints:" + std::to_string(mesh.mesh.points.size()) +
                           "  nCells:" + std::to_string(mesh.elements()) +
                           "  nFaces:" + std::to_string(mesh.inner.size() + boundary.size()) +
                           "  nInternalFaces:" + std::to_string(mesh.inner.size());
  TextFile faces(folder / "faces"), owner(folder / "owner"), neighbour(folder / "neighbour");
  put_header(faces, "faceList", "faces");
  put_header(owner, "labelList", "owner", note);
  put_header(neighbour, "labelList", "neighbour", note);
  faces << mesh.inner.size() + boundary.size() << "\n(\n";
  owner << mesh.inner.size() + boundary.size() << "\n(\n";
  neighbour << mesh.inner.size() << "\n(\n";
  for (const InnerSide& side : mesh.inner) {
    put_face(faces, mesh.corners(side.first));
    owner << side.first.element << '\n';
    neighbour << side.second.element << '\n';
  }
  for (const ElementSide& side : boundary) {
    put_face(faces, mesh.corners(side));
    owner << side.element << '\n';
  }
  for (TextFile* out : {&faces, &owner, &neighbour}) {
    *out << ")\n";
    out->close();
  }
}

void write_boundary(const PreparedMesh& mesh, const fs::path& file) {
  TextFile out(file);
  put_header(out, "polyBoundaryMesh", "boundary");
  out << mesh.facets.size() << "\n(\n";
  std::size_t start = mesh.inner.size();
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const bool wall = is_wall(mesh.mesh.faces[f]);
    out << "    " << mesh.names[f] << "\n    {\n        type            " << (wall ? "wall" : "patch")
        << ";\n        nFaces          " << mesh.facets[f].size() << ";\n        startFace       " << start
        << ";\n    }\n";
    start += mesh.facets[f].size();
  }
  out << ")\n";
  out.close();
}

/// A zone of the tetrahedra of layers.
void write_layers(const PreparedMesh& mesh, const fs::path& file) {
  TextFile out(file);
  put_header(out, "regIOobject", "cellZones");
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
  const fs::path poly_mesh = folder / "constant" / "polyMesh";
  make_folders(poly_mesh);
  write_points(mesh, poly_mesh / "points");
  write_faces(mesh, boundary_sides(mesh), poly_mesh);
  write_boundary(mesh, poly_mesh / "boundary");
  if (mesh.layer_tetrahedra > 0) write_layers(mesh, poly_mesh / "cellZones");
}

}  // namespace ostia::io
