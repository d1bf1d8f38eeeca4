#pragma once
/// \file Images of a coronary-like tree over a heartbeat, whose lumen is known, for the tests of motions.

#include "beating_tree.h"

#include "ostia/core/parallel.h"
#include "ostia/imaging/volume.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace ostia::motion::testing {

/// 14 mm at the farthest, half a cycle from 75 %: from one of ten phases to the next, up to 4 mm.
inline double far_amount_at(double phase) {
  return 0.55 * (1.0 - std::cos(2.0 * std::numbers::pi * (phase - 0.75)));
}

/// Where a place of the beaten heart was at rest: the exact inverse of `beat`.
inline Vec3 unbeaten(const Vec3& p, double amount) {
  const Vec3 centre(20.0, 10.0, 30.0);
  Vec3 q = p - centre;
  q.z() -= 4.0 * amount;
  q.y() -= 3.0 * amount;
  // The shift along x was taken from the height before the heart was made shorter, and after it was turned.
  const double low = q.z() / (1.0 - 0.15 * amount);
  q.x() -= 2.0 * amount * std::sin(q.z() / 25.0);
  q.x() /= 1.0 - 0.12 * amount;
  q.y() /= 1.0 - 0.12 * amount;
  q.z() = low;
  return centre + Eigen::AngleAxisd(-amount * 0.2 * (1.0 + low / 40.0), Vec3::UnitZ()) * q;
}

/// HU of the heart at rest: fat, a muscle with a cavity of blood below the tree, and the tree full of
/// contrast and wider by `swell_mm` all around, all blurred.
inline double still_value(const geometry::TubeDistance& tree, const Vec3& p, double swell_mm) {
  const auto inside = [](double distance, double blur) {
    return 0.5 * std::erfc(distance / (blur * 1.4142));
  };
  const double muscle = (p - Vec3(24.0, -6.0, 30.0)).norm();
  const double around = -80.0 + 170.0 * inside(muscle - 22.0, 1.0) + 200.0 * inside(muscle - 12.0, 1.0);
  const double distance = tree(p) - swell_mm;
  return distance > 4.0 ? around : around + (380.0 - around) * inside(distance, 0.5);
}

inline const geometry::AnalyticShape& tree_shape() {
  static const geometry::AnalyticShape shape = geometry::coronary_like_tree();
  return shape;
}

/// Voxels of `spacing_mm` about the whole beat.
inline imaging::Geometry beating_grid(double spacing_mm) {
  geometry::Box3 box = tree_shape().box;
  for (const Vec3& p : still_tree().points) box.extend(beat(p, far_amount_at(0.25)));
  imaging::Geometry grid;
  grid.spacing = Vec3::Constant(spacing_mm);
  grid.origin = box.min() - Vec3::Constant(8.0);
  for (std::size_t a = 0; a < 3; ++a)
    grid.size[a] =
        static_cast<std::int64_t>(std::ceil((box.sizes()[static_cast<Eigen::Index>(a)] + 16.0) / spacing_mm));
  return grid;
}

/// The image of one phase on a grid, with 20 HU of noise of its own.
inline imaging::ImageVolume beating_image(double phase, const imaging::Geometry& grid,
                                          double swell_mm = 0.0) {
  static const geometry::TubeDistance tree(tree_shape());
  const double amount = far_amount_at(phase);
  imaging::ImageVolume image{grid, std::vector<std::int16_t>(static_cast<std::size_t>(grid.voxels()))};
  const std::int64_t slice = grid.size[0] * grid.size[1];
  core::parallel_for(static_cast<std::size_t>(grid.size[2]), 1, [&](std::size_t k) {
    std::mt19937 random(static_cast<unsigned>(1000.0 * phase) * 1000 + static_cast<unsigned>(k));
    std::normal_distribution<double> noise(0.0, 20.0);
    for (std::int64_t at = 0; at < slice; ++at) {
      const Vec3 index(static_cast<double>(at % grid.size[0]), static_cast<double>(at / grid.size[0]),
                       static_cast<double>(k));
      const double value = still_value(tree, unbeaten(grid.world(index), amount), swell_mm) + noise(random);
      image.voxels[static_cast<std::size_t>(at + static_cast<std::int64_t>(k) * slice)] =
          static_cast<std::int16_t>(std::lround(value));
    }
  });
  return image;
}

}  // namespace ostia::motion::testing
