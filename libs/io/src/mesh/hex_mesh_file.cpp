#include "ostia/io/hex_mesh_file.h"

#include "mesh/poly_mesh.h"
#include "mesh/text.h"
#include "replaced_folder.h"
#include "vtk/xml.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/faces.h"
#include "ostia/io/mesh_export.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <string>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::HexMesh;
using geometry::Quad;

/// A side of a hexahedron, or one of the boundary (cell -1), by its corners.
struct Side {
  Quad key{};      ///< ascending
  Quad corners{};  ///< out of the cell
  std::int32_t cell = -1;
  std::int32_t face = -1;  ///< of the boundary: place of its face
};

Side side_of(const Quad& corners, std::int32_t cell, std::int32_t face) {
  Side side{corners, corners, cell, face};
  std::sort(side.key.begin(), side.key.end());
  return side;
}

std::vector<Side> all_sides(const HexMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(6 * mesh.hexahedra.size() + mesh.quads.size());
  for (std::size_t h = 0; h < mesh.hexahedra.size(); ++h)
    for (const auto& side : geometry::hexahedron_sides) {
      Quad q{};
      for (std::size_t k = 0; k < 4; ++k) q[k] = mesh.hexahedra[h][static_cast<std::size_t>(side[k])];
      sides.push_back(side_of(q, static_cast<std::int32_t>(h), -1));
    }
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const auto face = std::find_if(mesh.faces.begin(), mesh.faces.end(),
                                   [&](const geometry::Face& f) { return f.id == mesh.quad_face_ids[i]; });
    if (face == mesh.faces.end())
      throw InvalidInput("cannot write the hexahedra: no face has the id " +
                         std::to_string(mesh.quad_face_ids[i]));
    sides.push_back(side_of(mesh.quads[i], -1, static_cast<std::int32_t>(face - mesh.faces.begin())));
  }
  // Of two with the same corners the first cell's comes first, and the boundary's last.
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
  return sides;
}

/// The same way round, whatever corner comes first.
bool same_turn(const Quad& a, Quad b) {
  std::rotate(b.begin(), std::find(b.begin(), b.end(), a[0]), b.end());
  return a == b;
}

struct Faces {
  struct Inner {
    std::int32_t owner, neighbour;
    Quad corners;
  };
  std::vector<Inner> inner;    ///< by owner, then by neighbour
  std::vector<Side> boundary;  ///< with their cells; by face, then by cell
};

Faces faces_of(const HexMesh& mesh) {
  const std::vector<Side> sides = all_sides(mesh);
  Faces out;
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    if (i + 1 == sides.size() || sides[i].key != sides[i + 1].key || sides[i].cell < 0 ||
        (i + 2 < sides.size() && sides[i + 2].key == sides[i].key))
      throw InvalidInput("cannot write the hexahedra: their free sides are not the boundary");
    const Side &first = sides[i], &second = sides[i + 1];
    const Quad back{second.corners[3], second.corners[2], second.corners[1], second.corners[0]};
    if (!same_turn(first.corners, second.cell < 0 ? second.corners : back))
      throw InvalidInput("cannot write the hexahedra: two that meet, or the boundary, are turned inside out");
    if (second.cell >= 0)
      out.inner.push_back({first.cell, second.cell, first.corners});
    else
      out.boundary.push_back({first.key, first.corners, first.cell, second.face});
  }
  std::sort(out.inner.begin(), out.inner.end(), [](const auto& a, const auto& b) {
    return a.owner != b.owner ? a.owner < b.owner : a.neighbour < b.neighbour;
  });
  std::sort(out.boundary.begin(), out.boundary.end(), [](const Side& a, const Side& b) {
    return a.face != b.face ? a.face < b.face : a.cell != b.cell ? a.cell < b.cell : a.key < b.key;
  });
  return out;
}

void write_case(const HexMesh& mesh, const Faces& faces, const fs::path& folder) {
  PolyMesh out{mesh.points, mesh.hexahedra.size(), {}, {}, {}, {}};
  for (const Faces::Inner& face : faces.inner) {
    out.faces.push_back(face.corners);
    out.owner.push_back(face.owner);
    out.neighbour.push_back(face.neighbour);
  }
  const std::vector<std::string> names = safe_face_names(mesh.faces);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    out.patches.push_back({names[f], geometry::is_wall(mesh.faces[f]), 0});
  for (const Side& side : faces.boundary) {
    out.faces.push_back(side.corners);
    out.owner.push_back(side.cell);
    ++out.patches[static_cast<std::size_t>(side.face)].faces;
  }
  write_poly_mesh(out, folder);
}

std::string vtu_text(const HexMesh& mesh) {
  vtkNew<vtkCellArray> cells;
  std::vector<int> types;
  std::vector<std::int32_t> ids(mesh.hexahedra.size(), 0);
  const auto add = [&](const auto& corners, int type) {
    cells->InsertNextCell(static_cast<int>(corners.size()));
    for (const std::int32_t corner : corners) cells->InsertCellPoint(corner);
    types.push_back(type);
  };
  for (const geometry::Hexahedron& hexahedron : mesh.hexahedra) add(hexahedron, VTK_HEXAHEDRON);
  for (const Quad& quad : mesh.quads) add(quad, VTK_QUAD);
  ids.insert(ids.end(), mesh.quad_face_ids.begin(), mesh.quad_face_ids.end());
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(to_vtk(mesh.points));
  grid->SetCells(types.data(), cells);
  add_array(*grid->GetCellData(), "CellEntityIds", ids);
  std::vector<geometry::Face> faces = mesh.faces;
  const std::vector<std::string> names = safe_face_names(mesh.faces);
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f].name = names[f];
  add_faces(*grid, faces);
  return grid_text(*grid);
}

}  // namespace

void write_hex_mesh(const fs::path& path, const HexMesh& mesh, const core::TaskContext& task) {
  if (path.has_extension() && path.extension() != ".vtu")
    throw InvalidInput("cannot write " + path.string() +
                       ": hexahedra are written as .vtu, or into a folder without an extension for OpenFOAM");
  if (mesh.hexahedra.empty()) throw InvalidInput("there are no hexahedra to write");
  const Faces faces = faces_of(mesh);
  task.throw_if_cancelled();
  if (path.has_extension()) {
    core::write_file(path, vtu_text(mesh));
  } else {
    core::StagedFolder folder(path);
    write_case(mesh, faces, folder.temporary());
    require_nothing_lost(folder.temporary(), path, "cannot write the hexahedra");
    task.throw_if_cancelled();
    folder.commit();
  }
}

}  // namespace ostia::io
