#include "views/scene_drag.h"

namespace ostia::workstation {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double least_slope = 0.15;  // of the normal against the sight, as the sine of the angle

}  // namespace

double dragged_mm(const view::TreeScene& scene, const Vec3& point, const Vec3& normal, const Vec2& from,
                  const Vec2& to) {
  const view::CameraPose pose = scene.pose();
  const Vec2 origin = scene.project(point), along = scene.project(point + normal) - origin;
  const double px_per_mm = (scene.project(point + pose.up) - origin).norm();
  if (along.norm() >= least_slope * px_per_mm) return (to - from).dot(along) / along.squaredNorm();
  const double away = normal.dot(pose.towards) > 0.0 ? -1.0 : 1.0;
  return away * (to.y() - from.y()) / px_per_mm;
}

}  // namespace ostia::workstation
