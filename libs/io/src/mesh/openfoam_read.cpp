// OpenFOAM's polyMesh in ASCII, read: cells are put together of the faces that they own and that they
// neighbour.

#include "mesh/builder.h"
#include "mesh/cells_of_sides.h"
#include "mesh/readers.h"
#include "surface_formats.h"

#include "ostia/core/error.h"
#include "ostia/io/openfoam_words.h"

#include <algorithm>
#include <map>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

constexpr double millimetres_per_metre = 1e3;

/// Goes behind the header, if there is one.
void skip_header(OpenfoamWords& words) {
  if (words.peek() != "FoamFile") return;
  words.next();
  words.expect("{");
  for (std::string_view word = words.next(); word != "}"; word = words.next()) {
    if (word.empty()) words.refuse("its header has no end");
    if (word == "format" && words.next() == "binary")
      words.refuse("it is binary; write it as ASCII (writeFormat ascii, foamFormatConvert)");
  }
}

template <class T>
T value(OpenfoamWords& words, const char* what) {
  const std::string_view word = words.next();
  const std::optional<T> read = number<T>(word);
  if (!read) words.refuse(std::string(what) + " \"" + OpenfoamWords::shown(word) + "\" is no number");
  return *read;
}

/// How many follow in brackets behind the header; each takes two characters or more.
std::size_t begin_list(OpenfoamWords& words, const char* what) {
  skip_header(words);
  const auto n = value<std::int64_t>(words, what);
  if (n < 0 || static_cast<std::size_t>(n) > words.bytes() / 2)
    words.refuse(std::string(what) + " " + std::to_string(n) + " is more than its bytes can hold");
  words.expect("(");
  return static_cast<std::size_t>(n);
}

std::vector<geometry::Vec3> points_of(const fs::path& file) {
  OpenfoamWords words(file);
  std::vector<geometry::Vec3> points(begin_list(words, "the number of points"));
  for (geometry::Vec3& p : points) {
    words.expect("(");
    for (int k = 0; k < 3; ++k) p[k] = millimetres_per_metre * value<double>(words, "a coordinate");
    words.expect(")");
  }
  return points;
}

std::vector<CellSide> faces_in(const fs::path& file, std::size_t points) {
  OpenfoamWords words(file);
  std::vector<CellSide> faces(begin_list(words, "the number of faces"), {-1, -1, -1, -1});
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto n = value<std::int32_t>(words, "a face's number of points");
    if (n != 3 && n != 4)
      words.refuse("face " + std::to_string(f) + " has " + std::to_string(n) +
                   " corners; meshes of tetrahedra, prisms and hexahedra are read");
    words.expect("(");
    for (int k = 0; k < n; ++k) {
      const auto p = value<std::int32_t>(words, "a point");
      if (p < 0 || static_cast<std::size_t>(p) >= points)
        words.refuse("face " + std::to_string(f) + " names point " + std::to_string(p) + " of " +
                     std::to_string(points));
      faces[f][static_cast<std::size_t>(k)] = p;
    }
    words.expect(")");
  }
  return faces;
}

std::vector<std::int32_t> labels_in(const fs::path& file) {
  OpenfoamWords words(file);
  std::vector<std::int32_t> labels(begin_list(words, "the number of labels"));
  for (std::int32_t& label : labels) label = value<std::int32_t>(words, "a cell's number");
  return labels;
}

struct Patch {
  std::string name, type;
  std::size_t faces = 0, first = 0;
};

std::vector<Patch> patches_in(const fs::path& file) {
  OpenfoamWords words(file);
  std::vector<Patch> patches(begin_list(words, "the number of patches"));
  for (Patch& patch : patches) {
    patch.name = words.next();
    words.expect("{");
    for (std::string_view word = words.next(); word != "}"; word = words.next()) {
      if (word.empty()) words.refuse("patch " + patch.name + " has no end");
      if (word == "type") patch.type = words.next();
      if (word == "nFaces") patch.faces = value<std::size_t>(words, "a patch's number of faces");
      if (word == "startFace") patch.first = value<std::size_t>(words, "a patch's first face");
    }
  }
  return patches;
}

