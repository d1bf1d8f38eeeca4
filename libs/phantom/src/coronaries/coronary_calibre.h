#pragma once
/// \file How wide coronary arteries are: Murray's law, taper, the shape of the cross-section.

#include "ostia/phantom/coronary_tree.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace ostia::phantom {

/// A branch that leaves, and its radius as a share of the parent's there.
struct BranchShare {
  double s_mm = 0.0, share = 0.0;
};

/// Sets healthy radius, lumen and wall of a vessel whose axis is drawn. Where a branch leaves, r^3 is shared
/// between it and what goes on (Murray 1926); between branches the vessel narrows as (s /
/// length)^taper_power, so that it ends with `end_radius_mm` where the branches leave it more than that.
void set_calibre(CoronaryVessel& vessel, double start_radius_mm, double end_radius_mm, double taper_power,
                 std::vector<BranchShare> branches, std::uint64_t seed);
/// The same from a healthy radius at each abscissa.
void set_profiles(CoronaryVessel& vessel, const std::function<double(double)>& healthy, std::uint64_t seed);
/// The mean radius just before a place where a branch leaves.
double radius_before_branch(const CoronaryVessel& vessel, double s_mm);
/// From where on a branch's lumen is wholly outside its parent's outer wall.
double free_abscissa(const CoronaryVessel& vessel, const CoronaryVessel& parent);

/// The outer wall's radius of a healthy vessel.
double healthy_wall_radius(double lumen_radius_mm);

inline constexpr int profile_angles = 32;
inline constexpr double profile_step_mm = 0.5;

}  // namespace ostia::phantom
