#include "ostia/centerline/lumen_surface.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

namespace ostia::centerline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

void check(const TriMesh& lumen) {
  if (lumen.triangles.empty())
    throw GeometryError("the surface has no triangles: there is no lumen to find an axis in");
  for (std::size_t i = 0; i < lumen.points.size(); ++i)
    if (!lumen.points[i].allFinite())
      throw InvalidInput("point " + std::to_string(i) +
                         " of the surface has a coordinate that is not finite");
}

std::size_t used_point_count(const TriMesh& mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const geometry::Triangle& t : mesh.triangles)
    for (const std::int32_t v : t) used[static_cast<std::size_t>(v)] = true;
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

double triangle_area(const TriMesh& mesh, std::size_t t) {
  const auto at = [&](std::size_t k) -> const Vec3& {
    return mesh.points[static_cast<std::size_t>(mesh.triangles[t][k])];
  };
  return 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
}

// Triangles at each edge: runs of equal edges in a sorted list.
struct EdgeUse {
  std::array<std::int32_t, 2> edge;
  std::size_t triangle;
};

// Counting sort by the lower point, then a small sort within each point.
std::vector<EdgeUse> edge_uses(const TriMesh& mesh) {
  std::vector<std::size_t> next(mesh.points.size() + 1, 0);
  const auto for_each_side = [&](const auto& use) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) use(t, mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
  };
  for_each_side([&](std::size_t, std::int32_t a, std::int32_t b) {
    ++next[static_cast<std::size_t>(std::min(a, b)) + 1];
  });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<EdgeUse> uses(next.back());
  for_each_side([&](std::size_t t, std::int32_t a, std::int32_t b) {
    uses[next[static_cast<std::size_t>(std::min(a, b))]++] = {{std::min(a, b), std::max(a, b)}, t};
  });
  // Each place has moved on to where the next point begins.
  for (std::size_t v = 0, first = 0; v + 1 < next.size(); first = next[v++])
    std::sort(uses.begin() + static_cast<std::ptrdiff_t>(first),
              uses.begin() + static_cast<std::ptrdiff_t>(next[v]), [](const EdgeUse& a, const EdgeUse& b) {
                return a.edge[1] < b.edge[1] || (a.edge[1] == b.edge[1] && a.triangle < b.triangle);
              });
  return uses;
}

template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, const Visit& visit) {
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].edge == uses[first].edge) ++last;
    visit(&uses[first], last - first);
  }
}

// Patches of triangles that are joined by edges of two triangles.
class Patches {
 public:
  Patches(const TriMesh& mesh, const std::vector<EdgeUse>& uses)
      : parent_(mesh.triangles.size()), area_(parent_.size(), 0.0) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for_each_edge(uses, [&](const EdgeUse* use, std::size_t count) {
      if (count == 2) parent_[root(use[0].triangle)] = root(use[1].triangle);
    });
    for (std::size_t t = 0; t < parent_.size(); ++t) area_[root(t)] += triangle_area(mesh, t);
  }
  std::size_t root(std::size_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  double area(std::size_t t) { return area_[root(t)]; }

 private:
  std::vector<std::size_t> parent_;
  std::vector<double> area_;
};

// At each edge of more than two triangles the two of the largest patches stay (in one patch the larger
// triangles); small patches that lose there go altogether. Returns whether anything went.
bool drop_flaps(TriMesh& mesh, const std::vector<EdgeUse>& uses) {
  constexpr double small_patch = 0.1;  // of the largest patch at the edge
  bool any = false;
  for_each_edge(uses, [&](const EdgeUse*, std::size_t count) { any = any || count > 2; });
  if (!any) return false;
  Patches patches(mesh, uses);
  std::vector<bool> keep(mesh.triangles.size(), true), drop_patch(mesh.triangles.size(), false);
  for_each_edge(uses, [&](const EdgeUse* use, std::size_t count) {
    if (count <= 2) return;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < count; ++i) order.push_back(use[i].triangle);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (patches.root(a) != patches.root(b)) return patches.area(a) > patches.area(b);
      return triangle_area(mesh, a) > triangle_area(mesh, b);
    });
    for (std::size_t i = 2; i < count; ++i) {
      keep[order[i]] = false;
      if (patches.area(order[i]) < small_patch * patches.area(order[0]))
        drop_patch[patches.root(order[i])] = true;
    }
  });
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (drop_patch[patches.root(t)]) keep[t] = false;
  mesh = geometry::subset(mesh, keep);
  return true;
}

// The triangles around vertices where more than one border begins. Returns whether there were any.
bool drop_touching_borders(TriMesh& mesh, const std::vector<EdgeUse>& uses) {
  std::vector<int> borders(mesh.points.size(), 0);
  for_each_edge(uses, [&](const EdgeUse* use, std::size_t count) {
    if (count != 1) return;
    ++borders[static_cast<std::size_t>(use->edge[0])];
    ++borders[static_cast<std::size_t>(use->edge[1])];
  });
  std::vector<bool> keep(mesh.triangles.size(), true);
  bool any = false;
  for (std::size_t t = 0; t < keep.size(); ++t)
    for (const std::int32_t v : mesh.triangles[t])
      if (borders[static_cast<std::size_t>(v)] > 2) {
        keep[t] = false;
        any = true;
      }
  if (any) mesh = geometry::subset(mesh, keep);
  return any;
}

