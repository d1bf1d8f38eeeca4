#include "placement.h"

#include "image_source.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace ostia::imaging {
namespace {

constexpr double pi = 3.14159265358979323846;

Vec3 corner(const std::array<std::int64_t, 3>& size, int which) {
  Vec3 at;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = ((which >> axis) & 1) ? static_cast<double>(size[axis] - 1) : 0.0;
  return at;
}

/// The largest deviation from a right angle between two axes, in degrees.
double shear_deg(const Mat3& axes) {
  const double cosine =
      std::max({std::abs(axes.col(0).dot(axes.col(1))), std::abs(axes.col(0).dot(axes.col(2))),
                std::abs(axes.col(1).dot(axes.col(2)))});
  return std::asin(std::min(1.0, cosine)) * 180.0 / pi;
}

/// The orthonormal grid that holds a sheared one.
void hold_sheared(Placement& p, const Mat3& step, const Vec3& origin, const std::string& what) {
  const std::array<std::int64_t, 3> stored = p.geometry.size;
  Mat3 axes;
  axes.col(0) = step.col(0).normalized();
  axes.col(2) = step.col(0).cross(step.col(1)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  Geometry& grid = p.geometry;
  grid.direction = axes;
  Vec3 lowest = Vec3::Zero(), highest = Vec3::Zero();
  for (int c = 0; c < 8; ++c) {
    const Vec3 at = axes.transpose() * (step * corner(stored, c));
    lowest = lowest.cwiseMin(at);
    highest = highest.cwiseMax(at);
  }
  double voxels = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    grid.spacing[axis] = axes.col(axis).dot(step.col(axis));
    const double count = std::ceil((highest[axis] - lowest[axis]) / grid.spacing[axis] - 1e-6) + 1.0;
    voxels *= count;
    if (!(voxels <= static_cast<double>(max_voxels)))  // not a number, too
      throw InvalidInput(what + ": the axes are sheared so much that the image would not fit into memory");
    grid.size[axis] = static_cast<std::int64_t>(count);
  }
  grid.origin = origin + axes * lowest;
  p.sheared = true;
  const Mat3 inverse = step.inverse();
  p.linear = inverse * grid.direction * grid.spacing.asDiagonal();
  p.offset = inverse * (grid.origin - origin);
}

}  // namespace

Placement place(const std::array<std::int64_t, 3>& size, const Mat3& stored_step, const Vec3& stored_origin,
                const std::string& what) {
  Mat3 step = stored_step;
  Vec3 origin = stored_origin;
  if (!step.allFinite()) throw InvalidInput(what + ": the axes are not finite");
  if (!origin.allFinite()) throw InvalidInput(what + ": the origin is not finite");
  Placement p;
  Geometry& grid = p.geometry;
  grid.size = size;
  for (int axis = 0; axis < 3; ++axis) {
    grid.spacing[axis] = step.col(axis).stableNorm();
    if (!(grid.spacing[axis] > 0.0) || !std::isfinite(grid.spacing[axis]))
      throw InvalidInput(what + ": axis " + std::to_string(axis) + " has a spacing of " +
                         core::shortest_text(grid.spacing[axis]) + "; it must be finite and above 0");
  }
  Mat3 axes = step * grid.spacing.cwiseInverse().asDiagonal();
  const double volume = axes.determinant();
  if (!(std::abs(volume) >= 0.1))
    throw InvalidInput(what + ": singular: the three axes lie (nearly) in one plane");
  if (volume < 0.0) {
    origin += step.col(2) * static_cast<double>(size[2] - 1);
    step.col(2) = -step.col(2);
    axes.col(2) = -axes.col(2);
    p.slices_reversed = true;
    p.warnings.push_back("left-handed axes: k reversed");
  }
  grid.origin = origin.array() + 0.0;  // no -0 in what people read
  grid.direction = axes.array() + 0.0;
  if ((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-12) return p;

  const Eigen::JacobiSVD<Mat3> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  grid.direction = svd.matrixU() * svd.matrixV().transpose();
  const Vec3 centre = 0.5 * corner(size, 7);
  grid.origin = origin + step * centre - grid.direction * grid.spacing.cwiseProduct(centre);
  double moved = 0.0;
  for (int c = 0; c < 8; ++c)
    moved = std::max(moved, (grid.world(corner(size, c)) - origin - step * corner(size, c)).norm());
  if (shear_deg(axes) <= 0.1 && moved <= 0.1 * grid.spacing.minCoeff()) return p;

  hold_sheared(p, step, origin, what);
  p.warnings.push_back("sheared axes (" + core::rounded_text(shear_deg(axes), 1) +
                       " degrees off a right angle): resampled on an orthogonal grid of " +
                       std::to_string(grid.size[0]) + " x " + std::to_string(grid.size[1]) + " x " +
                       std::to_string(grid.size[2]) + " voxels");
  return p;
}

}  // namespace ostia::imaging
