#include "meshing/cut_handle.h"

#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double reach_units = 8.0;
constexpr double beyond_box = 1.04;  // so that the frame is not in the mesh's own sides
constexpr double arrow_share = 0.5;  // of the frame's shorter half side
constexpr double head_share = 0.2;   // of the arrow's half length

/// One that is not nearly along the normal.
Vec3 sideways(const Vec3& normal) {
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 axis = Vec3::Unit(least);
  return (axis - axis.dot(normal) * normal).normalized();
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

}  // namespace

std::vector<std::vector<Vec3>> cut_handle(const view::MeshCut& cut, const Vec3& sizes_mm) {
  const Vec3 n = cut.normal.normalized(), u = sideways(n), v = n.cross(u);
  const auto reach = [&](const Vec3& direction) {
    return beyond_box * direction.cwiseAbs().dot(0.5 * sizes_mm);
  };
  const Vec3 across = reach(u) * u, up = reach(v) * v, &at = cut.point;
  const double length = arrow_share * std::min(across.norm(), up.norm()), head = head_share * length;
  std::vector<std::vector<Vec3>> lines{
      {at - across - up, at + across - up, at + across + up, at - across + up, at - across - up},
      {at - length * n, at + length * n}};
  for (const double way : {-1.0, 1.0}) {
    const Vec3 tip = at + way * length * n, root = tip - way * head * n;
    for (const Vec3& side : {u, v})
      lines.push_back({root - 0.6 * head * side, tip, root + 0.6 * head * side});
  }
  return lines;
}

bool near_lines(const view::TreeScene& scene, const std::vector<std::vector<Vec3>>& lines,
                const Vec2& display) {
  const double reach = reach_units * scene.pixel_ratio();
  return std::ranges::any_of(lines, [&](const std::vector<Vec3>& line) {
    for (std::size_t i = 1; i < line.size(); ++i)
      if (distance(display, scene.project(line[i - 1]), scene.project(line[i])) < reach) return true;
    return false;
  });
}

}  // namespace ostia::workstation
