// OpenFOAM's polyMesh in ASCII, read: cells are put together of the faces that they own and that they
// neighbour.

#include "formats.h"
#include "mesh_builder.h"
#include "mesh_cells_of_sides.h"
#include "mesh_readers.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <map>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

constexpr double millimetres = 1e3;

/// The text of an OpenFOAM file without its comments, word by word; brackets and semicolons are words.
class FoamText {
 public:
  explicit FoamText(const fs::path& path) : path_(path), text_(core::read_file(path)) {
    if (next() == "FoamFile")
      skip_header();
    else
      at_ = 0;
  }
  std::string_view next() {
    skip_blank();
    if (at_ == text_.size()) return {};
    const std::size_t from = at_;
    if (!is_mark(text_[at_])) {
      while (at_ < text_.size() && !is_blank(text_[at_]) && !is_mark(text_[at_])) ++at_;
    } else {
      ++at_;
    }
    return std::string_view(text_).substr(from, at_ - from);
  }
  template <class T>
  T value(const char* what) {
    const std::string_view word = next();
    const std::optional<T> read = number<T>(word);
    if (!read) refuse(path_, std::string(what) + " \"" + std::string(word) + "\" is no number");
    return *read;
  }
  void expect(std::string_view mark) {
    const std::string_view word = next();
    if (word != mark)
      refuse(path_, "\"" + std::string(word) + "\" stands where \"" + std::string(mark) + "\" belongs");
  }
  /// How many follow in brackets; each takes two characters or more.
  std::size_t count(const char* what) {
    const auto n = value<std::int64_t>(what);
    if (n < 0 || static_cast<std::size_t>(n) > text_.size() / 2)
      refuse(path_, std::string(what) + " " + std::to_string(n) + " is more than its bytes can hold");
    expect("(");
    return static_cast<std::size_t>(n);
  }
  const fs::path& path() const { return path_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  static bool is_mark(char c) { return c == '(' || c == ')' || c == '{' || c == '}' || c == ';'; }
  void skip_blank() {
    while (at_ < text_.size()) {
      if (is_blank(text_[at_])) {
        ++at_;
      } else if (text_.compare(at_, 2, "//") == 0) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        at_ = end == std::string::npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }
  void skip_header() {
    expect("{");
    for (std::string_view word = next(); word != "}"; word = next()) {
      if (word.empty()) refuse(path_, "its header has no end");
      if (word == "format" && next() == "binary")
        refuse(path_, "it is binary; write it as ASCII (writeFormat ascii, foamFormatConvert)");
    }
  }
  fs::path path_;
  std::string text_;
  std::size_t at_ = 0;
};

std::vector<geometry::Vec3> points_of(const fs::path& file) {
  FoamText text(file);
  std::vector<geometry::Vec3> points(text.count("the number of points"));
  for (geometry::Vec3& p : points) {
    text.expect("(");
    for (int k = 0; k < 3; ++k) p[k] = millimetres * text.value<double>("a coordinate");
    text.expect(")");
  }
  return points;
}

std::vector<CellSide> faces_in(const fs::path& file, std::size_t points) {
  FoamText text(file);
  std::vector<CellSide> faces(text.count("the number of faces"), {-1, -1, -1, -1});
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto n = text.value<std::int32_t>("a face's number of points");
    if (n != 3 && n != 4)
      refuse(file, "face " + std::to_string(f) + " has " + std::to_string(n) +
                       " corners; meshes of tetrahedra and prisms are read");
    text.expect("(");
    for (int k = 0; k < n; ++k) {
      const auto p = text.value<std::int32_t>("a point");
      if (p < 0 || static_cast<std::size_t>(p) >= points)
        refuse(file, "face " + std::to_string(f) + " names point " + std::to_string(p) + " of " +
                         std::to_string(points));
      faces[f][static_cast<std::size_t>(k)] = p;
    }
    text.expect(")");
  }
  return faces;
}

std::vector<std::int32_t> labels_in(const fs::path& file) {
  FoamText text(file);
  std::vector<std::int32_t> labels(text.count("the number of labels"));
  for (std::int32_t& label : labels) label = text.value<std::int32_t>("a cell's number");
  return labels;
}

struct Patch {
  std::string name, type;
  std::size_t faces = 0, first = 0;
};

std::vector<Patch> patches_in(const fs::path& file) {
  FoamText text(file);
  std::vector<Patch> patches(text.count("the number of patches"));
  for (Patch& patch : patches) {
    patch.name = text.next();
    text.expect("{");
    for (std::string_view word = text.next(); word != "}"; word = text.next()) {
      if (word.empty()) refuse(file, "patch " + patch.name + " has no end");
      if (word == "type") patch.type = text.next();
      if (word == "nFaces") patch.faces = text.value<std::size_t>("a patch's number of faces");
      if (word == "startFace") patch.first = text.value<std::size_t>("a patch's first face");
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

geometry::Face face_of(const Patch& patch, std::int32_t id) {
  geometry::Face face = face_named(id, patch.name);
  if (patch.type == "wall") face.kind = geometry::FaceKind::wall;
  return face;
}

}  // namespace

geometry::MixedMesh read_openfoam(const fs::path& path) {
  const fs::path folder = poly_mesh_in(path);
  if (folder.empty())
    throw InvalidInput("cannot read " + path.string() + ": it is no case of OpenFOAM (no constant/polyMesh)");
  MeshBuilder mesh(path);
  mesh.points() = points_of(folder / "points");
  const std::vector<CellSide> faces = faces_in(folder / "faces", mesh.points().size());
  const auto add = [&](const std::vector<std::int32_t>& nodes, Shape shape, std::int32_t face) {
    mesh.add(shape, nodes, face, NodeOrder());
  };
  add_cells_of_sides(cells_of(folder, faces), 0, path, mesh);
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
