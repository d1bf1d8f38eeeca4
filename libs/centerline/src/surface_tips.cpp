#include "ostia/centerline/surface_tips.h"

#include "earliest_first.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace ostia::centerline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double disc_radii = 4.0;  // geodesic radius of the disc by which a branch's radius is measured
constexpr int disc_rounds = 6;
constexpr double from_border_radii = 3.0;    // a maximum so near to an open end is that end
constexpr double longest_neck_radii = 30.0;  // what is longer is no ball on a stalk

/// How far points are from where a walk began; infinite where it did not come.
struct Walked {
  explicit Walked(std::size_t points) : distance(points, infinite) {}
  /// For another walk.
  void forget() {
    for (const std::int32_t v : touched) distance[static_cast<std::size_t>(v)] = infinite;
    touched.clear();
  }
  std::vector<double> distance;
  std::vector<std::int32_t> touched;
};

/// Ways along the edges of a surface. Safe from many threads.
class SurfaceWays {
 public:
  explicit SurfaceWays(const TriMesh& mesh)
      : mesh_(mesh),
        neighbours_(geometry::vertex_neighbours(mesh)),
        area_(mesh.points.size(), 0.0),
        triangles_(mesh.points.size(), 0) {
    for (const geometry::Triangle& t : mesh.triangles) {
      const auto at = [&](std::size_t k) -> const Vec3& {
        return mesh.points[static_cast<std::size_t>(t[k])];
      };
      const double third = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 6.0;
      for (const std::int32_t v : t) {
        area_[static_cast<std::size_t>(v)] += third;
        ++triangles_[static_cast<std::size_t>(v)];
      }
    }
  }
  const TriMesh& mesh() const { return mesh_; }
  const std::vector<std::int32_t>& neighbours(std::int32_t v) const {
    return neighbours_[static_cast<std::size_t>(v)];
  }
  bool used(std::int32_t v) const { return !neighbours(v).empty(); }

  /// Visits points by increasing distance from `start` until `visit(point, distance)` says no.
  template <class Visit>
  void walk(std::int32_t start, Walked& walked, Visit visit) const {
    EarliestFirst next;
    std::vector<double>& distance = walked.distance;
    walked.touched.push_back(start);
    distance[static_cast<std::size_t>(start)] = 0.0;
    next.push(0.0, start);
    while (!next.empty()) {
      const auto [d, v] = next.pop();
      if (d > distance[static_cast<std::size_t>(v)]) continue;
      if (!visit(v, d)) break;
      for (const std::int32_t n : neighbours(v)) {
        const double to =
            d +
            (mesh_.points[static_cast<std::size_t>(v)] - mesh_.points[static_cast<std::size_t>(n)]).norm();
        if (to >= distance[static_cast<std::size_t>(n)]) continue;
        if (distance[static_cast<std::size_t>(n)] == infinite) walked.touched.push_back(n);
        distance[static_cast<std::size_t>(n)] = to;
        next.push(to, n);
      }
    }
  }
  double area(std::int32_t v) const { return area_[static_cast<std::size_t>(v)]; }
  /// All round a point there are as many triangles as neighbours.
  bool on_border(std::int32_t v) const {
    return triangles_[static_cast<std::size_t>(v)] != neighbours(v).size();
  }

 private:
  const TriMesh& mesh_;
  std::vector<std::vector<std::int32_t>> neighbours_;
  std::vector<double> area_;
  std::vector<std::size_t> triangles_;  // at each point
};

std::int32_t nearest_point(const SurfaceWays& ways, const Vec3& to) {
  std::int32_t best = -1;
  double least = infinite;
  for (std::size_t i = 0; i < ways.mesh().points.size(); ++i) {
    const double d = (ways.mesh().points[i] - to).squaredNorm();
    if (ways.used(static_cast<std::int32_t>(i)) && d < least) least = d, best = static_cast<std::int32_t>(i);
  }
  return best;
}

std::vector<double> distances(const SurfaceWays& ways, std::int32_t start) {
  Walked walked(ways.mesh().points.size());
  ways.walk(start, walked, [](std::int32_t, double) { return true; });
  return std::move(walked.distance);
}

