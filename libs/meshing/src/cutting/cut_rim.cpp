#include "cutting/cut_rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <unordered_map>
#include <vector>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

constexpr double reach_radii = 0.3;  // about an edge of the mesh that is to be made

/// The triangles near an end's plane, by their corners.
class Surroundings {
 public:
  Surroundings(const geometry::TriMesh& mesh, const EndPlane& plane) : mesh_(mesh), plane_(plane) {
    const double reach = 2.0 * reach_radii * plane.radius_mm;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      if (std::ranges::any_of(mesh.triangles[i],
                              [&](std::int32_t v) { return std::abs(height(at(v))) < reach; }))
        for (const std::int32_t v : mesh.triangles[i]) triangles_[v].push_back(i);
  }

  /// Points that were cut, in their order in the mesh.
  std::set<std::int32_t> rim() const {
    std::set<std::int32_t> points;
    for (const auto& [v, triangles] : triangles_)
      if (std::abs(height(at(v))) < 1e-9 * (1.0 + at(v).norm()) &&
          (at(v) - plane_.origin).norm() < 20.0 * plane_.radius_mm)
        points.insert(v);
    return points;
  }

  /// Area vectors of the triangles around a point summed, found from neighbour to neighbour.
  Vec3 mean_normal(std::int32_t from) const {
    Vec3 sum = Vec3::Zero();
    std::set<std::size_t> seen;
    std::vector<std::int32_t> front{from};
    std::set<std::int32_t> reached{from};
    while (!front.empty()) {
      const auto around = triangles_.find(front.back());
      front.pop_back();
      if (around == triangles_.end()) continue;
      for (const std::size_t t : around->second) {
        if ((centre(t) - at(from)).norm() > reach_radii * plane_.radius_mm && !seen.empty()) continue;
        if (!seen.insert(t).second) continue;
        const geometry::Triangle& corners = mesh_.triangles[t];
        sum += (at(corners[1]) - at(corners[0])).cross(at(corners[2]) - at(corners[0]));
        for (const std::int32_t v : corners)
          if (reached.insert(v).second) front.push_back(v);
      }
    }
    return sum;
  }

  const Vec3& at(std::int32_t v) const { return mesh_.points[static_cast<std::size_t>(v)]; }

 private:
  double height(const Vec3& p) const { return (p - plane_.origin).dot(plane_.normal); }
  Vec3 centre(std::size_t t) const {
    const geometry::Triangle& c = mesh_.triangles[t];
    return (at(c[0]) + at(c[1]) + at(c[2])) / 3.0;
  }

  const geometry::TriMesh& mesh_;
  const EndPlane& plane_;
  std::unordered_map<std::int32_t, std::vector<std::size_t>> triangles_;
};

}  // namespace

RimWedge sharpest_rim(const geometry::TriMesh& cut, const EndPlane& plane) {
  const Surroundings near(cut, plane);
  RimWedge sharpest;
  for (const std::int32_t v : near.rim()) {
    const Vec3 normal = near.mean_normal(v);
    if (normal.isZero(0.0)) continue;
    const double cosine = -normal.normalized().dot(plane.normal);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
    if (angle < sharpest.angle_deg) sharpest = {angle, near.at(v)};
  }
  return sharpest;
}

}  // namespace ostia::meshing
