#pragma once
/// \file A small case for tests of the window: a contrast-filled tube with a wall, along z in fat, with
/// noise.

#include "ostia/imaging/volume.h"
#include "ostia/lumen/start_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ostia::workstation::testing {

constexpr double tube_radius_mm = 1.5, tube_length_mm = 40.0;
constexpr double throat_mm = 24.0, half_narrowing_mm = 5.0;  // where a narrowing is wanted

/// Of the lumen at an abscissa; `narrowing` is the share of the radius that is missing at the throat.
inline double tube_radius(double s_mm, double narrowing) {
  const double from_throat = std::abs(s_mm - throat_mm) / half_narrowing_mm;
  return tube_radius_mm *
         (1.0 - (from_throat < 1.0 ? narrowing * 0.5 * (1.0 + std::cos(M_PI * from_throat)) : 0.0));
}

/// `at`: where the tube begins.
inline imaging::ImageVolume tube_image(double narrowing = 0.0,
                                       const geometry::Vec3& at = geometry::Vec3::Zero()) {
  imaging::ImageVolume image;
  image.geometry.size = {64, 64, 110};
  image.geometry.spacing = {0.4, 0.4, 0.4};
  image.geometry.origin = {-12.6, -12.6, -2.0};
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (std::int64_t k = 0; k < 110; ++k)
    for (std::int64_t j = 0; j < 64; ++j)
      for (std::int64_t i = 0; i < 64; ++i) {
        const geometry::Vec3 here = image.geometry.world({double(i), double(j), double(k)});
        const double r = std::hypot(here.x(), here.y());
        const auto within = [&](double radius) { return std::clamp(0.5 - (r - radius) / 0.7, 0.0, 1.0); };
        const double hu =
            -80.0 + 130.0 * within(tube_radius_mm + 0.8) + 350.0 * within(tube_radius(here.z(), narrowing));
        const double noise =
            40.0 * ((((i * 73 + j * 179 + k * 283) * 2654435761LL) >> 12) % 1000 / 1000.0 - 0.5);
        image(i, j, k) = static_cast<std::int16_t>(std::lround(hu + noise));
      }
  image.geometry.origin += at;
  return image;
}

inline lumen::LumenModel tube_model(double narrowing = 0.0,
                                    const geometry::Vec3& at = geometry::Vec3::Zero()) {
  geometry::Centerline axis;
  for (int i = 0; i <= 80; ++i) {
    axis.points.push_back(at + geometry::Vec3(0.0, 0.0, 0.5 * i));
    axis.radius.push_back(tube_radius(0.5 * i, narrowing));
  }
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, axis}};
  tree.vessels = {{4, "LAD", {3}}};
  return lumen::model_of_tubes(tree);
}

constexpr double second_tube_x_mm = 8.0;

/// The tube, LAD, and another one beside it, RCA, that does not hang on it.
inline lumen::LumenModel two_tubes() {
  geometry::VesselTree tree;
  for (int k = 0; k < 2; ++k) {
    geometry::Centerline axis;
    for (int i = 0; i <= 80; ++i) {
      axis.points.push_back({k * second_tube_x_mm, 0.0, 0.5 * i});
      axis.radius.push_back(tube_radius_mm);
    }
    geometry::complete(axis);
    tree.nodes.push_back({10 * k + 1, axis.points.front()});
    tree.nodes.push_back({10 * k + 2, axis.points.back()});
    tree.segments.push_back({10 * k + 3, 10 * k + 1, 10 * k + 2, axis});
    tree.vessels.push_back({10 * k + 4, k == 0 ? "LAD" : "RCA", {10 * k + 3}});
  }
  return lumen::model_of_tubes(tree);
}

}  // namespace ostia::workstation::testing
