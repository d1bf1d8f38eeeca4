#include "edge_table.h"
#include "mesh_checks.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <unordered_map>

namespace ostia::geometry {
namespace {

using detail::HalfEdge;

/// Joins each point to the lowest representative within the tolerance, by a grid of cells as wide as it.
std::vector<std::int32_t> first_near_points(const std::vector<Vec3>& points, double tolerance) {
  double largest = 0.0;
  for (const Vec3& p : points) {
    if (p.allFinite()) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  // Not so narrow that the cells' numbers lose their units.
  const double cell = std::max(tolerance, 1e-12 * largest);
  const auto key = [](const Vec3& c) {
    std::uint64_t hash = 0;
    for (int a = 0; a < 3; ++a) {
      hash = (hash ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(c[a]))) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29;
    }
    return hash;
  };
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells;
  std::vector<std::int32_t> first(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    first[i] = static_cast<std::int32_t>(i);
    if (!points[i].allFinite()) continue;
    const Vec3 own = (points[i] / cell).array().floor();
    for (int n = 0; n < 27; ++n) {
      const auto found = cells.find(key(own + Vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
      if (found == cells.end()) continue;
      for (const std::int32_t other : found->second) {
        const double distance = (points[static_cast<std::size_t>(other)] - points[i]).norm();
        if (distance <= tolerance) first[i] = std::min(first[i], other);
      }
    }
    if (first[i] == static_cast<std::int32_t>(i)) cells[key(own)].push_back(first[i]);
  }
  return first;
}

/// Keeps the points that triangles use, in their order, and renumbers the triangles.
void drop_unused_points(TriMesh& mesh) {
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t p : t) number[static_cast<std::size_t>(p)] = 0;
  }
  std::size_t count = 0;
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] < 0) continue;
    number[p] = static_cast<std::int32_t>(count);
    mesh.points[count++] = mesh.points[p];
  }
  mesh.points.resize(count);
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& p : t) p = number[static_cast<std::size_t>(p)];
  }
}

void drop_duplicate_triangles(TriMesh& mesh) {
  const std::vector<detail::CornersOfTriangle> sorted = detail::sorted_corners(mesh);
  std::vector<char> keep(sorted.size(), 1);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].corners == sorted[i - 1].corners) keep[static_cast<std::size_t>(sorted[i].triangle)] = 0;
  }
  std::size_t count = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t]) mesh.triangles[count++] = mesh.triangles[t];
  }
  mesh.triangles.resize(count);
}

/// The corner opposite the longest side.
std::size_t apex_of(const TriMesh& mesh, const Triangle& t) {
  std::size_t apex = 0;
  double longest = -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = (mesh.points[static_cast<std::size_t>(t[(i + 1) % 3])] -
                           mesh.points[static_cast<std::size_t>(t[(i + 2) % 3])])
                              .norm();
    if (length <= longest) continue;
    longest = length;
    apex = i;
  }
  return apex;
}

/// A triangle without area whose apex stands on its longest side: merely dropping it would leave a crack
/// there, so the neighbour across that side is split at the apex. Tells whether anything was split.
bool split_across_flat_triangles(TriMesh& mesh) {
  std::vector<char> touched(mesh.triangles.size(), 0);
  bool any = false;
  detail::for_each_edge(detail::half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first != 2) return;
    for (int i = 0; i < 2; ++i) {
      const auto flat = static_cast<std::size_t>(first[i].triangle);
      const auto other = static_cast<std::size_t>(first[1 - i].triangle);
      const Triangle t = mesh.triangles[flat];
      if (touched[flat] || touched[other] || !detail::is_degenerate(mesh, t)) continue;
      const std::size_t apex = apex_of(mesh, t);
      if ((apex + 1) % 3 != static_cast<std::size_t>(first[i].side)) continue;
      const auto side = static_cast<std::size_t>(first[1 - i].side);
      const Triangle split = mesh.triangles[other];
      const std::int32_t from = split[side], to = split[(side + 1) % 3], tip = split[(side + 2) % 3];
      if (tip == t[apex]) continue;
      mesh.triangles[other] = {from, t[apex], tip};
      mesh.triangles[flat] = {t[apex], to, tip};
      touched[flat] = touched[other] = 1;
      any = true;
    }
  });
  return any;
}

void drop_degenerate_triangles(TriMesh& mesh) {
  const auto flat = [&](const Triangle& t) { return detail::is_degenerate(mesh, t); };
  if (std::ranges::none_of(mesh.triangles, flat)) return;
  // Flat triangles in a row need a pass each; a row that long has no surface to save.
  for (int pass = 0; pass < 8 && split_across_flat_triangles(mesh); ++pass) {
  }
  std::erase_if(mesh.triangles, flat);
}

/// Turns triangles so that neighbours across two-triangle edges agree; a patch ends at other edges.
struct Turning {
  std::vector<std::int32_t> patch;  // of each triangle
  std::vector<char> turned;
  std::vector<char> closed;  // of each patch
};

