#pragma once
/// \file Where a function is not what it was after weights of it have changed.

#include "ostia/lumen/implicit_surface.h"

#include <vector>

namespace ostia::lumen {

/// What a centre gained or lost.
struct WeightChange {
  Vec3 place = Vec3::Zero();
  double by = 0.0, s_mm = 0.0;
};
struct ChangeExtent {
  geometry::Box3 box;  ///< empty if nothing changed by more than 1e-6 mm
  double from_mm = 0.0, to_mm = 0.0;
};

/// Weights change far along a vessel, but they alternate, and the function that they make is all but zero
/// there: it vanishes at every constraint that stayed. So |delta f| is bounded by sum_j |delta c_j| phi
/// first, in cells of half a support radius, and where that bound says no more it is evaluated on eight
/// places a cell. A cell counts from a tenth of 1e-6 mm on, with its neighbours.
ChangeExtent extent_of(const std::vector<WeightChange>& changes, Kernel kernel, double support_radius_mm);

}  // namespace ostia::lumen
