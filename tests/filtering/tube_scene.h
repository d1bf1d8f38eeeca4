#pragma once
/// \file A vessel's surroundings as ours and ITK's filters are given them: for tests and benchmarks.

#include "tube_images.h"

#include "ostia/imaging/volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ostia::filtering::peers {

using imaging::FloatVolume;
using imaging::Vec3;

/// A tube of 350 HU in 50 HU, oblique to the grid, blurred by 0.35 mm, with noise.
struct TubeScene {
  segmentation::testing::Tube tube;
  imaging::ImageVolume image;
  FloatVolume floats;

  TubeScene(const std::array<std::int64_t, 3>& size, double radius_mm, double noise_hu)
      : tube{Vec3::Zero(), Vec3::Zero(), radius_mm} {
    const Vec3 spacing = Vec3::Constant(0.4);
    const Vec3 middle =
        spacing.cwiseProduct(0.5 * Vec3(static_cast<double>(size[0] - 1), static_cast<double>(size[1] - 1),
                                        static_cast<double>(size[2] - 1)));
    const Vec3 half = Vec3(0.15, 0.1, 1.0).normalized() * (0.4 * 0.4 * static_cast<double>(size[2]));
    tube.from = middle - half;
    tube.to = middle + half;
    image = segmentation::testing::tube_image({tube}, size, spacing, 0.35, noise_hu);
    floats = {image.geometry, {image.voxels.begin(), image.voxels.end()}};
  }

  /// Signed distance from a tube about the same axis, negative inside.
  FloatVolume about_axis(double radius_mm) const {
    FloatVolume out{image.geometry, {}};
    const auto& s = image.geometry.size;
    for (std::int64_t k = 0; k < s[2]; ++k)
      for (std::int64_t j = 0; j < s[1]; ++j)
        for (std::int64_t i = 0; i < s[0]; ++i)
          out.voxels.push_back(static_cast<float>(
              segmentation::testing::distance_to_axis(
                  tube, image.geometry.world(
                            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))) -
              radius_mm));
    return out;
  }

  /// 1 / (1 + |grad I|^2 / k^2), by centred differences.
  FloatVolume edges(double contrast_hu_per_mm) const {
    FloatVolume out{image.geometry, std::vector<float>(image.voxels.size(), 1.0F)};
    const auto& s = image.geometry.size;
    for (std::int64_t k = 1; k + 1 < s[2]; ++k)
      for (std::int64_t j = 1; j + 1 < s[1]; ++j)
        for (std::int64_t i = 1; i + 1 < s[0]; ++i) {
          const Vec3 gradient =
              Vec3(floats(i + 1, j, k) - floats(i - 1, j, k), floats(i, j + 1, k) - floats(i, j - 1, k),
                   floats(i, j, k + 1) - floats(i, j, k - 1)) /
              0.8;
          out(i, j, k) = static_cast<float>(
              1.0 / (1.0 + gradient.squaredNorm() / (contrast_hu_per_mm * contrast_hu_per_mm)));
        }
    return out;
  }
};

inline FloatVolume negated(FloatVolume image) {
  for (float& v : image.voxels) v = -v;
  return image;
}

/// The distance of a level set's surface from the tube's axis, the mean of many rays about its middle.
inline double surface_radius_mm(const FloatVolume& level_set, const segmentation::testing::Tube& tube,
                                double (*value)(const FloatVolume&, const Vec3&)) {
  const Vec3 along = (tube.to - tube.from).normalized();
  const Vec3 across = along.unitOrthogonal(), third = along.cross(across);
  double sum = 0.0;
  int count = 0;
  for (int slice = -5; slice <= 5; ++slice)
    for (int ray = 0; ray < 16; ++ray) {
      const double angle = ray * M_PI / 8.0;
      const Vec3 from = 0.5 * (tube.from + tube.to) + 0.5 * slice * along;
      const Vec3 out = std::cos(angle) * across + std::sin(angle) * third;
      double r = 0.0;
      while (r < 8.0 && value(level_set, from + r * out) < 0.0) r += 0.01;
      sum += r;
      ++count;
    }
  return sum / count;
}

}  // namespace ostia::filtering::peers
