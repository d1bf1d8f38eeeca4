// Fluent's mesh in ASCII, read: cells are put together of the faces on their sides. Lengths are taken as they
// are, for mm.

#include "mesh/builder.h"
#include "mesh/cells_of_sides.h"
#include "mesh/readers.h"
#include "surface_formats.h"

#include "ostia/core/files.h"

#include <algorithm>
#include <charconv>
#include <map>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

struct Facet {
  CellSide outward;
  std::int32_t zone = 0;
};

class FluentFile {
 public:
  explicit FluentFile(const fs::path& path) : path_(path), text_(core::read_file(path)), mesh_(path) {}

  LayeredMesh read() {
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (word != "(") refuse(path_, "\"" + std::string(word) + "\" stands where a section begins");
      const std::string_view section = next();
      if (section == "10") {
        read_points();
      } else if (section == "13") {
        read_faces();
      } else if (section == "39" || section == "45") {
        read_zone();
      }
      skip();
    }
    add_cells_of_sides(cells_, 1, path_, mesh_);
    return mesh_.finish(add_facets());
  }

 private:
  static bool is_mark(char c) { return c == '(' || c == ')'; }

  /// A bracket, or what stands between brackets and white space; texts in quotation marks are one word.
  std::string_view next() {
    at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    if (at_ == text_.size()) return {};
    const std::size_t from = at_;
    if (is_mark(text_[at_])) {
      ++depth_;
      if (text_[at_++] == ')') depth_ -= 2;
    } else if (text_[at_] == '"') {
      at_ = std::min(text_.find('"', at_ + 1), text_.size() - 1) + 1;
    } else {
      at_ = std::min(text_.find_first_of(" \t\r\n()", at_), text_.size());
    }
    return std::string_view(text_).substr(from, at_ - from);
  }

  /// To the end of the section.
  void skip() {
    while (depth_ > 0)
      if (next().empty()) refuse(path_, "its last section has no end");
  }

  std::int64_t hexadecimal(const char* what) {
    const std::string_view word = next();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, 16);
    if (error != std::errc{} || end != word.data() + word.size() || value < 0)
      refuse(path_, std::string(what) + " \"" + std::string(word) + "\" is no hexadecimal number");
    return value;
  }

  /// The section's head, (zone first last ...), padded with zeros.
  std::array<std::int64_t, 5> head() {
    if (next() != "(") refuse(path_, "a section has no head");
    std::array<std::int64_t, 5> values{};
    std::size_t i = 0;
    const std::size_t depth = depth_;
    while (depth_ == depth) {
      const std::size_t before = at_;
      if (next() == ")") break;
      at_ = before;
      const std::int64_t value = hexadecimal("a section's head");
      if (i < values.size()) values[i++] = value;
    }
    if (values[1] < 1 || values[2] < values[1] - 1 || static_cast<std::size_t>(values[2]) > text_.size() / 2)
      refuse(path_, "a section has more entries than its bytes can hold");
    return values;
  }

  /// Whether the section lists what its head announces.
  bool body() {
    const std::size_t before = at_, depth = depth_;
    if (next() == "(") return true;
    at_ = before;
    depth_ = depth;
    return false;
  }

  void read_points() {
    const auto [zone, first, last, type, dimension] = head();
    if (!body()) return;
    if (dimension == 2) refuse(path_, "it is of two dimensions");
    std::vector<geometry::Vec3>& points = mesh_.points();
    if (points.size() < static_cast<std::size_t>(last))
      points.resize(static_cast<std::size_t>(last), geometry::Vec3::Zero());
    for (std::int64_t i = first; i <= last; ++i) {
      for (int k = 0; k < 3; ++k) {
        const std::string_view word = next();
        const std::optional<double> value = number<double>(word);
        if (!value) refuse(path_, "a coordinate \"" + std::string(word) + "\" is no number");
        points[static_cast<std::size_t>(i - 1)][k] = *value;
      }
    }
  }

  void read_faces() {
    const auto [zone, first, last, condition, type] = head();
    if (!body()) return;
    constexpr std::int64_t mixed = 0, polygons = 5;
    for (std::int64_t f = first; f <= last; ++f) {
      const std::int64_t corners =
          type == mixed || type == polygons ? hexadecimal("a number of corners") : type;
      if (corners != 3 && corners != 4)
        refuse(path_, "face " + std::to_string(f) + " has " + std::to_string(corners) +
                          " corners; meshes of tetrahedra, prisms and hexahedra are read");
      CellSide side{-1, -1, -1, -1};
      for (std::int64_t k = 0; k < corners; ++k)
        side[static_cast<std::size_t>(k)] =
            static_cast<std::int32_t>(std::min<std::int64_t>(hexadecimal("a point"), INT32_MAX)) - 1;
      // The right-hand normal points into the first cell.
      CellSide turned = side;
      std::reverse(turned.begin(), turned.begin() + corners);
      const std::int64_t into = hexadecimal("a cell"), from = hexadecimal("a cell");
      add_side(into, turned);
      add_side(from, side);
      if (into == 0 || from == 0)
        facets_.push_back({into == 0 ? side : turned, static_cast<std::int32_t>(zone)});
    }
  }

  /// Cell 0 is none.
  void add_side(std::int64_t cell, const CellSide& outward) {
    if (cell == 0) return;
    if (static_cast<std::size_t>(cell) > text_.size() / 2)
      refuse(path_, "there is no cell " + std::to_string(cell));
    if (cells_.size() < static_cast<std::size_t>(cell)) cells_.resize(static_cast<std::size_t>(cell));
    cells_[static_cast<std::size_t>(cell - 1)].push_back(outward);
  }

  /// (id type name ...), the id decimal.
  void read_zone() {
    if (next() != "(") return;
    const std::optional<std::int32_t> id = number<std::int32_t>(next());
    const std::string type(next()), name(next());
    if (!id || is_mark(name.empty() ? ')' : name[0])) return;
    geometry::Face face = face_named(*id, name);
    if (type == "wall") face.kind = geometry::FaceKind::wall;
    if (type.ends_with("-inlet")) face.kind = geometry::FaceKind::inlet;
    if (type.ends_with("-outlet") || type == "outflow") face.kind = geometry::FaceKind::outlet;
    zones_[*id] = face;
  }

  std::vector<geometry::Face> add_facets() {
    std::map<std::int32_t, geometry::Face> faces;
    for (const Facet& facet : facets_) {
      const bool triangle = facet.outward[3] < 0;
      mesh_.add(triangle ? Shape::triangle : Shape::quad, std::span(facet.outward).first(triangle ? 3 : 4),
                facet.zone, NodeOrder());
      const auto zone = zones_.find(facet.zone);
      faces.emplace(facet.zone, zone != zones_.end() ? zone->second : face_without_name(facet.zone));
    }
    std::vector<geometry::Face> list;
    for (const auto& [id, face] : faces) list.push_back(face);
    return list;
  }

  fs::path path_;
  std::string text_;
  std::size_t at_ = 0, depth_ = 0;
  MeshBuilder mesh_;
  std::vector<std::vector<CellSide>> cells_;
  std::vector<Facet> facets_;
  std::map<std::int32_t, geometry::Face> zones_;
};

}  // namespace

LayeredMesh read_fluent(const fs::path& path) {
  return FluentFile(path).read();
}

}  // namespace ostia::io
