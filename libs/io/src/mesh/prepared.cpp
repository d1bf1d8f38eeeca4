#include "mesh/prepared.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/io/mesh_export.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace ostia::io {
namespace {

using geometry::MixedMesh;
using geometry::prism_sides;
using geometry::tetrahedron_sides;

constexpr std::size_t longest_title = 16;  // formats put the kind of element behind it

[[noreturn]] void refuse_mesh(const std::string& what) {
  throw InvalidInput("cannot export the mesh: " + what);
}

template <class Elements>
void check_indices(const Elements& elements, const char* kind, std::vector<char>& used) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (const std::int32_t p : elements[i]) {
      if (p < 0 || static_cast<std::size_t>(p) >= used.size())
        refuse_mesh(std::string(kind) + " " + std::to_string(i) + " names point " + std::to_string(p) +
                    ", but there are " + std::to_string(used.size()) + " points");
      used[static_cast<std::size_t>(p)] = 1;
    }
  }
}

void check_count(std::size_t got, std::size_t expected, const char* what) {
  if (got != expected)
    refuse_mesh("it has " + std::to_string(got) + " " + what + " where " + std::to_string(expected) +
                " are needed");
}

void check_counts(const MixedMesh& mesh) {
  if (mesh.tetrahedra.empty() && mesh.prisms.empty())
    refuse_mesh("it has no elements; make the volume mesh first");
  check_count(mesh.triangle_face_ids.size(), mesh.triangles.size(), "face ids of triangles");
  check_count(mesh.quad_face_ids.size(), mesh.quads.size(), "face ids of quadrilaterals");
  if (!mesh.quadratic() && mesh.triangle_nodes.empty() && mesh.quad_nodes.empty()) return;
  check_count(mesh.tetrahedron_nodes.size(), mesh.tetrahedra.size(), "tetrahedra with second-order nodes");
  check_count(mesh.prism_nodes.size(), mesh.prisms.size(), "prisms with second-order nodes");
  check_count(mesh.triangle_nodes.size(), mesh.triangles.size(), "triangles with second-order nodes");
  check_count(mesh.quad_nodes.size(), mesh.quads.size(), "quadrilaterals with second-order nodes");
}

void check_points(const MixedMesh& mesh) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (!mesh.points[i].allFinite())
      refuse_mesh("a coordinate of point " + std::to_string(i) + " is not finite; mesh the surface again");
  }
  std::vector<char> used(mesh.points.size(), 0);
  check_indices(mesh.tetrahedra, "tetrahedron", used);
  check_indices(mesh.prisms, "prism", used);
  check_indices(mesh.tetrahedron_nodes, "tetrahedron", used);
  check_indices(mesh.prism_nodes, "prism", used);
  const auto lonely = std::ranges::find(used, 0);
  if (lonely != used.end())
    refuse_mesh("point " + std::to_string(lonely - used.begin()) +
                " belongs to no element, over which solvers fail; take it out");
  check_indices(mesh.triangles, "boundary triangle", used);
  check_indices(mesh.quads, "boundary quadrilateral", used);
  check_indices(mesh.triangle_nodes, "boundary triangle", used);
  check_indices(mesh.quad_nodes, "boundary quadrilateral", used);
}

std::vector<PreparedMesh::Facets> facets_of(const MixedMesh& mesh) {
  std::map<std::int32_t, std::size_t> place;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::int32_t id = mesh.faces[f].id;
    if (id < 1) refuse_mesh("face id " + std::to_string(id) + " is below 1 (0 is the volume)");
    if (!place.emplace(id, f).second) refuse_mesh("two faces have the id " + std::to_string(id));
  }
  std::vector<PreparedMesh::Facets> facets(mesh.faces.size());
  const auto sort_in = [&](const std::vector<std::int32_t>& ids, const char* kind, auto list) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto found = place.find(ids[i]);
      if (found == place.end())
        refuse_mesh("boundary " + std::string(kind) + " " + std::to_string(i) + " has the face id " +
                    std::to_string(ids[i]) + ", but no face has it; name that face");
      (facets[found->second].*list).push_back(static_cast<std::int32_t>(i));
    }
  };
  sort_in(mesh.triangle_face_ids, "triangle", &PreparedMesh::Facets::triangles);
  sort_in(mesh.quad_face_ids, "quadrilateral", &PreparedMesh::Facets::quads);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (facets[f].size() == 0)
      refuse_mesh("the face " + std::to_string(mesh.faces[f].id) + " '" + mesh.faces[f].name +
                  "' has no boundary triangle or quadrilateral; leave it out");
  }
  return facets;
}

