#pragma once
/// \file A function in space whose zero set is a wall.

#include "ostia/geometry/vec.h"

#include <span>

namespace ostia::lumen {

using geometry::Box3;
using geometry::Vec3;

struct FieldSample {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();  ///< per mm
};

/// Negative inside the lumen, zero on its wall. Immutable; asked from many threads.
class ScalarField {
 public:
  virtual ~ScalarField() = default;
  virtual double value(const Vec3& place) const = 0;
  virtual Vec3 gradient(const Vec3& place) const = 0;  ///< per mm, exact
  /// Both at once; the same bits as `value` and `gradient`.
  virtual FieldSample value_and_gradient(const Vec3& place) const { return {value(place), gradient(place)}; }
  /// Typical size of the gradient on the wall, per mm: 1 for what is about a distance in mm.
  virtual double wall_slope() const { return 1.0; }
  /// Many at once, the same bits as `value`; fastest when neighbours in the list are neighbours in space.
  virtual void values(std::span<const Vec3> places, std::span<double> out) const = 0;
  /// Outside this box the field is positive.
  virtual Box3 box() const = 0;
};

}  // namespace ostia::lumen
