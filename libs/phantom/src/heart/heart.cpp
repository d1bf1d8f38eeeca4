#include "ostia/phantom/heart.h"

#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

/// Stream of the heart's own random numbers.
constexpr std::uint64_t first_index = 0x4845415254000000;

Vec3 across(const Vec3& v, const Vec3& axis) {
  return (v - axis * axis.dot(v)).normalized();
}

}  // namespace

Vec3 HeartShape::epicardium(double phi_rad, double depth, double outwards_mm) const {
  const double wide = std::sqrt(std::max(0.0, 1.0 - depth * depth));
  const Vec3 p =
      base + depth * length_mm * long_axis +
      wide * (half_width_right_mm * std::cos(phi_rad) * right + half_width_up_mm * std::sin(phi_rad) * up);
  return p + outwards_mm * epicardial_normal(phi_rad, depth);
}

Vec3 HeartShape::epicardial_normal(double phi_rad, double depth) const {
  const double wide = std::sqrt(std::max(0.0, 1.0 - depth * depth));
  return (depth / length_mm * long_axis + wide * std::cos(phi_rad) / half_width_right_mm * right +
          wide * std::sin(phi_rad) / half_width_up_mm * up)
      .normalized();
}

double HeartShape::epicardial_distance(const Vec3& point) const {
  const Vec3 d = point - base;
  const Vec3 q(d.dot(right) / half_width_right_mm, d.dot(up) / half_width_up_mm,
               d.dot(long_axis) / length_mm);
  const Vec3 g(q.x() / half_width_right_mm, q.y() / half_width_up_mm, q.z() / length_mm);
  const double norm = q.norm(), slope = g.norm();
  if (slope <= 0.0) return -std::min({half_width_right_mm, half_width_up_mm, length_mm});
  return norm * (norm - 1.0) / slope;
}

HeartShape draw_heart(std::uint64_t seed) {
  std::uint64_t index = first_index;
  const auto about = [&](double mean, double deviation) {
    const double x = normal(seed, index++);
    return mean + deviation * std::clamp(x, -2.0, 2.0);
  };
  HeartShape heart;
  heart.long_axis = Vec3(about(0.65, 0.04), about(-0.55, 0.04), about(-0.52, 0.04)).normalized();
  heart.right = across(Vec3(-0.75, -0.6, -0.25), heart.long_axis);
  heart.up = heart.right.cross(heart.long_axis);
  heart.length_mm = about(92.0, 4.0);
  heart.half_width_right_mm = about(46.0, 2.0);
  heart.half_width_up_mm = about(40.0, 1.5);
  heart.anterior_groove_rad = about(2.02, 0.05);
  heart.posterior_groove_rad = about(-1.75, 0.06);
  AorticRoot& root = heart.root;
  root.annulus = heart.base + about(9.0, 1.0) * heart.up + about(3.0, 1.0) * heart.right;
  root.axis = Vec3(about(-0.28, 0.04), about(-0.16, 0.04), 0.95).normalized();
  root.annulus_radius_mm = about(12.0, 0.7);
  root.sinus_radius_mm = about(16.5, 0.8);
  root.sinus_height_mm = about(20.0, 1.0);
  root.ascending_radius_mm = about(15.0, 1.0);
  root.left_sinus = across(Vec3(0.9, 0.35, 0.0), root.axis);
  root.right_sinus = across(Vec3(-0.25, -0.95, 0.0), root.axis);
  return heart;
}

}  // namespace ostia::phantom
