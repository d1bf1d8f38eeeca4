#include "branches/plane_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace ostia::analysis {
namespace {

using geometry::TriMesh;
using geometry::Vec2;
using geometry::Vec3;

/// Crossings of the plane with edges, and which two each triangle joins.
class Crossings {
 public:
  Crossings(const TriMesh& mesh, const Vec3& origin, const Vec3& normal) : mesh_(mesh) {
    height_.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) height_.push_back((p - origin).dot(normal));
    for (const geometry::Triangle& t : mesh.triangles) {
      std::array<std::int32_t, 2> ends{};
      std::size_t count = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = t[k], b = t[(k + 1) % 3];
        if (front(a) != front(b) && count < 2) ends[count++] = crossing_of(a, b);
      }
      if (count != 2 || ends[0] == ends[1]) continue;
      const auto side = static_cast<std::int32_t>(sides_.size());
      sides_.push_back(ends);
      for (const std::int32_t end : ends) at_[static_cast<std::size_t>(end)].push_back(side);
    }
  }

  std::vector<PlaneOutline> outlines() {
    std::vector<PlaneOutline> all;
    used_.assign(sides_.size(), false);
    // Lines with ends first, from one of them.
    for (const bool ended : {true, false})
      for (std::size_t p = 0; p < points_.size(); ++p)
        if (!ended || at_[p].size() == 1) follow(static_cast<std::int32_t>(p), all);
    return all;
  }

 private:
  bool front(std::int32_t point) const { return height_[static_cast<std::size_t>(point)] >= 0.0; }

  std::int32_t crossing_of(std::int32_t a, std::int32_t b) {
    if (a > b) std::swap(a, b);
    constexpr int half = 32;
    const std::int64_t key = (static_cast<std::int64_t>(a) << half) | b;
    const auto [found, fresh] = index_.try_emplace(key, static_cast<std::int32_t>(points_.size()));
    if (fresh) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const double t = height_[i] / (height_[i] - height_[j]);
      points_.push_back((1.0 - t) * mesh_.points[i] + t * mesh_.points[j]);
      at_.emplace_back();
    }
    return found->second;
  }

  std::int32_t free_side(std::int32_t point) const {
    for (const std::int32_t side : at_[static_cast<std::size_t>(point)])
      if (!used_[static_cast<std::size_t>(side)]) return side;
    return -1;
  }

  void follow(std::int32_t start, std::vector<PlaneOutline>& all) {
    PlaneOutline outline;
    std::int32_t at = start;
    for (std::int32_t side = free_side(at); side >= 0; side = free_side(at)) {
      outline.points.push_back(points_[static_cast<std::size_t>(at)]);
      used_[static_cast<std::size_t>(side)] = true;
      const auto& ends = sides_[static_cast<std::size_t>(side)];
      at = ends[0] == at ? ends[1] : ends[0];
      if (at == start) {
        outline.closed = true;
        break;
      }
    }
    if (outline.points.empty()) return;
    if (!outline.closed) outline.points.push_back(points_[static_cast<std::size_t>(at)]);
    all.push_back(std::move(outline));
  }

  const TriMesh& mesh_;
  std::vector<double> height_;
  std::unordered_map<std::int64_t, std::int32_t> index_;  // crossings by edge
  std::vector<Vec3> points_;
  std::vector<std::array<std::int32_t, 2>> sides_;
  std::vector<std::vector<std::int32_t>> at_;  // sides at each crossing
  std::vector<bool> used_;
};

template <class Vector>
Vector nearest_on_side(const Vector& a, const Vector& b, const Vector& x) {
  const double length = (b - a).squaredNorm();
  const double t = length > 0.0 ? std::clamp((x - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return a + t * (b - a);
}

double cross2(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// How far from the origin along a direction the polygon is crossed last; 0 where it is not.
double last_crossing(const std::vector<Vec2>& polygon, const Vec2& direction) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = cross2(direction, a), at_b = cross2(direction, b);
    if ((at_a < 0.0) == (at_b < 0.0)) continue;
    const Vec2 place = a + at_a / (at_a - at_b) * (b - a);
    farthest = std::max(farthest, place.dot(direction));
  }
  return farthest;
}

}  // namespace

std::vector<PlaneOutline> plane_outlines(const TriMesh& mesh, const Vec3& origin, const Vec3& normal) {
  return Crossings(mesh, origin, normal).outlines();
}

double distance_to(const PlaneOutline& outline, const Vec3& place) {
  const std::vector<Vec3>& p = outline.points;
  double least = (p.front() - place).norm();
  for (std::size_t i = 0; i + (outline.closed ? 0 : 1) < p.size(); ++i)
    least = std::min(least, (nearest_on_side(p[i], p[(i + 1) % p.size()], place) - place).norm());
  return least;
}

PolygonMeasures polygon_measures(const PlaneOutline& outline, const Vec3& centre, const Vec3& normal) {
  const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
  std::vector<Vec2> polygon;
  for (const Vec3& p : outline.points) polygon.emplace_back((p - centre).dot(x), (p - centre).dot(y));
  PolygonMeasures out;
  double twice_area = 0.0;
  Vec2 near = polygon.front(), far = polygon.front();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice_area += cross2(a, b);
    if (a.squaredNorm() > far.squaredNorm()) far = a;
    if (!outline.closed && i + 1 == polygon.size()) continue;
    out.perimeter_mm += (b - a).norm();
    const Vec2 place = nearest_on_side(a, b, Vec2(Vec2::Zero()));
    if (place.squaredNorm() < near.squaredNorm()) near = place;
  }
  out.area_mm2 = 0.5 * std::abs(twice_area);
  if (near.norm() > 0.0) out.min_mm = near.norm() + last_crossing(polygon, -near.normalized());
  if (far.norm() > 0.0) out.max_mm = far.norm() + last_crossing(polygon, -far.normalized());
  return out;
}

}  // namespace ostia::analysis
