#pragma once
/// \file Angles where a tree forks, and how its radii divide there. See docs/methods/tree-measures.md.

#include "ostia/analysis/graph_measures.h"

namespace ostia::analysis {

/// The widest branch behind a fork with one other: a fork of three has two of these.
struct ForkAngles {
  std::int32_t point = 0;
  std::int32_t parent = -1, wide = -1, narrow = -1;  ///< edges at the point; of equal ones the first is wide
  double between_rad = 0.0;                          ///< from one child's direction to the other's
  double wide_rad = 0.0, narrow_rad = 0.0;           ///< how far each turns from the parent's direction
  double tilt_rad = 0.0;  ///< between the parent's direction and the plane of both; 0 where they lie in line
};

/// Directions are those from the fork to the point `reach` radii of the parent away along each branch (a
/// branch that is shorter ends there), 0: those of the edges at the fork. At roots there is nothing to turn
/// from and no fork is listed. In the order of the points. `reach` >= 0, else InvalidInput.
std::vector<ForkAngles> fork_angles(const geometry::VesselGraph& graph,
                                    const geometry::GraphIncidence& incidence, const TreeLinks& links,
                                    double reach = 0.0);

/// The exponent k of r_parent^k = sum of r_child^k. None where a child is as wide as its parent or has no
/// width, or there is one child alone.
std::optional<double> murray_exponent(double parent_radius, const std::vector<double>& child_radii);

struct ForkExponent {
  std::int32_t point = 0, parent = -1;
  std::optional<double> k;
  double area_ratio = 0.0;  ///< of all children to the parent; 0 where the parent has no width
};
/// At each fork with a parent, of the radii at the fork, in the order of the points.
std::vector<ForkExponent> fork_exponents(const geometry::VesselGraph& graph,
                                         const geometry::GraphIncidence& incidence);

}  // namespace ostia::analysis
