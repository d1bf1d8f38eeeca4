#pragma once
// The wall of one vessel in a contour's plane.

#include "ostia/geometry/contour_set.h"
#include "ostia/lumen/scalar_field.h"

#include <vector>

namespace ostia::session {

/// The line of the wall that goes around `inside` (a place on the axis) or the contour's middle; empty where
/// there is none.
std::vector<geometry::Vec3> wall_outline(const lumen::ScalarField& wall, const geometry::Contour& contour,
                                         const geometry::Vec3& inside);

}  // namespace ostia::session
