#pragma once
/// \file Reference systems of bifurcations, the directions of their branches, and how branches bend. See
/// docs/methods/bifurcations.md.

#include "ostia/geometry/branch_groups.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::analysis {

using geometry::Vec3;

/// As vmtkbifurcationreferencesystems has it: from the ends of the bifurcation's tracts.
struct BifurcationSystem {
  std::int32_t group = 0;
  Vec3 origin = Vec3::Zero();      ///< mm
  Vec3 normal = Vec3::UnitZ();     ///< unit, of the plane in which the tracts lie
  Vec3 up_normal = Vec3::UnitX();  ///< unit, in that plane, downstream
};

/// As vmtkbifurcationvectors has it: along a branch at the bifurcation, one inscribed sphere long.
struct BifurcationVector {
  std::int32_t group = 0, bifurcation = 0;
  bool downstream = false;                            ///< the branch leaves the bifurcation
  Vec3 point = Vec3::Zero(), vector = Vec3::UnitZ();  ///< mm; its upstream end, and downstream from there
  Vec3 in_plane = Vec3::Zero(), out_of_plane = Vec3::Zero();
  double in_plane_rad = 0.0;      ///< from the up-normal, its sign that of (in_plane x up_normal) . normal
  double out_of_plane_rad = 0.0;  ///< above the plane, towards the normal
};

/// As vmtkbranchgeometry has it: means over the vessels that run through the branch. Curvature and torsion
/// are those of the line in steps of one inscribed sphere.
struct BranchGeometry {
  std::int32_t group = 0;
  double length_mm = 0.0, mean_radius_mm = 0.0;
  double curvature = 0.0, torsion = 0.0;  ///< 1/mm, weighted by length
  double tortuosity = 0.0;                ///< length over the distance of the mean ends, less 1
};

struct BifurcationMeasures {
  std::vector<BifurcationSystem> systems;  ///< in the order of the groups
  std::vector<BifurcationVector> vectors;  ///< of each system, the branch before it first
  std::vector<BranchGeometry> branches;
  std::vector<std::string> warnings;  ///< bifurcations without a plane
};

/// Throws InvalidInput where there are no lines.
BifurcationMeasures measure_bifurcations(const geometry::BranchedLines& lines);

/// The widest angle between two branches that leave a bifurcation, rad; 0 for fewer than two.
double angle_between_branches(const BifurcationMeasures& measures, std::int32_t bifurcation);

}  // namespace ostia::analysis
