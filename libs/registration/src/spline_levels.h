#pragma once
/// \file Grids of shifts from coarse to fine.

#include "ostia/registration/transform.h"

namespace ostia::registration {

/// No shift anywhere, defined over the box, with nodes no further apart than `spacing_mm`.
SplineGrid resting_spline(const geometry::Box3& box, double spacing_mm);
/// The same shifts with half of the spacing (knots inserted, exact within the domain).
SplineGrid refined(const SplineGrid& coarse);

}  // namespace ostia::registration
