#pragma once
/// \file How much a spline of shifts bends.

#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::registration {

/// `weight` times the mean over the nodes of the squared second differences of the shifts, over mm2 and times
/// (20 mm)2, so that it does not depend on the spacing of the nodes. `shifts` holds all x, then all y, then
/// all z; the derivative is added to `gradient`, which is as long.
double bending_cost(const imaging::Geometry& nodes, double weight, const double* shifts, double* gradient);

}  // namespace ostia::registration
