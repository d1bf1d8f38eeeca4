#include "quality/mixed_sides.h"

#include "quality/mixed_elements.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mixed_mesh_sides.h"

#include <algorithm>
#include <tuple>

namespace ostia::meshing {

using geometry::MixedMesh;

namespace {

/// Corners in ascending order, -1 first for a triangle.
SideCorners sorted(SideCorners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

template <class Visit>
void for_each_side(const MixedMesh& mesh, const Visit& visit) {
  const std::size_t elements = mesh.tetrahedra.size() + mesh.prisms.size();
  for (std::size_t e = 0; e < elements; ++e)
    for (std::size_t s = 0; s < side_count(mesh, e); ++s)
      visit(Side{static_cast<std::int32_t>(e), static_cast<std::int32_t>(s)});
  const std::size_t facets = mesh.triangles.size() + mesh.quads.size();
  for (std::size_t f = 0; f < facets; ++f) visit(Side{static_cast<std::int32_t>(f), -1});
}

}  // namespace

void check_lists(const MixedMesh& mesh, const std::string& what) {
  const auto refuse = [&](const std::string& why) { throw InvalidInput(what + ": " + why); };
  if (mesh.triangle_face_ids.size() != mesh.triangles.size() ||
      mesh.quad_face_ids.size() != mesh.quads.size())
    refuse("the mesh needs one face id for each facet of its boundary");
  if (mesh.quadratic() &&
      (mesh.tetrahedron_nodes.size() != mesh.tetrahedra.size() ||
       mesh.prism_nodes.size() != mesh.prisms.size() || mesh.triangle_nodes.size() != mesh.triangles.size() ||
       mesh.quad_nodes.size() != mesh.quads.size()))
    refuse("some elements or facets have nodes of the second order and some have not");
  const auto check = [&](const auto& elements, const char* kind) {
    for (std::size_t i = 0; i < elements.size(); ++i)
      for (const std::int32_t v : elements[i])
        if (v < 0 || static_cast<std::size_t>(v) >= mesh.points.size())
          refuse(std::string(kind) + " " + std::to_string(i) + " refers to point " + std::to_string(v) +
                 ", which does not exist");
  };
  check(mesh.tetrahedra, "tetrahedron");
  check(mesh.prisms, "prism");
  check(mesh.triangles, "boundary triangle");
  check(mesh.quads, "boundary quadrilateral");
  check(mesh.tetrahedron_nodes, "tetrahedron");
  check(mesh.prism_nodes, "prism");
  check(mesh.triangle_nodes, "boundary triangle");
  check(mesh.quad_nodes, "boundary quadrilateral");
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!mesh.points[i].allFinite()) refuse("point " + std::to_string(i) + " is not finite");
}

std::size_t side_count(const MixedMesh& mesh, std::size_t element) {
  return element < mesh.tetrahedra.size() ? 4 : 5;
}

SideCorners corners_of(const MixedMesh& mesh, const Side& side) {
  const auto owner = static_cast<std::size_t>(side.owner), s = static_cast<std::size_t>(side.side);
  if (side.facet()) {
    if (owner < mesh.triangles.size()) {
      const geometry::Triangle& t = mesh.triangles[owner];
      return {t[0], t[1], t[2], -1};
    }
    return mesh.quads[owner - mesh.triangles.size()];
  }
  const auto at = [](const auto& corners, const std::array<int, 4>& places) {
    SideCorners result{-1, -1, -1, -1};
    for (std::size_t i = 0; i < 4; ++i)
      if (places[i] >= 0) result[i] = corners[static_cast<std::size_t>(places[i])];
    return result;
  };
  return owner < mesh.tetrahedra.size()
             ? at(mesh.tetrahedra[owner], geometry::tetrahedron_sides[s])
             : at(mesh.prisms[owner - mesh.tetrahedra.size()], geometry::prism_sides[s]);
}

int same_way(const SideCorners& a, const SideCorners& b) {
  const std::size_t n = a[3] < 0 ? 3 : 4;
  if ((b[3] < 0 ? 3u : 4u) != n) return 0;
  std::size_t shift = 0;
  while (shift < n && b[shift] != a[0]) ++shift;
  if (shift == n) return 0;
  bool with = true, against = true;
  for (std::size_t i = 0; i < n; ++i) {
    with = with && b[(shift + i) % n] == a[i];
    against = against && b[(shift + n - i) % n] == a[i];
  }
  return with ? 1 : against ? -1 : 0;
}

bool same_nodes(const MixedMesh& mesh, const Side& element, const Side& facet) {
  if (!mesh.quadratic()) return true;
  const auto owner = static_cast<std::size_t>(element.owner), f = static_cast<std::size_t>(facet.owner);
  const SideCorners c = corners_of(mesh, facet);
  const bool quad = c[3] >= 0;
  const std::size_t n = quad ? 4 : 3;
  for (std::size_t e = 0; e < n; ++e) {
    const std::int32_t node =
        quad ? mesh.quad_nodes[f - mesh.triangles.size()][e] : mesh.triangle_nodes[f][e];
    if (node != geometry::edge_node(mesh, owner, c[e], c[(e + 1) % n])) return false;
  }
  return !quad ||
         mesh.quad_nodes[f - mesh.triangles.size()][4] ==
             mesh.prism_nodes[owner - mesh.tetrahedra.size()][7 + static_cast<std::size_t>(element.side)];
}

SideTable::SideTable(const MixedMesh& mesh) {
  first_.assign(mesh.points.size() + 1, 0);
  const auto lowest = [](const SideCorners& s) { return static_cast<std::size_t>(s[0] < 0 ? s[1] : s[0]); };
  for_each_side(mesh, [&](const Side& side) { ++first_[lowest(sorted(corners_of(mesh, side))) + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  entries_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for_each_side(mesh, [&](const Side& side) {
    const SideCorners s = sorted(corners_of(mesh, side));
    const bool triangle = s[0] < 0;
    entries_[next[lowest(s)]++] = {{triangle ? -1 : s[1], s[2], s[3]}, side};
  });
  constexpr std::size_t grain = 4096;
  core::parallel_for(mesh.points.size(), grain, [&](std::size_t i) {
    const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(first_[i]),
               end = entries_.begin() + static_cast<std::ptrdiff_t>(first_[i + 1]);
    std::sort(begin, end, [](const Entry& a, const Entry& b) {
      return std::tie(a.others, a.side.side, a.side.owner) < std::tie(b.others, b.side.side, b.side.owner);
    });
  });
}

}  // namespace ostia::meshing