void make_borders_simple(LumenSurface& surface) {
  const std::size_t before = surface.wall.triangles.size();
  constexpr int rounds = 50;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<EdgeUse> uses = edge_uses(surface.wall);
    if (drop_flaps(surface.wall, uses)) continue;
    if (!drop_touching_borders(surface.wall, uses)) break;
  }
  if (surface.wall.triangles.empty())
    throw GeometryError("the surface is not manifold anywhere: there is no lumen to find an axis in");
  const std::size_t dropped = before - surface.wall.triangles.size();
  if (dropped > 0)
    surface.warnings.push_back(std::to_string(dropped) +
                               " triangles at non-manifold edges or vertices were left out");
}

// The wall of `capped` with its long edges cut, and the caps. A cap's rim is cut on the wall's side only,
// which leaves no gap.
void sample_wall(LumenSurface& surface) {
  const TriMesh& capped = surface.capped;
  const double size = 2.0 * geometry::volume(capped) / geometry::area(capped);
  const std::size_t wall_triangles = surface.wall.triangles.size();
  const std::size_t points = capped.points.size();
  TriMesh wall{
      capped.points,
      {capped.triangles.begin(), capped.triangles.begin() + static_cast<std::ptrdiff_t>(wall_triangles)}};
  surface.sampled = size > 0.0 ? with_edges_cut(wall, size) : wall;
  surface.sampled.triangles.insert(surface.sampled.triangles.end(),
                                   capped.triangles.begin() + static_cast<std::ptrdiff_t>(wall_triangles),
                                   capped.triangles.end());
  surface.on_border.resize(surface.sampled.points.size(), surface.sampled.points.size() > points);
  surface.only_in_caps.resize(surface.sampled.points.size(), false);
}

void mark_caps(LumenSurface& surface) {
  const std::size_t wall_triangles = surface.wall.triangles.size(), wall_points = surface.wall.points.size();
  surface.on_border.assign(surface.capped.points.size(), false);
  surface.only_in_caps.assign(surface.capped.points.size(), false);
  for (std::size_t t = wall_triangles; t < surface.capped.triangles.size(); ++t)
    for (const std::int32_t v : surface.capped.triangles[t])
      surface.on_border[static_cast<std::size_t>(v)] = true;
  std::fill(surface.only_in_caps.begin() + static_cast<std::ptrdiff_t>(wall_points),
            surface.only_in_caps.end(), true);
}

// Of a sound surface there is nothing to be mended.
LumenSurface known_lumen(const TriMesh& lumen, const KnownSurface& known) {
  LumenSurface surface;
  surface.wall = lumen;
  surface.openings = find_openings(lumen, known.loops);
  surface.capped = known.closed;
  mark_caps(surface);
  return surface;
}

// All but what is sampled.
LumenSurface capped_lumen(const TriMesh& lumen) {
  check(lumen);
  LumenSurface surface;
  surface.wall = geometry::welded(lumen);
  if (surface.wall.triangles.empty())
    throw GeometryError("all triangles of the surface are degenerate: there is no lumen to find an axis in");
  surface.welded_points =
      used_point_count(lumen) - std::min(used_point_count(lumen), surface.wall.points.size());
  make_borders_simple(surface);
  surface.wall = geometry::oriented(surface.wall);
  surface.openings = find_openings(surface.wall);
  surface.capped = surface.openings.empty() ? surface.wall : geometry::fill_holes(surface.wall).mesh;
  surface.capped = geometry::oriented(surface.capped);
  std::copy_n(surface.capped.triangles.begin(), surface.wall.triangles.size(),
              surface.wall.triangles.begin());
  mark_caps(surface);
  return surface;
}

}  // namespace

bool is_of(const KnownSurface& known, const geometry::TriMesh& surface) {
  const geometry::TriMesh& closed = known.closed;
  return !surface.triangles.empty() && surface.points.size() <= closed.points.size() &&
         surface.triangles.size() <= closed.triangles.size() &&
         std::ranges::equal(surface.points, std::span(closed.points).first(surface.points.size())) &&
         std::ranges::equal(surface.triangles, std::span(closed.triangles).first(surface.triangles.size()));
}

geometry::TriMesh simple_wall(const TriMesh& lumen) {
  LumenSurface surface = capped_lumen(lumen);
  return std::move(surface.wall);
}

LumenSurface prepare_lumen(const TriMesh& lumen, const KnownSurface* known) {
  LumenSurface surface =
      known != nullptr && is_of(*known, lumen) ? known_lumen(lumen, *known) : capped_lumen(lumen);
  sample_wall(surface);
  return surface;
}

}  // namespace ostia::centerline