/// A side of an element, or (of = facet) a boundary facet: the same sorted corners meet.
struct Record {
  std::array<std::int32_t, 4> key;
  std::int32_t index;
  std::int8_t side;  ///< -1 for a boundary facet
  bool operator<(const Record& other) const {
    return std::tie(key, side, index) < std::tie(other.key, other.side, other.index);
  }
};

std::string shown(const std::array<std::int32_t, 4>& corners) {
  std::string text;
  for (const std::int32_t c : corners) {
    if (c >= 0) text += (text.empty() ? "" : ", ") + std::to_string(c);
  }
  return text;
}

/// The same corners in the same sense; both triangles (the fourth is -1) or both quadrilaterals.
bool same_sense(const std::array<std::int32_t, 4>& a, const std::array<std::int32_t, 4>& b) {
  const std::size_t n = a[3] < 0 ? 3 : 4;
  for (std::size_t turn = 0; turn < n; ++turn) {
    bool same = true;
    for (std::size_t i = 0; i < n; ++i) same = same && a[i] == b[(i + turn) % n];
    if (same) return true;
  }
  return false;
}

std::array<std::int32_t, 4> facet_corners(const MixedMesh& mesh, bool quad, std::size_t i) {
  if (quad) return mesh.quads[i];
  const geometry::Triangle& t = mesh.triangles[i];
  return {t[0], t[1], t[2], -1};
}

Record record(std::array<std::int32_t, 4> corners, std::size_t index, int side) {
  std::ranges::sort(corners);
  return {corners, static_cast<std::int32_t>(index), static_cast<std::int8_t>(side)};
}

