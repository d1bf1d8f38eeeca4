#include "mesh/poly_mesh.h"

#include "mesh/text.h"

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

constexpr double metres = 1e-3;

void put_face(TextFile& out, const std::array<std::int32_t, 4>& corners) {
  out << (corners[3] < 0 ? "3(" : "4(") << corners[0] << ' ' << corners[1] << ' ' << corners[2];
  if (corners[3] >= 0) out << ' ' << corners[3];
  out << ")\n";
}

void write_points(const PolyMesh& mesh, const fs::path& file) {
  TextFile out(file);
  put_foam_header(out, "vectorField", "points");
  out << mesh.points.size() << "\n(\n";
  for (const geometry::Vec3& p : mesh.points)
    out << '(' << p[0] * metres << ' ' << p[1] * metres << ' ' << p[2] * metres << ")\n";
  out << ")\n";
  out.close();
}

void write_faces(const PolyMesh& mesh, const fs::path& file) {
  TextFile out(file);
  put_foam_header(out, "faceList", "faces");
  out << mesh.faces.size() << "\n(\n";
  for (const auto& face : mesh.faces) put_face(out, face);
  out << ")\n";
  out.close();
}

void write_labels(const PolyMesh& mesh, const std::vector<std::int32_t>& labels, const char* object,
                  const fs::path& file) {
  TextFile out(file);
  put_foam_header(out, "labelList", object,
                  "nPoints:" + std::to_string(mesh.points.size()) + "  nCells:" + std::to_string(mesh.cells) +
                      "  nFaces:" + std::to_string(mesh.faces.size()) +
                      "  nInternalFaces:" + std::to_string(mesh.neighbour.size()));
  out << labels.size() << "\n(\n";
  for (const std::int32_t label : labels) out << label << '\n';
  out << ")\n";
  out.close();
}

void write_boundary(const PolyMesh& mesh, const fs::path& file) {
  TextFile out(file);
  put_foam_header(out, "polyBoundaryMesh", "boundary");
  out << mesh.patches.size() << "\n(\n";
  std::size_t start = mesh.neighbour.size();
  for (const PolyMesh::Patch& patch : mesh.patches) {
    out << "    " << patch.name << "\n    {\n        type            " << (patch.wall ? "wall" : "patch")
        << ";\n        nFaces          " << patch.faces << ";\n        startFace       " << start
        << ";\n    }\n";
    start += patch.faces;
  }
  out << ")\n";
  out.close();
}

}  // namespace

void put_foam_header(TextFile& out, const char* type, const char* object, const std::string& note) {
  out << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " << type << ";\n";
  if (!note.empty()) out << "    note        \"" << note << "\";\n";
  out << "    location    \"constant/polyMesh\";\n    object      " << object << ";\n}\n\n";
}

fs::path write_poly_mesh(const PolyMesh& mesh, const fs::path& case_folder) {
  const fs::path folder = case_folder / "constant" / "polyMesh";
  make_folders(folder);
  write_points(mesh, folder / "points");
  write_faces(mesh, folder / "faces");
  write_labels(mesh, mesh.owner, "owner", folder / "owner");
  write_labels(mesh, mesh.neighbour, "neighbour", folder / "neighbour");
  write_boundary(mesh, folder / "boundary");
  return folder;
}

}  // namespace ostia::io
