#pragma once
/// \file Vessels of two trees by their names.

#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/vessel_tree.h"

#include <string>
#include <utility>
#include <vector>

namespace ostia::analysis {

/// What tells a vessel in every scan: its usual name, else its own; empty for a number alone ("V3").
std::string telling_name(const geometry::Vessel& vessel);

/// Indices of vessels with the same telling name in the former and the later tree, in the former's order. A
/// name that a tree has twice pairs its first vessel.
std::vector<std::pair<std::size_t, std::size_t>> pairs_by_name(const geometry::VesselTree& before,
                                                               const geometry::VesselTree& after);

/// The axes of all vessels, in the tree's order.
std::vector<geometry::AxisCurve> axes_of(const geometry::VesselTree& tree);

/// Places of an axis and the axis that they are to lie on.
struct PlacesOnAxis {
  std::vector<geometry::Vec3> places;
  const geometry::AxisCurve* axis = nullptr;
};

}  // namespace ostia::analysis