std::vector<Record> sides_and_facets(const PreparedMesh& prepared) {
  const MixedMesh& mesh = prepared.mesh;
  std::vector<Record> records;
  records.reserve(4 * mesh.tetrahedra.size() + 5 * mesh.prisms.size() + mesh.triangles.size() +
                  mesh.quads.size());
  for (std::size_t e = 0; e < prepared.elements(); ++e) {
    const int sides = e < mesh.tetrahedra.size() ? 4 : 5;
    for (int s = 0; s < sides; ++s)
      records.push_back(record(prepared.corners({static_cast<std::int32_t>(e), s}), e, s));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    records.push_back(record(facet_corners(mesh, false, i), i, -1));
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    records.push_back(record(facet_corners(mesh, true, i), i, -1));
  std::sort(records.begin(), records.end());
  return records;
}

/// Says what is wrong with the sides and facets that share their corners.
[[noreturn]] void refuse_group(const Record* first, std::size_t size) {
  const std::string where = "the side with the points " + shown(first->key);
  const auto facets = static_cast<std::size_t>(
      std::count_if(first, first + size, [](const Record& r) { return r.side < 0; }));
  if (facets == size) refuse_mesh(where + " is boundary, but no element has it");
  if (facets == 0 && size == 1)
    refuse_mesh(where + " belongs to one element alone, but the boundary lacks it");
  refuse_mesh(where + " belongs to " + std::to_string(size - facets) + " elements and " +
              std::to_string(facets) + " boundary facets; it must be two elements, or one and one facet");
}

void join_sides(PreparedMesh& prepared) {
  const MixedMesh& mesh = prepared.mesh;
  prepared.triangle_parents.resize(mesh.triangles.size());
  prepared.quad_parents.resize(mesh.quads.size());
  const std::vector<Record> records = sides_and_facets(prepared);
  for (std::size_t i = 0, end = 0; i < records.size(); i = end) {
    while (end < records.size() && records[end].key == records[i].key) ++end;
    const Record& a = records[i];
    if (end - i != 2 || records[i + 1].side < 0) refuse_group(&a, end - i);
    const Record& b = records[i + 1];
    const ElementSide side{b.index, b.side};
    if (a.side >= 0) {
      const ElementSide other{a.index, a.side};
      prepared.inner.push_back(a.index < b.index ? InnerSide{other, side} : InnerSide{side, other});
      continue;
    }
    const bool quad = a.key[0] >= 0;  // sorted: a triangle's -1 comes first
    const auto facet = static_cast<std::size_t>(a.index);
    if (!same_sense(facet_corners(mesh, quad, facet), prepared.corners(side)))
      refuse_mesh("the boundary facet with the points " + shown(facet_corners(mesh, quad, facet)) +
                  " does not run as its element's outward side does; turn it");
    (quad ? prepared.quad_parents : prepared.triangle_parents)[facet] = side;
  }
  std::ranges::sort(prepared.inner, {},
                    [](const InnerSide& s) { return std::pair(s.first.element, s.second.element); });
}

/// Of a side's second-order nodes, in any order.
std::vector<std::int32_t> second_order_nodes(const MixedMesh& mesh, const ElementSide& side) {
  constexpr std::array<std::array<std::size_t, 3>, 4> of_tetrahedron = {
      {{0, 1, 2}, {0, 3, 4}, {1, 4, 5}, {2, 3, 5}}};
  constexpr std::array<std::array<std::size_t, 5>, 5> of_prism = {
      {{0, 1, 2}, {3, 4, 5}, {0, 7, 3, 6, 9}, {1, 8, 4, 7, 10}, {2, 6, 5, 8, 11}}};
  const auto e = static_cast<std::size_t>(side.element), s = static_cast<std::size_t>(side.side);
  std::vector<std::int32_t> nodes;
  if (e < mesh.tetrahedra.size()) {
    for (const std::size_t n : of_tetrahedron[s]) nodes.push_back(mesh.tetrahedron_nodes[e][n]);
  } else {
    for (std::size_t i = 0; i < (s < 2 ? 3u : 5u); ++i)
      nodes.push_back(mesh.prism_nodes[e - mesh.tetrahedra.size()][of_prism[s][i]]);
  }
  return nodes;
}

template <std::size_t M>
void check_facet_nodes(const MixedMesh& mesh, const std::vector<std::array<std::int32_t, M>>& facet_nodes,
                       const std::vector<ElementSide>& parents, const char* kind) {
  for (std::size_t i = 0; i < facet_nodes.size(); ++i) {
    std::vector<std::int32_t> of_side = second_order_nodes(mesh, parents[i]);
    std::vector<std::int32_t> of_facet(facet_nodes[i].begin(), facet_nodes[i].end());
    std::ranges::sort(of_side);
    std::ranges::sort(of_facet);
    if (of_side != of_facet)
      refuse_mesh("the second-order nodes of boundary " + std::string(kind) + " " + std::to_string(i) +
                  " are not its element's");
  }
}

template <std::size_t N, std::size_t M>
void append(std::vector<std::int32_t>& out, const std::array<std::int32_t, N>& corners,
            const std::vector<std::array<std::int32_t, M>>& second, std::size_t i,
            const std::array<int, N + M>& order) {
  const std::size_t n = second.empty() ? N : N + M;
  for (std::size_t k = 0; k < n; ++k) {
    const auto from = static_cast<std::size_t>(order[k]);
    out.push_back(from < N ? corners[from] : second[i][from - N]);
  }
}

template <std::size_t N, std::size_t M>
void append(std::vector<std::int32_t>& out, const std::array<std::int32_t, N>& corners,
            const std::vector<std::array<std::int32_t, M>>& second, std::size_t i) {
  out.insert(out.end(), corners.begin(), corners.end());
  if (!second.empty()) out.insert(out.end(), second[i].begin(), second[i].end());
}

}  // namespace

std::size_t PreparedMesh::count(Shape shape) const {
  switch (shape) {
    case Shape::tetrahedron:
      return mesh.tetrahedra.size();
    case Shape::prism:
      return mesh.prisms.size();
    case Shape::triangle:
      return mesh.triangles.size();
    default:
      return mesh.quads.size();
  }
}

std::size_t PreparedMesh::nodes(Shape shape) const {
  constexpr std::array<std::array<std::size_t, 2>, 4> sizes = {{{4, 10}, {6, 18}, {3, 6}, {4, 9}}};
  return sizes[static_cast<std::size_t>(shape)][mesh.quadratic() ? 1 : 0];
}

