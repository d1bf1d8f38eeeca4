#pragma once
/// \file Images of tubes whose walls are known exactly.

#include "ostia/imaging/volume.h"
#include "ostia/segmentation/seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace ostia::segmentation::testing {

/// A disc of radius r blurred by a Gaussian of standard deviation sigma, at a distance from its centre: what
/// a scanner with such a point-spread function shows of a long straight tube. By quadrature, tabulated.
class BlurredDisc {
 public:
  BlurredDisc(double radius, double sigma) {
    constexpr int kTaps = 49;
    const double cell = 8.0 * sigma / (kTaps - 1);
    for (int n = 0; n < 1200; ++n) {
      const double rho = n * step_;
      double sum = 0.0;
      double weights = 0.0;
      for (int i = 0; i < kTaps; ++i) {
        for (int j = 0; j < kTaps; ++j) {
          const double x = (i - kTaps / 2) * cell;
          const double y = (j - kTaps / 2) * cell;
          const double w = std::exp(-(x * x + y * y) / (2.0 * sigma * sigma));
          weights += w;
          sum += w * std::clamp(0.5 - (std::hypot(rho + x, y) - radius) / cell, 0.0, 1.0);
        }
      }
      table_.push_back(sum / weights);
      if (rho > radius + 5.0 * sigma) break;
    }
  }
  double operator()(double rho) const {
    const double at = rho / step_;
    const auto n = static_cast<std::size_t>(at);
    if (n + 1 >= table_.size()) return 0.0;
    return table_[n] + (at - static_cast<double>(n)) * (table_[n + 1] - table_[n]);
  }

 private:
  double step_ = 0.02;
  std::vector<double> table_;
};

struct Tube {
  Vec3 from;
  Vec3 to;  ///< ends are where the seeds go; the tube itself has none unless `finite`
  double radius;
  bool finite = false;
};

inline double distance_to_axis(const Tube& tube, const Vec3& point) {
  const Vec3 axis = (tube.to - tube.from).normalized();
  double along = (point - tube.from).dot(axis);
  if (tube.finite) along = std::clamp(along, 0.0, (tube.to - tube.from).norm());
  return (point - tube.from - along * axis).norm();
}

inline imaging::ImageVolume tube_image(const std::vector<Tube>& tubes,
                                       const std::array<std::int64_t, 3>& size, const Vec3& spacing,
                                       double sigma, double noise = 0.0, double lumen = 350.0,
                                       double background = 50.0) {
  imaging::ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  std::vector<BlurredDisc> profiles;
  for (const Tube& tube : tubes) profiles.emplace_back(tube.radius, sigma);
  std::mt19937 generator(7);
  std::normal_distribution<double> random(0.0, std::max(noise, 1e-9));
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const Vec3 point = image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        double part = 0.0;
        for (std::size_t t = 0; t < tubes.size(); ++t) {
          part = std::max(part, profiles[t](distance_to_axis(tubes[t], point)));
        }
        const double hu = background + (lumen - background) * part + (noise > 0.0 ? random(generator) : 0.0);
        image(i, j, k) = static_cast<std::int16_t>(std::lround(hu));
      }
    }
  }
  return image;
}

/// Statistics of the distance of points from a tube's wall, those nearer than `ends` to an end left out.
struct WallError {
  double mean = 0.0;
  double rms = 0.0;
  double least = 0.0;
  double most = 0.0;
  std::size_t count = 0;
};

inline WallError wall_error(const std::vector<Vec3>& points, const Tube& tube, double ends) {
  WallError error;
  const Vec3 axis = (tube.to - tube.from).normalized();
  const double length = (tube.to - tube.from).norm();
  for (const Vec3& p : points) {
    const double along = (p - tube.from).dot(axis);
    if (along < ends || along > length - ends) continue;
    const double e = distance_to_axis(tube, p) - tube.radius;
    error.mean += e;
    error.rms += e * e;
    error.least = std::min(error.least, e);
    error.most = std::max(error.most, e);
    ++error.count;
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, error.count));
  error.mean /= n;
  error.rms = std::sqrt(error.rms / n);
  return error;
}

}  // namespace ostia::segmentation::testing
