#pragma once
/// \file A heart of formulas scanned twice: where each point of the first scan lies in the second is known.

#include "ostia/imaging/volume.h"
#include "ostia/registration/register.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace two_scans {

using ostia::geometry::Mat3;
using ostia::geometry::Vec3;
using ostia::imaging::Geometry;
using ostia::imaging::ImageVolume;

/// 1 inside, 0 outside, over some 2 mm.
inline double inside(double depth_mm) {
  return 1.0 / (1.0 + std::exp(-2.0 * depth_mm));
}
inline double ellipsoid(const Vec3& x, const Vec3& centre, const Vec3& half) {
  return inside((1.0 - (x - centre).cwiseQuotient(half).norm()) * half.minCoeff());
}
inline double tube(const Vec3& x, const Vec3& a, const Vec3& b, double radius_mm) {
  const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return inside(radius_mm - (x - a - t * (b - a)).norm());
}

/// The vessels, as straight pieces over the heart.
inline std::vector<std::pair<Vec3, Vec3>> vessels() {
  return {{{-8, -20, 34}, {-30, -26, 14}},   {{-30, -26, 14}, {-40, -14, -18}},
          {{-30, -26, 14}, {-14, -34, -26}}, {{6, -18, 34}, {34, -20, 10}},
          {{34, -20, 10}, {40, 6, -16}},     {{34, -20, 10}, {22, 30, -20}}};
}
inline std::vector<Vec3> axis_points() {
  std::vector<Vec3> points;
  for (const auto& [a, b] : vessels())
    for (int i = 0; i <= 10; ++i) points.push_back(a + 0.1 * i * (b - a));
  return points;
}

struct Blood {
  double ventricles_hu = 350.0, vessels_hu = 380.0;
};

/// HU of the heart at rest: lung, fat, muscle, four chambers of different sizes, aorta and coronary arteries.
inline double heart_hu(const Vec3& x, const Blood& blood = {}) {
  double hu = -800.0;
  const auto put = [&](double share, double value) { hu += share * (value - hu); };
  put(ellipsoid(x, {0, 0, 0}, {52, 46, 44}), -90.0);
  put(ellipsoid(x, {0, 2, -4}, {44, 38, 36}), 70.0);
  put(ellipsoid(x, {16, 4, -8}, {17, 15, 22}), blood.ventricles_hu);
  put(ellipsoid(x, {-18, 2, -6}, {13, 17, 18}), blood.ventricles_hu - 80.0);
  put(ellipsoid(x, {10, 16, 20}, {14, 10, 9}), blood.ventricles_hu);
  put(tube(x, {0, -8, 20}, {-4, -2, 60}, 11.0), blood.ventricles_hu);
  for (const auto& [a, b] : vessels()) put(tube(x, a, b, 2.2), blood.vessels_hu);
  return hu;
}

/// From the second scan's world back to the first one's: turned and shifted, then bent.
struct Way {
  double angle_deg = 0.0;
  Vec3 shift_mm = Vec3::Zero();
  double bend_mm = 0.0;

  Mat3 turn() const {
    return Eigen::AngleAxisd(angle_deg * M_PI / 180.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  }
  Vec3 operator()(const Vec3& moving_mm) const {
    const Vec3 x = turn().transpose() * (moving_mm - shift_mm);
    return x + bend_mm * Vec3(std::sin(x.y() / 22.0) * std::cos(x.z() / 25.0),
                              std::cos(x.x() / 24.0) * std::sin(x.z() / 20.0),
                              std::sin(x.x() / 21.0 + x.y() / 30.0));
  }
};

inline ImageVolume scanned(const Geometry& grid, const std::function<double(const Vec3&)>& hu,
                           unsigned noise_seed) {
  ImageVolume image;
  image.geometry = grid;
  std::uint32_t state = noise_seed * 747796405U + 1U;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        state = state * 1664525U + 1013904223U;
        const double noise = 40.0 * (static_cast<double>(state >> 8) / 16777216.0 - 0.5);
        const Vec3 x =
            grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(hu(x) + noise)));
      }
  return image;
}

inline Geometry grid_about(const Vec3& centre, double voxel_mm = 2.0, std::int64_t size = 60) {
  Geometry grid;
  grid.size = {size, size, size};
  grid.spacing = Vec3::Constant(voxel_mm);
  grid.origin = centre - Vec3::Constant(0.5 * voxel_mm * static_cast<double>(size - 1));
  return grid;
}

inline ImageVolume first_scan() {
  return scanned(
      grid_about(Vec3::Zero()), [](const Vec3& x) { return heart_hu(x); }, 1);
}
/// `axes`: those of the second scan's voxels.
inline ImageVolume second_scan(const Way& way, const Blood& blood = {}, const Vec3& centre = Vec3::Zero(),
                               const Mat3& axes = Mat3::Identity()) {
  Geometry grid = grid_about(Vec3::Zero());
  grid.direction = axes;
  grid.origin = axes * grid.origin + centre;
  return scanned(
      grid, [&](const Vec3& x) { return heart_hu(way(x), blood); }, 2);
}

/// Points all over the heart in the second scan's world: a lattice, of those whose place in the first scan is
/// well in it.
inline std::vector<Vec3> landmarks_of(const Way& way) {
  std::vector<Vec3> points;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      for (int k = -4; k <= 4; ++k) {
        const Vec3 q = way.shift_mm + way.turn() * Vec3(9.0 * i, 9.0 * j, 9.0 * k);
        if (way(q).cwiseQuotient(Vec3(42, 37, 36)).norm() < 1.0) points.push_back(q);
      }
  return points;
}

inline double mean_error_mm(const Way& way, const ostia::registration::Transform& found,
                            const std::vector<Vec3>& moving) {
  double sum = 0.0;
  for (const Vec3& q : moving) sum += (found(way(q)) - q).norm();
  return sum / static_cast<double>(moving.size());
}

/// Where a point of the first scan lies in the second.
inline Vec3 there(const Way& way, const Vec3& fixed_mm) {
  Vec3 q = way.turn() * fixed_mm + way.shift_mm;
  for (int i = 0; i < 60; ++i) q += way.turn() * (fixed_mm - way(q));
  return q;
}

/// Small and quick.
inline ostia::registration::RegistrationOptions small_options() {
  ostia::registration::RegistrationOptions options;
  options.linear_voxel_mm = 4.0;
  options.finest_voxel_mm = 2.0;
  options.samples = 15000;
  options.levels = 2;
  options.node_spacing_mm = 14.0;
  return options;
}

}  // namespace two_scans
