#include "intake/spikes.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

/// Triangles about a spike have more than so many times the area of their ring: a cone of 37 degrees has.
constexpr double steepest_area = 3.0;
/// Where they stab through others so many times are enough: a cone of 48 degrees. A point of a flat cap's rim
/// whose triangles cross others in the cap's own plane is none.
constexpr double stabbing_area = 1.5;
constexpr std::size_t fewest_neighbours = 3;
/// A spike is one point of many: of a tetrahedron every corner would be one.
constexpr std::size_t smallest_share = 8;
constexpr int rounds = 3;  // a spike beside a spike shows when the first is gone

class Rings {
 public:
  explicit Rings(const TriMesh& mesh)
      : mesh_(mesh),
        neighbours_(geometry::vertex_neighbours(mesh)),
        on_border_(mesh.points.size(), false),
        area_(mesh.points.size(), 0.0),
        base_(mesh.points.size(), Vec3::Zero()) {
    std::vector<std::size_t> triangles(mesh.points.size(), 0);
    for (const geometry::Triangle& t : mesh.triangles) {
      const auto at = [&](std::size_t k) -> const Vec3& {
        return mesh.points[static_cast<std::size_t>(t[k])];
      };
      const Vec3 doubled = (at(1) - at(0)).cross(at(2) - at(0));
      for (const std::int32_t p : t) {
        ++triangles[static_cast<std::size_t>(p)];
        area_[static_cast<std::size_t>(p)] += doubled.norm();
        base_[static_cast<std::size_t>(p)] += doubled;
      }
    }
    // All round a point there are as many triangles as neighbours.
    for (std::size_t p = 0; p < mesh.points.size(); ++p)
      on_border_[p] = triangles[p] != neighbours_[p].size();
  }

  const std::vector<std::int32_t>& of(std::size_t point) const { return neighbours_[point]; }

  Vec3 middle(std::size_t point) const {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t n : of(point)) sum += mesh_.points[static_cast<std::size_t>(n)];
    return sum / static_cast<double>(of(point).size());
  }

  /// Whether the point is a spike, and how far it stands off its neighbours' middle over their mean distance
  /// from it; 0 for none and on a border.
  double steepness(std::size_t point, bool stabs) const {
    if (on_border_[point] || of(point).size() < fewest_neighbours) return 0.0;
    if (smallest_share * of(point).size() > mesh_.points.size()) return 0.0;
    const Vec3 centre = middle(point);
    double reach = 0.0;
    for (const std::int32_t n : of(point))
      reach += (mesh_.points[static_cast<std::size_t>(n)] - centre).norm();
    reach /= static_cast<double>(of(point).size());
    const double high = (mesh_.points[point] - centre).norm();
    if (!(high > reach)) return 0.0;
    if (!(area_[point] > (stabs ? stabbing_area : steepest_area) * base_[point].norm())) return 0.0;
    return high / std::max(reach, 1e-12 * high);
  }

  /// Where its neighbours' bending, each off its own neighbours' middle, goes on.
  Vec3 smooth_place(std::size_t point) const {
    Vec3 bent = Vec3::Zero();
    for (const std::int32_t n : of(point)) {
      const auto i = static_cast<std::size_t>(n);
      bent += mesh_.points[i] - middle(i);
    }
    return middle(point) + bent / static_cast<double>(of(point).size());
  }

 private:
  const TriMesh& mesh_;
  std::vector<std::vector<std::int32_t>> neighbours_;
  std::vector<bool> on_border_;
  std::vector<double> area_;  ///< of a point's triangles, doubled
  std::vector<Vec3> base_;    ///< their vector area, doubled: that of the ring, wherever the point is
};

/// Points of triangles that intersect others.
std::vector<bool> stabbing(const TriMesh& mesh, const Crossings& crossings) {
  std::vector<bool> at(mesh.points.size(), false);
  for (const auto& [a, b] : crossings)
    for (const std::int32_t t : {a, b})
      for (const std::int32_t p : mesh.triangles[static_cast<std::size_t>(t)])
        at[static_cast<std::size_t>(p)] = true;
  return at;
}

/// The steepest first: a spike makes its neighbours look steep.
std::vector<std::size_t> found(const TriMesh& mesh, const Rings& rings, const Crossings& crossings) {
  const std::vector<bool> stabs = stabbing(mesh, crossings);
  std::vector<std::pair<double, std::size_t>> steepest;
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    if (const double s = rings.steepness(p, stabs[p]); s > 0.0) steepest.emplace_back(-s, p);
  std::ranges::sort(steepest);
  std::vector<std::size_t> spikes;
  std::vector<bool> taken(mesh.points.size(), false);
  for (const auto& [negative, p] : steepest) {
    if (taken[p]) continue;
    spikes.push_back(p);
    for (const std::int32_t n : rings.of(p)) taken[static_cast<std::size_t>(n)] = true;
  }
  return spikes;
}

}  // namespace

bool has_spikes(const TriMesh& mesh) {
  const Rings rings(mesh);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    if (rings.steepness(p, false) > 0.0) return true;
  return false;
}

PulledIn pull_in_spikes(TriMesh& mesh) {
  constexpr int settles = 3;  // neighbours' bending is known once the spike no longer pulls at it
  PulledIn out;
  for (int round = 0; round < rounds; ++round) {
    const Rings rings(mesh);
    Crossings crossings = geometry::self_intersections(mesh);
    const std::vector<std::size_t> spikes = found(mesh, rings, crossings);
    if (spikes.empty()) {
      out.crossings = std::move(crossings);
      break;
    }
    out.count += spikes.size();
    for (const std::size_t p : spikes) mesh.points[p] = rings.middle(p);
    for (int k = 0; k < settles; ++k)
      for (const std::size_t p : spikes) mesh.points[p] = rings.smooth_place(p);
  }
  return out;
}

}  // namespace ostia::pipeline
