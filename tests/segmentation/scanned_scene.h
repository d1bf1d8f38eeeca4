#pragma once
/// \file Scenes about an axis as a scanner shows them: blurred, on a grid turned in the world, with noise.

#include "ostia/core/parallel.h"
#include "ostia/geometry/centerline.h"
#include "ostia/imaging/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace ostia::segmentation::testing {

using geometry::Vec3;
using Scene = std::function<double(const Vec3&)>;

constexpr double fine_mm = 0.15, blur_mm = 0.3;

/// One pass of a Gaussian along each axis, borders clamped.
inline void blur(imaging::FloatVolume& image, double sigma_mm) {
  const auto& g = image.geometry;
  for (int axis = 0; axis < 3; ++axis) {
    const int reach = static_cast<int>(std::ceil(4.0 * sigma_mm / g.spacing[axis]));
    std::vector<float> kernel;
    float sum = 0.0F;
    for (int i = -reach; i <= reach; ++i) {
      const double x = i * g.spacing[axis] / sigma_mm;
      kernel.push_back(static_cast<float>(std::exp(-0.5 * x * x)));
      sum += kernel.back();
    }
    const imaging::FloatVolume from = image;
    for (std::int64_t k = 0; k < g.size[2]; ++k)
      for (std::int64_t j = 0; j < g.size[1]; ++j)
        for (std::int64_t i = 0; i < g.size[0]; ++i) {
          float value = 0.0F;
          for (int d = -reach; d <= reach; ++d) {
            std::array<std::int64_t, 3> at{i, j, k};
            at[axis] = std::clamp<std::int64_t>(at[axis] + d, 0, g.size[axis] - 1);
            value += kernel[d + reach] * from(at[0], at[1], at[2]);
          }
          image(i, j, k) = value / sum;
        }
  }
}

struct Shot {
  imaging::ImageVolume image;
  geometry::Centerline line;  ///< the scene's z axis in the world
};

/// A scene of 9 x 9 x 16 mm about its z axis as a scanner shows it: painted with 8 pieces a fine voxel,
/// blurred, every second voxel kept (0.3 mm), noise added; the grid's axes are turned in the world.
inline Shot scan(const Scene& scene, double noise_hu = 0.0, unsigned seed = 1) {
  imaging::FloatVolume paint;
  imaging::Geometry& g = paint.geometry;
  g.size = {60, 60, 108};
  g.spacing = Vec3::Constant(fine_mm);
  g.direction =
      (Eigen::AngleAxisd(0.5, Vec3::UnitX()) * Eigen::AngleAxisd(0.3, Vec3::UnitZ())).toRotationMatrix();
  g.origin = Vec3(10.0, -20.0, 30.0);
  paint.voxels.resize(static_cast<std::size_t>(g.voxels()));
  const auto local = [&](double i, double j, double k) {
    return Vec3((i - 29.5) * fine_mm, (j - 29.5) * fine_mm, k * fine_mm);
  };
  core::parallel_for(static_cast<std::size_t>(g.size[2]), 4, [&](std::size_t k) {
    for (std::int64_t j = 0; j < g.size[1]; ++j)
      for (std::int64_t i = 0; i < g.size[0]; ++i) {
        double sum = 0.0;
        for (int n = 0; n < 8; ++n)
          sum += scene(local(i + (n & 1 ? 0.25 : -0.25), j + (n & 2 ? 0.25 : -0.25),
                             static_cast<double>(k) + (n & 4 ? 0.25 : -0.25)));
        paint(i, j, static_cast<std::int64_t>(k)) = static_cast<float>(sum / 8.0);
      }
  });
  blur(paint, blur_mm);
  Shot out;
  out.image.geometry = g;
  out.image.geometry.size = {30, 30, 54};
  out.image.geometry.spacing = Vec3::Constant(2.0 * fine_mm);
  imaging::FloatVolume noise;
  noise.geometry = out.image.geometry;
  noise.voxels.resize(static_cast<std::size_t>(noise.geometry.voxels()));
  std::mt19937 generator(seed);
  double power = 0.0;
  for (float& value : noise.voxels) value = static_cast<float>(generator() / 4294967296.0 - 0.5);
  blur(noise, 0.4);
  for (const float value : noise.voxels) power += value * value / static_cast<double>(noise.voxels.size());
  out.image.voxels.resize(noise.voxels.size());
  for (std::int64_t k = 0; k < 54; ++k)
    for (std::int64_t j = 0; j < 30; ++j)
      for (std::int64_t i = 0; i < 30; ++i)
        out.image(i, j, k) = static_cast<std::int16_t>(
            std::lround(paint(2 * i, 2 * j, 2 * k) + noise_hu / std::sqrt(power) * noise(i, j, k)));
  for (double k = 3.0; k <= 103.0; k += 2.0) out.line.points.push_back(g.world(Vec3(29.5, 29.5, k)));
  geometry::complete(out.line, g.direction.col(0));
  return out;
}

}  // namespace ostia::segmentation::testing