/// The sides of each cell, seen from outside of it.
std::vector<std::vector<CellSide>> cells_of(const fs::path& folder, const std::vector<CellSide>& faces) {
  const std::vector<std::int32_t> owner = labels_in(folder / "owner"),
                                  neighbour = labels_in(folder / "neighbour");
  if (owner.size() != faces.size() || neighbour.size() > faces.size())
    refuse(folder / "owner", "there are " + std::to_string(faces.size()) + " faces, " +
                                 std::to_string(owner.size()) + " owners and " +
                                 std::to_string(neighbour.size()) + " neighbours");
  std::vector<std::vector<CellSide>> cells;
  const auto add = [&](std::int32_t cell, const CellSide& side) {
    if (cell < 0 || static_cast<std::size_t>(cell) >= faces.size())
      refuse(folder / "owner", "there is no cell " + std::to_string(cell));
    const auto c = static_cast<std::size_t>(cell);
    if (c >= cells.size()) cells.resize(c + 1);
    cells[c].push_back(side);
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    add(owner[f], faces[f]);
    if (f >= neighbour.size()) continue;
    CellSide turned = faces[f];
    std::reverse(turned.begin(), turned.begin() + (turned[3] < 0 ? 3 : 4));
    add(neighbour[f], turned);
  }
  return cells;
}

/// The cells that a zone lists: `List<label> n(...)`, or `n{...}` where they are all one.
void mark_zone(OpenfoamWords& words, std::vector<bool>& marks) {
  words.next();  // List<label>
  const auto n = value<std::size_t>(words, "a zone's number of cells");
  const bool same = words.peek() == "{";
  words.expect(same ? "{" : "(");
  for (std::size_t i = 0; i < (same ? 1 : n); ++i) {
    const auto cell = value<std::int32_t>(words, "a cell's number");
    if (cell < 0 || static_cast<std::size_t>(cell) >= marks.size())
      words.refuse("a zone names cell " + std::to_string(cell) + " of " + std::to_string(marks.size()));
    marks[static_cast<std::size_t>(cell)] = true;
  }
  words.expect(same ? "}" : ")");
  words.expect(";");
}

/// Of each cell, whether it is in a zone of layers.
std::vector<bool> layers_in(const fs::path& file, std::size_t cells) {
  std::vector<bool> marks(cells, false);
  std::error_code error;
  if (!fs::exists(file, error)) return marks;
  OpenfoamWords words(file);
  const std::size_t zones = begin_list(words, "the number of zones");
  for (std::size_t z = 0; z < zones; ++z) {
    const bool layers = words.next().ends_with(layers_suffix);
    words.expect("{");
    while (words.peek() != "}") {
      if (words.next() == "cellLabels" && layers)
        mark_zone(words, marks);
      else
        words.skip_entry();
    }
    words.expect("}");
  }
  return marks;
}

geometry::Face face_of(const Patch& patch, std::int32_t id) {
  geometry::Face face = face_named(id, patch.name);
  if (patch.type == "wall") face.kind = geometry::FaceKind::wall;
  return face;
}

}  // namespace

LayeredMesh read_openfoam(const fs::path& path) {
  const fs::path folder = poly_mesh_in(path);
  if (folder.empty())
    throw InvalidInput("cannot read " + path.string() + ": it is no case of OpenFOAM (no constant/polyMesh)");
  MeshBuilder mesh(path);
  mesh.points() = points_of(folder / "points");
  const std::vector<CellSide> faces = faces_in(folder / "faces", mesh.points().size());
  const auto add = [&](const std::vector<std::int32_t>& nodes, Shape shape, std::int32_t face) {
    mesh.add(shape, nodes, face, NodeOrder());
  };
  const std::vector<std::vector<CellSide>> cells = cells_of(folder, faces);
  add_cells_of_sides(cells, 0, path, mesh, layers_in(folder / "cellZones", cells.size()));
  std::vector<geometry::Face> named;
  for (const Patch& patch : patches_in(folder / "boundary")) {
    if (patch.first > faces.size() || patch.faces > faces.size() - patch.first)
      refuse(folder / "boundary", "patch " + patch.name + " has faces beyond the last");
    named.push_back(face_of(patch, static_cast<std::int32_t>(named.size()) + 1));
    for (std::size_t f = patch.first; f < patch.first + patch.faces; ++f) {
      const CellSide& side = faces[f];
      const bool triangle = side[3] < 0;
      add({side.begin(), side.begin() + (triangle ? 3 : 4)}, triangle ? Shape::triangle : Shape::quad,
          named.back().id);
    }
  }
  return mesh.finish(std::move(named));
}

fs::path poly_mesh_in(const fs::path& path) {
  std::error_code error;
  for (const fs::path& folder : {path, path / "polyMesh", path / "constant" / "polyMesh"})
    if (fs::is_regular_file(folder / "faces", error) && fs::is_regular_file(folder / "owner", error))
      return folder;
  return {};
}

}  // namespace ostia::io