std::int32_t farthest(const std::vector<double>& distance) {
  std::int32_t best = -1;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (distance[i] < infinite && (best < 0 || distance[i] > distance[static_cast<std::size_t>(best)]))
      best = static_cast<std::int32_t>(i);
  return best;
}

/// A maximum and how far it stands out.
struct Peak {
  std::int32_t point = -1;
  double prominence = 0.0;
};

/// Points join by falling distance; where two sets meet, the one with the lower maximum ends.
std::vector<Peak> peaks_of(const SurfaceWays& ways, const std::vector<double>& distance) {
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (distance[i] < infinite) order.push_back(static_cast<std::int32_t>(i));
  const auto higher = [&](std::int32_t a, std::int32_t b) {
    const double da = distance[static_cast<std::size_t>(a)], db = distance[static_cast<std::size_t>(b)];
    return da != db ? da > db : a < b;
  };
  std::ranges::sort(order, higher);
  geometry::DisjointSets sets(distance.size());
  std::vector<std::int32_t> top(distance.size(), -1);  // of a set, at its representative
  std::vector<Peak> peaks;
  std::vector<std::int32_t> met;
  for (const std::int32_t v : order) {
    std::int32_t best = v;
    const double here = distance[static_cast<std::size_t>(v)];
    met.clear();
    for (const std::int32_t n : ways.neighbours(v)) {
      const std::int32_t top_there = top[static_cast<std::size_t>(sets.find(n))];
      if (top_there >= 0 && std::ranges::find(met, top_there) == met.end()) met.push_back(top_there);
    }
    for (const std::int32_t m : met)
      if (higher(m, best)) best = m;
    for (const std::int32_t m : met)
      if (m != best) peaks.push_back({m, distance[static_cast<std::size_t>(m)] - here});
    for (const std::int32_t n : ways.neighbours(v))
      if (top[static_cast<std::size_t>(sets.find(n))] >= 0) sets.join(v, n);
    top[static_cast<std::size_t>(sets.find(v))] = best;
  }
  if (!order.empty()) peaks.push_back({order.front(), distance[static_cast<std::size_t>(order.front())]});
  return peaks;
}

/// Of the branch that ends at `tip`: about A(h) / (2 pi h), h four radii.
double radius_near(const SurfaceWays& ways, std::int32_t tip, double length_mm, Walked& walked) {
  double reach = length_mm, radius = 0.0;
  for (int round = 0; round < disc_rounds; ++round) {
    double area = 0.0;
    ways.walk(tip, walked, [&](std::int32_t v, double d) {
      if (d > reach) return false;
      area += ways.area(v);
      return true;
    });
    walked.forget();
    radius = area / (2.0 * std::numbers::pi * reach);
    if (disc_radii * radius >= reach) break;
    reach = disc_radii * radius;
  }
  return radius;
}

/// SurfaceTip::neck.
double neck_of(const SurfaceWays& ways, std::int32_t tip, double length_mm, Walked& walked) {
  double middle = 0.0, last = 0.0;
  ways.walk(tip, walked, [&](std::int32_t v, double d) {
    if (d > length_mm) return false;
    if (3.0 * d > length_mm) (3.0 * d > 2.0 * length_mm ? last : middle) += ways.area(v);
    return true;
  });
  walked.forget();
  return middle > 0.0 ? last / middle : 1.0;
}

/// Down the distance, edge by edge.
std::vector<Vec3> way_back(const SurfaceWays& ways, const std::vector<double>& distance, std::int32_t tip) {
  std::vector<Vec3> way;
  for (std::int32_t v = tip;;) {
    way.push_back(ways.mesh().points[static_cast<std::size_t>(v)]);
    std::int32_t next = v;
    for (const std::int32_t n : ways.neighbours(v))
      if (distance[static_cast<std::size_t>(n)] < distance[static_cast<std::size_t>(next)]) next = n;
    if (next == v) return way;
    v = next;
  }
}

