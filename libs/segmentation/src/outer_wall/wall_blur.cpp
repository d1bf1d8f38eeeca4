#include "outer_wall/wall_blur.h"

#include "level_set/spline_derivatives.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ostia::segmentation::detail {
namespace {

using geometry::Mat3;

constexpr std::size_t kFewWalls = 300;
constexpr std::size_t kManyWalls = 4000;  // beyond which only every n-th is looked at
constexpr double kAlike = 2.0;            // ratio of variances below which the blur is taken as the same
constexpr double kHold = 30.0;            // walls whose say the same blur along all axes has
constexpr int kRounds = 30;

/// The squares of a wall's normal, and the variance across it.
struct Wall {
  Vec3 squares;
  double variance;
};

double steepness(const imaging::ImageVolume& image, const Vec3& index) {
  return derivatives_mm(image, index, std::numeric_limits<std::int16_t>::max()).first.squaredNorm();
}

std::optional<Wall> wall_at(const imaging::ImageVolume& image, Vec3 index) {
  constexpr int reach = 3;  // steps to the ridge
  const Vec3& h = image.geometry.spacing;
  const Vec3 gradient = derivatives_mm(image, index, std::numeric_limits<std::int16_t>::max()).first;
  if (!(gradient.norm() > 0.0)) return std::nullopt;
  const Vec3 n = gradient.normalized();
  const double step = 1.0 / n.cwiseQuotient(h).norm();  // a voxel's extent along the normal
  const Vec3 stride = (step * n).cwiseQuotient(h);
  double here = steepness(image, index);
  for (int moved = 0;; ++moved) {
    const double before = steepness(image, index - stride), after = steepness(image, index + stride);
    if (here >= before && here >= after) {
      // Of |grad I|^2: twice the logarithm.
      const double bend = 0.5 * (std::log(before) + std::log(after) - 2.0 * std::log(here));
      if (!(before > 0.0 && after > 0.0 && bend < 0.0)) return std::nullopt;
      return Wall{n.cwiseProduct(n), -step * step / bend};
    }
    if (moved == reach) return std::nullopt;
    index += after > before ? stride : -stride;
    here = std::max(before, after);
  }
}

/// Least squares with weights that fall with the relative error: edges of two walls at once say little.
Vec3 fitted(const std::vector<Wall>& walls, const Vec3& least) {
  std::vector<double> sorted;
  for (const Wall& w : walls) sorted.push_back(w.variance);
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double median = sorted[sorted.size() / 2];
  Vec3 v = Vec3::Constant(median);
  for (int round = 0; round < kRounds; ++round) {
    Mat3 matrix = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (const Wall& wall : walls) {
      const double expected = wall.squares.dot(v);
      const double error = (wall.variance / expected - 1.0) / 0.5;
      const double weight = 1.0 / (expected * expected * (1.0 + error * error));
      matrix += weight * wall.squares * wall.squares.transpose();
      right += weight * wall.variance * wall.squares;
    }
    // A tube along an axis has few walls that face along it.
    const double hold = kHold / (median * median);
    matrix.diagonal().array() += hold;
    right.array() += hold * median;
    v = matrix.ldlt().solve(right).cwiseMax(least);
  }
  return v;
}

}  // namespace

Vec3 wall_blur(const imaging::ImageVolume& image, const imaging::Geometry& grid,
               const std::vector<std::int64_t>& voxels) {
  const Vec3 first = image.geometry.index(grid.origin).array().round();
  const std::size_t stride = 1 + voxels.size() / kManyWalls;
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < voxels.size(); i += stride) {
    const std::int64_t n = voxels[i];
    const Vec3 at(static_cast<double>(n % grid.size[0]), static_cast<double>(n / grid.size[0] % grid.size[1]),
                  static_cast<double>(n / (grid.size[0] * grid.size[1])));
    if (const auto wall = wall_at(image, first + at)) walls.push_back(*wall);
  }
  if (walls.size() < kFewWalls) return Vec3::Ones();
  const Vec3 least = image.geometry.spacing.cwiseProduct(image.geometry.spacing) / 3.0;
  const Vec3 found = fitted(walls, least);
  if (!found.allFinite() || found.maxCoeff() < kAlike * found.minCoeff()) return Vec3::Ones();
  return found;
}

}  // namespace ostia::segmentation::detail
