#pragma once
/// \file A place on a vessel's axis.

#include "ostia/geometry/centerline.h"

namespace ostia::phantom {

struct AxisPlace {
  geometry::Vec3 point = geometry::Vec3::Zero();
  geometry::Frame frame;
  double radius_mm = 0.0;
};

/// Linear between the axis' points, clamped to its ends; the frame turned with it.
AxisPlace place_at(const geometry::Centerline& axis, double s_mm);

}  // namespace ostia::phantom