/// The point's normal, as geometry::vertex_normals has it.
Vec3 normal_at(const TriMesh& mesh, std::int32_t point) {
  TriMesh around{{mesh.points[static_cast<std::size_t>(point)]}, {}};
  for (const geometry::Triangle& t : mesh.triangles) {
    if (std::ranges::find(t, point) == t.end()) continue;
    geometry::Triangle own{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] == point) continue;
      own[k] = static_cast<std::int32_t>(around.points.size());
      around.points.push_back(mesh.points[static_cast<std::size_t>(t[k])]);
    }
    around.triangles.push_back(own);
  }
  return geometry::vertex_normals(around).front();
}

bool near_border(const SurfaceWays& ways, std::int32_t tip, double within_mm, Walked& walked) {
  bool found = false;
  ways.walk(tip, walked, [&](std::int32_t v, double d) {
    found = found || ways.on_border(v);
    return !found && d <= within_mm;
  });
  walked.forget();
  return found;
}

/// None where the peak is no branch, or an open end.
std::optional<SurfaceTip> tip_at(const SurfaceWays& ways, const Peak& peak,
                                 const std::vector<double>& distance, const TipOptions& options,
                                 Walked& walked) {
  if (!(peak.prominence > 0.0)) return std::nullopt;
  SurfaceTip tip;
  tip.length_mm = peak.prominence;
  tip.radius_mm = radius_near(ways, peak.point, peak.prominence, walked);
  if (tip.length_mm < options.least_length_radii * tip.radius_mm) return std::nullopt;
  if (near_border(ways, peak.point, from_border_radii * tip.radius_mm, walked)) return std::nullopt;
  tip.point = ways.mesh().points[static_cast<std::size_t>(peak.point)];
  tip.inside = tip.point - 0.5 * tip.radius_mm * normal_at(ways.mesh(), peak.point);
  if (tip.length_mm <= longest_neck_radii * tip.radius_mm)
    tip.neck = neck_of(ways, peak.point, tip.length_mm, walked);
  tip.way = way_back(ways, distance, peak.point);
  return tip;
}

}  // namespace

void validate(const TipOptions& options) {
  if (!(options.least_length_radii >= 2.0 && options.least_length_radii <= 50.0))
    throw InvalidInput("tips: least_length_radii " + std::to_string(options.least_length_radii) +
                       " must lie in [2, 50]");
}

std::vector<SurfaceTip> find_tips(const TriMesh& surface, const std::optional<Vec3>& from,
                                  const TipOptions& options, const core::TaskContext& task) {
  validate(options);
  if (surface.triangles.empty()) throw InvalidInput("tips: the surface has no triangles");
  const SurfaceWays ways(surface);
  std::int32_t start =
      nearest_point(ways, from.value_or(surface.points[static_cast<std::size_t>(surface.triangles[0][0])]));
  std::vector<double> distance = distances(ways, start);
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (distance[i] == infinite && ways.used(static_cast<std::int32_t>(i)))
      throw InvalidInput("tips: the surface has more than one part");
  if (!from) {
    start = farthest(distance);
    distance = distances(ways, start);
  }
  task.throw_if_cancelled();
  std::vector<Peak> peaks = peaks_of(ways, distance);
  if (!from) peaks.push_back({start, distance[static_cast<std::size_t>(farthest(distance))]});
  // The longest take the longest, each a walk over its branch: they are dealt out one by one.
  constexpr std::size_t hands = 4;
  std::ranges::stable_sort(peaks, std::greater{}, &Peak::prominence);
  std::vector<std::optional<SurfaceTip>> found(peaks.size());
  core::parallel_for(hands, 1, [&](std::size_t hand) {
    Walked walked(surface.points.size());
    for (std::size_t i = hand; i < peaks.size(); i += hands) {
      task.throw_if_cancelled();
      found[i] = tip_at(ways, peaks[i], distance, options, walked);
    }
  });
  std::vector<SurfaceTip> tips;
  for (std::optional<SurfaceTip>& tip : found)
    if (tip) tips.push_back(std::move(*tip));
  return tips;
}

}  // namespace ostia::centerline
