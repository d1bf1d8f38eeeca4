#pragma once
/// \file Ends of a surface held against those of its axes: none is lost in silence.

#include "ostia/geometry/vessel_tree.h"
#include "ostia/pipeline/source.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

/// A line for each end of the file that no axis comes to, with name and place: caps that were taken off, rims
/// that are open, labels and rims that mending took away (Source::lost). Empty where each has its axis. A
/// mesh of these axes fails the gate by them.
std::vector<std::string> ends_without_axis(const Source& source, const geometry::VesselTree& tree);

}  // namespace ostia::pipeline
