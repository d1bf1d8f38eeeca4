#include "ostia/registration/transform.h"

#include "spline_weights.h"

#include "ostia/core/error.h"

#include <Eigen/LU>

#include <cmath>
#include <string>

namespace ostia::registration {
namespace {

struct ShiftThere {
  Vec3 shift = Vec3::Zero();
  Mat3 gradient = Mat3::Zero();  // of the shift, over the world
};

/// The shift at a point, and its gradient where asked.
ShiftThere shift_at(const SplineGrid& grid, const Vec3& point_mm, bool gradient) {
  const imaging::Geometry& nodes = grid.nodes;
  const Vec3 index = nodes.index(point_mm);
  std::array<SplineWeights, 3> axes;
  for (int a = 0; a < 3; ++a) axes[a] = spline_weights(index[a], nodes.size[a]);
  ShiftThere there;
  Mat3 over_index = Mat3::Zero();
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      const std::int64_t row = nodes.offset(axes[0].first, axes[1].first + j, axes[2].first + k);
      const double yz = axes[1].value[j] * axes[2].value[k];
      for (int i = 0; i < 4; ++i) {
        const Vec3& node = grid.shifts_mm[row + i];
        there.shift += axes[0].value[i] * yz * node;
        if (!gradient) continue;
        over_index.col(0) += axes[0].slope[i] * yz * node;
        over_index.col(1) += axes[0].value[i] * axes[1].slope[j] * axes[2].value[k] * node;
        over_index.col(2) += axes[0].value[i] * axes[1].value[j] * axes[2].slope[k] * node;
      }
    }
  if (gradient)
    there.gradient = over_index * nodes.spacing.cwiseInverse().asDiagonal() * nodes.direction.transpose();
  return there;
}

}  // namespace

void validate(const SplineGrid& grid) {
  for (int a = 0; a < 3; ++a) {
    if (grid.nodes.size[a] < 4 || grid.nodes.size[a] > 10000)
      throw InvalidInput("a B-spline's grid needs 4 to 10000 nodes along each axis, not " +
                         std::to_string(grid.nodes.size[a]));
    if (!(grid.nodes.spacing[a] > 0.0) || !std::isfinite(grid.nodes.spacing[a]))
      throw InvalidInput("the spacing of a B-spline's nodes must be above 0 mm");
  }
  const Mat3& turned = grid.nodes.direction;
  if (!turned.allFinite() || !grid.nodes.origin.allFinite() ||
      !(turned.transpose() * turned).isIdentity(1e-6) || turned.determinant() < 0.0)
    throw InvalidInput("the axes of a B-spline's grid must be a rotation");
  if (static_cast<std::int64_t>(grid.shifts_mm.size()) != grid.nodes.voxels())
    throw InvalidInput("a B-spline has " + std::to_string(grid.shifts_mm.size()) + " shifts for " +
                       std::to_string(grid.nodes.voxels()) + " nodes");
  for (const Vec3& shift : grid.shifts_mm)
    if (!shift.allFinite()) throw InvalidInput("a shift of a B-spline is not a finite number");
}

Transform::Transform(const Mat3& linear, const Vec3& offset_mm, std::optional<SplineGrid> spline)
    : linear_(linear), offset_(offset_mm), spline_(std::move(spline)) {
  if (!linear_.allFinite() || !offset_.allFinite())
    throw InvalidInput("a transformation has a number that is not finite");
  if (std::abs(linear_.determinant()) < 1e-9)
    throw InvalidInput("the linear part of a transformation has no inverse");
  if (spline_) validate(*spline_);
}

Vec3 Transform::operator()(const Vec3& fixed_mm) const {
  const Vec3 bent = spline_ ? Vec3(fixed_mm + shift_at(*spline_, fixed_mm, false).shift) : fixed_mm;
  return linear_ * bent + offset_;
}

Mat3 Transform::jacobian(const Vec3& fixed_mm) const {
  if (!spline_) return linear_;
  return linear_ * (Mat3::Identity() + shift_at(*spline_, fixed_mm, true).gradient);
}

Vec3 Transform::inverse(const Vec3& moving_mm, double tolerance_mm) const {
  const Vec3 bent = linear_.inverse() * (moving_mm - offset_);
  if (!spline_) return bent;
  Vec3 point = bent;
  for (int step = 0; step < 50; ++step) {
    const ShiftThere there = shift_at(*spline_, point, true);
    const Vec3 missing = bent - point - there.shift;
    if (missing.norm() <= tolerance_mm) return point;
    // While far away the shift's own step, which cannot overshoot where the gradient is below one.
    const Mat3 slope = Mat3::Identity() + there.gradient;
    point += slope.determinant() > 0.05 ? Vec3(slope.inverse() * missing) : missing;
  }
  throw NumericalError(
      "a point of the moving scan has no place in the fixed one: the transformation folds there");
}

}  // namespace ostia::registration
