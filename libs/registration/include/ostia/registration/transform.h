#pragma once
/// \file Where a point of one scan lies in another.

#include "ostia/geometry/vec.h"
#include "ostia/imaging/volume.h"

#include <optional>
#include <vector>

namespace ostia::registration {

using geometry::Mat3;
using geometry::Vec3;

/// Shifts that bend space: the coefficients of a cubic B-spline at the nodes of a grid, x fastest (Rueckert
/// et al., IEEE Trans. Med. Imaging 18:712-721, 1999). It is defined between the second and the last but one
/// node of each axis; farther out the shift is that of the nearest point there.
struct SplineGrid {
  imaging::Geometry nodes;      ///< at least four along each axis
  std::vector<Vec3> shifts_mm;  ///< one a node
};
/// Throws InvalidInput for a grid that is too small, a count that is not its own, or values not finite.
void validate(const SplineGrid& grid);

/// Takes a point of the fixed (the first) scan's world to its place in the moving (the second) scan's world,
/// LPS and mm: p -> linear (p + u(p)) + offset, where u is the spline's shift, or nothing. A value; cheap to
/// ask, from many threads.
class Transform {
 public:
  Transform() = default;  ///< leaves every point where it is
  /// Throws InvalidInput for values that are not finite, a linear part without an inverse, or a bad grid.
  Transform(const Mat3& linear, const Vec3& offset_mm, std::optional<SplineGrid> spline = std::nullopt);

  Vec3 operator()(const Vec3& fixed_mm) const;
  Mat3 jacobian(const Vec3& fixed_mm) const;  ///< of operator(): moving over fixed
  /// The point of the fixed scan that is taken there, by Newton's method. Throws NumericalError when it is
  /// not found to `tolerance_mm`, as where the transformation folds.
  Vec3 inverse(const Vec3& moving_mm, double tolerance_mm = 1e-5) const;

  const Mat3& linear() const { return linear_; }
  const Vec3& offset_mm() const { return offset_; }
  const std::optional<SplineGrid>& spline() const { return spline_; }

 private:
  Mat3 linear_ = Mat3::Identity();
  Vec3 offset_ = Vec3::Zero();
  std::optional<SplineGrid> spline_;
};

}  // namespace ostia::registration