Turning turn_together(const TriMesh& mesh) {
  const auto count = mesh.triangles.size();
  struct Link {
    std::int32_t other = -1;
    bool against = false;  // runs along the edge the same way
  };
  std::vector<std::array<Link, 3>> links(count);
  detail::for_each_edge(detail::half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first != 2) return;
    const bool against = first[0].ascending == first[1].ascending;
    for (int i = 0; i < 2; ++i) {
      links[static_cast<std::size_t>(first[i].triangle)][static_cast<std::size_t>(first[i].side)] = {
          first[1 - i].triangle, against};
    }
  });
  Turning result{std::vector<std::int32_t>(count, -1), std::vector<char>(count, 0), {}};
  std::vector<std::int32_t> waiting;
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (result.patch[seed] >= 0) continue;
    const auto number = static_cast<std::int32_t>(result.closed.size());
    result.closed.push_back(1);
    result.patch[seed] = number;
    waiting.push_back(static_cast<std::int32_t>(seed));
    while (!waiting.empty()) {
      const auto t = static_cast<std::size_t>(waiting.back());
      waiting.pop_back();
      for (const Link& link : links[t]) {
        if (link.other < 0) {
          result.closed.back() = 0;
          continue;
        }
        const auto other = static_cast<std::size_t>(link.other);
        const char turned = link.against ? !result.turned[t] : result.turned[t];
        if (result.patch[other] < 0) {
          result.patch[other] = number;
          result.turned[other] = turned;
          waiting.push_back(link.other);
        } else if (result.turned[other] != turned) {
          throw GeometryError(
              "orientation: the surface has only one side (a Moebius strip runs through triangle " +
              std::to_string(link.other) + "); cut it or remove that part");
        }
      }
    }
  }
  return result;
}

}  // namespace

TriMesh welded(const TriMesh& mesh, double tolerance_mm) {
  detail::check_indices(mesh, "weld");
  if (!(tolerance_mm >= 0.0 && std::isfinite(tolerance_mm))) {
    throw InvalidInput("weld: the tolerance is " + std::to_string(tolerance_mm) +
                       " mm; it must be finite and 0 or more");
  }
  const std::vector<std::int32_t> first = tolerance_mm == 0.0 ? detail::first_equal_points(mesh.points)
                                                              : first_near_points(mesh.points, tolerance_mm);
  TriMesh result;
  result.points = mesh.points;
  result.triangles.reserve(mesh.triangles.size());
  for (Triangle t : mesh.triangles) {
    bool finite = true;
    for (std::int32_t& p : t) {
      p = first[static_cast<std::size_t>(p)];
      finite = finite && mesh.points[static_cast<std::size_t>(p)].allFinite();
    }
    if (finite && !detail::repeats_a_corner(t)) result.triangles.push_back(t);
  }
  drop_degenerate_triangles(result);
  drop_duplicate_triangles(result);
  drop_unused_points(result);
  return result;
}

TriMesh oriented(const TriMesh& mesh) {
  detail::check_indices(mesh, "orientation");
  const Turning turning = turn_together(mesh);
  TriMesh result = mesh;
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    if (turning.turned[t]) std::swap(result.triangles[t][1], result.triangles[t][2]);
  }
  std::vector<double> volumes(turning.closed.size(), 0.0);
  std::vector<const Vec3*> from(turning.closed.size(), nullptr);
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const auto patch = static_cast<std::size_t>(turning.patch[t]);
    const Triangle& triangle = result.triangles[t];
    if (from[patch] == nullptr) from[patch] = &detail::corner(result, triangle, 0);
    const Vec3 a = detail::corner(result, triangle, 0) - *from[patch];
    const Vec3 b = detail::corner(result, triangle, 1) - *from[patch];
    const Vec3 c = detail::corner(result, triangle, 2) - *from[patch];
    volumes[patch] += a.dot(b.cross(c));
  }
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const auto patch = static_cast<std::size_t>(turning.patch[t]);
    if (turning.closed[patch] && volumes[patch] < 0.0)
      std::swap(result.triangles[t][1], result.triangles[t][2]);
  }
  return result;
}

TriMesh subset(const TriMesh& mesh, const std::vector<bool>& keep, std::vector<std::int32_t>* old_triangles) {
  detail::check_indices(mesh, "subset");
  if (keep.size() != mesh.triangles.size()) {
    throw InvalidInput("subset: " + std::to_string(keep.size()) + " marks for " +
                       std::to_string(mesh.triangles.size()) + " triangles; there must be one a triangle");
  }
  TriMesh result;
  result.points = mesh.points;
  if (old_triangles != nullptr) old_triangles->clear();
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (!keep[t]) continue;
    result.triangles.push_back(mesh.triangles[t]);
    if (old_triangles != nullptr) old_triangles->push_back(static_cast<std::int32_t>(t));
  }
  drop_unused_points(result);
  return result;
}

TriMesh merged(const TriMesh& a, const TriMesh& b) {
  TriMesh result = a;
  result.points.insert(result.points.end(), b.points.begin(), b.points.end());
  const auto shift = static_cast<std::int32_t>(a.points.size());
  result.triangles.reserve(a.triangles.size() + b.triangles.size());
  for (const Triangle& t : b.triangles)
    result.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return result;
}

}  // namespace ostia::geometry
