#include "ostia/geometry/mixed_mesh_sides.h"

#include "ostia/geometry/mixed_mesh_split.h"

#include <algorithm>
#include <utility>

namespace ostia::geometry {
namespace {

template <class Element, class Sides>
void add_sides(const std::vector<Element>& elements, const Sides& sides, std::vector<MeshSide>& out) {
  for (const Element& element : elements) {
    const std::int32_t number = out.empty() ? 0 : out.back().element + 1;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      MeshSide side{};
      for (std::size_t i = 0; i < 4; ++i)
        side.outward[i] = sides[s][i] < 0 ? -1 : element[static_cast<std::size_t>(sides[s][i])];
      side.key = side.outward;
      std::ranges::sort(side.key);
      side.element = number;
      side.side = static_cast<std::int32_t>(s);
      out.push_back(side);
    }
  }
}

void add_second_order(const MeshSide& side, MixedMesh& mesh) {
  const auto element = static_cast<std::size_t>(side.element);
  const auto at = [&](std::size_t a, std::size_t b) {
    return edge_node(mesh, element, side.outward[a], side.outward[b]);
  };
  if (side.triangle()) {
    mesh.triangle_nodes.push_back({at(0, 1), at(1, 2), at(2, 0)});
  } else {  // a prism's quadrilaterals are its sides 2 to 4, and their middles its nodes 9 to 11
    const auto& nodes = mesh.prism_nodes[element - mesh.tetrahedra.size()];
    mesh.quad_nodes.push_back(
        {at(0, 1), at(1, 2), at(2, 3), at(3, 0), nodes[7 + static_cast<std::size_t>(side.side)]});
  }
}

void add_boundary(const MeshSide& side, MixedMesh& mesh) {
  const auto& p = side.outward;
  if (side.triangle()) {
    mesh.triangles.push_back({p[0], p[1], p[2]});
    mesh.triangle_face_ids.push_back(1);
  } else {
    mesh.quads.push_back(p);
    mesh.quad_face_ids.push_back(1);
  }
  if (mesh.quadratic()) add_second_order(side, mesh);
}

/// The same among an element's own corners and nodes.
template <class Corners, class Nodes, class Edges>
std::int32_t node_between(const Corners& corners, const Nodes& nodes, const Edges& edges, std::int32_t a,
                          std::int32_t b) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::int32_t c = corners[edges[e][0]], d = corners[edges[e][1]];
    if ((c == a && d == b) || (c == b && d == a)) return nodes[e];
  }
  return -1;
}

}  // namespace

std::int32_t edge_node(const MixedMesh& mesh, std::size_t element, std::int32_t a, std::int32_t b) {
  const std::size_t tetrahedra = mesh.tetrahedra.size();
  if (element < tetrahedra)
    return node_between(mesh.tetrahedra[element], mesh.tetrahedron_nodes[element], tetrahedron_edges, a, b);
  const std::size_t prism = element - tetrahedra;
  return node_between(mesh.prisms[prism], mesh.prism_nodes[prism], prism_edges, a, b);
}

std::vector<MeshSide> sorted_sides(const MixedMesh& mesh) {
  std::vector<MeshSide> sides;
  sides.reserve(4 * mesh.tetrahedra.size() + 5 * mesh.prisms.size());
  add_sides(mesh.tetrahedra, tetrahedron_sides, sides);
  add_sides(mesh.prisms, prism_sides, sides);
  std::ranges::sort(sides, [](const MeshSide& a, const MeshSide& b) {
    return a.key != b.key ? a.key < b.key : a.element < b.element;
  });
  return sides;
}

void take_free_sides_as_boundary(MixedMesh& mesh) {
  const std::vector<MeshSide> sides = sorted_sides(mesh);
  std::vector<MeshSide> free;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].key == sides[i].key) ++end;
    if (end - i == 1) free.push_back(sides[i]);
  }
  std::ranges::sort(free, {}, [](const MeshSide& s) { return std::pair(s.element, s.side); });
  mesh.triangles.clear();
  mesh.triangle_face_ids.clear();
  mesh.triangle_nodes.clear();
  mesh.quads.clear();
  mesh.quad_face_ids.clear();
  mesh.quad_nodes.clear();
  for (const MeshSide& side : free) add_boundary(side, mesh);
  mesh.faces = {{1, "wall", FaceKind::wall}};
}

TriMesh boundary_triangles(const MixedMesh& mesh) {
  TriMesh out{mesh.points, mesh.triangles};
  for (const Quad& quad : mesh.quads)
    for (const Triangle& half : split_quad(quad)) out.triangles.push_back(half);
  return out;
}

}  // namespace ostia::geometry
