#include "ostia/glview/tree_camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>

namespace ostia::glview {

using geometry::Vec2;
using geometry::Vec3;

double TreeCamera::pixel_mm() const {
  return 2.0 * half_height * distance_mm / height_px;
}

std::optional<Vec2> TreeCamera::place_of(const Vec3& point) const {
  const Vec3 seen = point - eye();
  const double depth = -seen.dot(back);
  if (!(depth > 1e-9 * distance_mm)) return std::nullopt;
  const double unit = 2.0 * half_height / height_px * depth;
  return Vec2(0.5 * width_px + seen.dot(right) / unit, 0.5 * height_px - seen.dot(up) / unit);
}

CameraRay TreeCamera::ray(const Vec2& place) const {
  const double unit = 2.0 * half_height / height_px;
  const Vec3 across = (place.x() - 0.5 * width_px) * unit * right + (0.5 * height_px - place.y()) * unit * up;
  return {eye(), across - back, unit};
}

geometry::BlockView TreeCamera::view(double pixel_ratio) const {
  return {eye(),
          right,
          up,
          back,
          half_height * width_px / height_px,
          half_height,
          std::max(1, static_cast<int>(height_px * pixel_ratio))};
}

TreeCamera fitted(const TreeCamera& eye, const Vec3& low, const Vec3& high) {
  TreeCamera all = eye;
  all.target = 0.5 * low + 0.5 * high;
  const double narrow = std::min(1.0, static_cast<double>(eye.width_px) / eye.height_px);
  all.distance_mm = std::max(1e-6, 0.55 * (high - low).norm()) / (TreeCamera::half_height * narrow);
  return all;
}

TreeCamera turned(const TreeCamera& eye, const Vec2& by) {
  constexpr double step = 2.0 * std::numbers::pi / whole_turn_px;
  TreeCamera out = eye;
  const auto about = [&out](const Vec3& axis, double angle) {
    const Eigen::AngleAxisd rotation(angle, axis);
    out.right = (rotation * out.right).normalized();
    out.back = rotation * out.back;
    out.back = (out.back - out.back.dot(out.right) * out.right).normalized();
    out.up = out.back.cross(out.right);
  };
  about(Vec3(out.up), -step * by.x());
  about(Vec3(out.right), -step * by.y());
  return out;
}

TreeCamera moved(const TreeCamera& eye, const Vec2& by) {
  TreeCamera out = eye;
  out.target += eye.pixel_mm() * (-by.x() * eye.right + by.y() * eye.up);
  return out;
}

TreeCamera nearer(const TreeCamera& eye, double factor, const std::optional<Vec2>& at) {
  TreeCamera out = eye;
  out.distance_mm = std::clamp(eye.distance_mm * factor, 1e-9, 1e9);
  if (!at) return out;
  const Vec2 from = *at - 0.5 * Vec2(eye.width_px, eye.height_px);
  const double gone = eye.pixel_mm() - out.pixel_mm();
  out.target += gone * (from.x() * eye.right - from.y() * eye.up);
  return out;
}

}  // namespace ostia::glview