std::vector<std::int32_t> PreparedMesh::connectivity(Shape shape, const NodeOrder& order) const {
  std::vector<std::int32_t> out;
  const std::size_t n = count(shape);
  out.reserve(n * nodes(shape));
  for (std::size_t i = 0; i < n; ++i) {
    switch (shape) {
      case Shape::tetrahedron:
        append(out, mesh.tetrahedra[i], mesh.tetrahedron_nodes, i, order.tetrahedron);
        break;
      case Shape::prism:
        append(out, mesh.prisms[i], mesh.prism_nodes, i, order.prism);
        break;
      case Shape::triangle:
        append(out, mesh.triangles[i], mesh.triangle_nodes, i);
        break;
      case Shape::quad:
        append(out, mesh.quads[i], mesh.quad_nodes, i);
        break;
    }
  }
  return out;
}

std::vector<std::int32_t> PreparedMesh::connectivity(Shape shape,
                                                     const std::vector<std::int32_t>& facets_named) const {
  std::vector<std::int32_t> out;
  out.reserve(facets_named.size() * nodes(shape));
  for (const std::int32_t named : facets_named) {
    const auto i = static_cast<std::size_t>(named);
    if (shape == Shape::triangle) {
      append(out, mesh.triangles[i], mesh.triangle_nodes, i);
    } else {
      append(out, mesh.quads[i], mesh.quad_nodes, i);
    }
  }
  return out;
}

std::vector<ElementBlock> PreparedMesh::blocks() const {
  const std::size_t own = mesh.tetrahedra.size() - layer_tetrahedra;
  std::vector<ElementBlock> all{{Shape::tetrahedron, false, 0, own},
                                {Shape::tetrahedron, true, own, layer_tetrahedra},
                                {Shape::prism, false, 0, mesh.prisms.size()}};
  std::erase_if(all, [](const ElementBlock& block) { return block.count == 0; });
  return all;
}

std::string PreparedMesh::name(const ElementBlock& block) const {
  return title + (block.of_layers ? layers_suffix : block.shape == Shape::prism ? "_prisms" : "_tetrahedra");
}

std::vector<std::int32_t> PreparedMesh::connectivity(const ElementBlock& block,
                                                     const NodeOrder& order) const {
  const std::vector<std::int32_t> all = connectivity(block.shape, order);
  const auto from = all.begin() + static_cast<std::ptrdiff_t>(block.first * nodes(block.shape));
  return {from, from + static_cast<std::ptrdiff_t>(block.count * nodes(block.shape))};
}

std::array<std::int32_t, 4> PreparedMesh::corners(const ElementSide& side) const {
  const auto e = static_cast<std::size_t>(side.element);
  const std::size_t first = mesh.tetrahedra.size();
  const auto& local = e < first ? tetrahedron_sides[static_cast<std::size_t>(side.side)]
                                : prism_sides[static_cast<std::size_t>(side.side)];
  const std::int32_t* points = e < first ? mesh.tetrahedra[e].data() : mesh.prisms[e - first].data();
  std::array<std::int32_t, 4> out{};
  for (std::size_t i = 0; i < 4; ++i) out[i] = local[i] < 0 ? -1 : points[local[i]];
  return out;
}

PreparedMesh prepare(const MixedMesh& mesh, const std::string& title, std::size_t layer_tetrahedra) {
  check_counts(mesh);
  if (layer_tetrahedra > mesh.tetrahedra.size())
    refuse_mesh(std::to_string(layer_tetrahedra) + " of its " + std::to_string(mesh.tetrahedra.size()) +
                " tetrahedra are said to be of layers");
  check_points(mesh);
  std::vector<PreparedMesh::Facets> facets = facets_of(mesh);
  std::vector<geometry::Face> all = mesh.faces;
  all.push_back({0, title.substr(0, longest_title)});
  std::vector<std::string> names = safe_face_names(all);
  const std::string volume = names.back();
  names.pop_back();
  PreparedMesh prepared{mesh, volume, std::move(names), std::move(facets), {}, {}, {}, layer_tetrahedra};
  join_sides(prepared);
  check_facet_nodes(mesh, mesh.triangle_nodes, prepared.triangle_parents, "triangle");
  check_facet_nodes(mesh, mesh.quad_nodes, prepared.quad_parents, "quadrilateral");
  return prepared;
}

}  // namespace ostia::io
