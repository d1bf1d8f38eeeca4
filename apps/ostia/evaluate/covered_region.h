#pragma once
/// \file The part of space that a model's vessels run through.

#include "ostia/geometry/vec.h"
#include "ostia/geometry/vessel_tree.h"

#include <functional>

namespace ostia::app {

/// Whether a point lies beside one of the axes: no farther from it than 1.75 times the radius there, and not
/// within a radius of a free end (an end without a second segment), where models are cut flat and truth goes
/// on. For comparing a model of some vessels with the truth of a whole tree.
std::function<bool(const geometry::Vec3&)> covered_region(const geometry::VesselTree& axes);

}  // namespace ostia::app
