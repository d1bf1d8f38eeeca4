#pragma once
/// \file From a tree's vessels to the branches of a network of flow.

#include "ostia/session/pressure_tree.h"

#include <map>

namespace ostia::session {

/// The vessel that owns each segment: the first that passes through it.
std::map<std::int32_t, std::int32_t> owners_of(const geometry::VesselTree& tree);
bool owns_a_segment(const std::map<std::int32_t, std::int32_t>& owners, std::int32_t vessel);
/// How many of a vessel's segments another vessel owns: the first ones.
std::size_t shared_segments(const std::map<std::int32_t, std::int32_t>& owners,
                            const geometry::Vessel& vessel);

/// Where a vessel's nodes are on its axis, the first and the last included.
struct WayOnAxis {
  std::vector<double> node_mm;
};
WayOnAxis way_on_axis(const geometry::VesselTree& tree, const geometry::Vessel& vessel,
                      const geometry::AxisCurve& axis);

/// Fills the network of measured vessels: branches with their stations, angles and bends, a parent before its
/// children.
void make_branches(PressureTree& tree, const geometry::VesselTree& vessels,
                   const std::map<std::int32_t, std::int32_t>& owners, double bend_chord_mm);
/// The stations of a vessel's branches that reach into a stretch, made again of its profile.
std::vector<std::size_t> remake_branches(PressureTree& tree, std::int32_t vessel, double from_mm,
                                         double to_mm, double bend_chord_mm);

}  // namespace ostia::session
