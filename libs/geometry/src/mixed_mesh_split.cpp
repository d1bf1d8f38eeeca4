#include "ostia/geometry/mixed_mesh_split.h"

#include "ostia/geometry/mixed_mesh_sides.h"

#include <algorithm>

namespace ostia::geometry {
namespace {

/// The prism's symmetries that bring corner i to the first place and keep the volume's sign.
constexpr std::array<std::array<int, 6>, 6> turned = {{{0, 1, 2, 3, 4, 5},
                                                       {1, 2, 0, 4, 5, 3},
                                                       {2, 0, 1, 5, 3, 4},
                                                       {3, 5, 4, 0, 2, 1},
                                                       {4, 3, 5, 1, 0, 2},
                                                       {5, 4, 3, 2, 1, 0}}};

/// Corners of the three tetrahedra after the turn; the third quadrilateral's diagonal is 1-5 or 2-4.
using Three = std::array<std::array<int, 4>, 3>;
constexpr Three along_15 = {{{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}}};
constexpr Three along_24 = {{{0, 1, 2, 4}, {0, 4, 2, 5}, {0, 4, 5, 3}}};

/// Where a prism has its node between two corners: an edge's middle, or a quadrilateral's for its diagonals.
constexpr std::array<std::array<int, 6>, 6> prism_node_between = {{{-1, 0, 2, 6, 9, 11},
                                                                   {0, -1, 1, 9, 7, 10},
                                                                   {2, 1, -1, 11, 10, 8},
                                                                   {6, 9, 11, -1, 3, 5},
                                                                   {9, 7, 10, 3, -1, 4},
                                                                   {11, 10, 8, 5, 4, -1}}};

std::array<std::array<int, 4>, 3> three_of(const Prism& prism) {
  const auto& turn = turned[static_cast<std::size_t>(std::ranges::min_element(prism) - prism.begin())];
  const auto point = [&](int i) { return prism[turn[i]]; };
  Three local = std::min(point(1), point(5)) < std::min(point(2), point(4)) ? along_15 : along_24;
  for (auto& tetrahedron : local) {
    for (int& corner : tetrahedron) corner = turn[corner];
  }
  return local;
}

void split_prism(const MixedMesh& mesh, std::size_t p, MixedMesh& out) {
  const Prism& prism = mesh.prisms[p];
  for (const auto& t : three_of(prism)) {
    out.tetrahedra.push_back({prism[t[0]], prism[t[1]], prism[t[2]], prism[t[3]]});
    if (mesh.prism_nodes.empty()) continue;
    auto& nodes = out.tetrahedron_nodes.emplace_back();
    for (std::size_t e = 0; e < 6; ++e)
      nodes[e] =
          mesh.prism_nodes[p][prism_node_between[t[tetrahedron_edges[e][0]]][t[tetrahedron_edges[e][1]]]];
  }
}

std::size_t first_corner(const Quad& quad) {
  return static_cast<std::size_t>(std::ranges::min_element(quad) - quad.begin());
}

}  // namespace

std::array<Triangle, 2> split_quad(const Quad& quad) {
  const std::size_t f = first_corner(quad);
  const auto q = [&](std::size_t i) { return quad[(f + i) % 4]; };
  return {{{q(0), q(1), q(2)}, {q(0), q(2), q(3)}}};
}

MixedMesh split_prisms(const MixedMesh& mesh) {
  MixedMesh out = mesh;
  out.prisms.clear();
  out.prism_nodes.clear();
  out.quads.clear();
  out.quad_face_ids.clear();
  out.quad_nodes.clear();
  out.tetrahedra.reserve(mesh.tetrahedra.size() + 3 * mesh.prisms.size());
  for (std::size_t p = 0; p < mesh.prisms.size(); ++p) split_prism(mesh, p, out);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    for (const Triangle& triangle : split_quad(mesh.quads[i])) {
      out.triangles.push_back(triangle);
      out.triangle_face_ids.push_back(mesh.quad_face_ids[i]);
    }
    if (mesh.quad_nodes.empty()) continue;
    const auto& nodes = mesh.quad_nodes[i];
    const std::size_t f = first_corner(mesh.quads[i]);
    const auto edge = [&](std::size_t e) { return nodes[(f + e) % 4]; };
    out.triangle_nodes.push_back({edge(0), edge(1), nodes[4]});
    out.triangle_nodes.push_back({nodes[4], edge(2), edge(3)});
  }
  return out;
}

}  // namespace ostia::geometry
