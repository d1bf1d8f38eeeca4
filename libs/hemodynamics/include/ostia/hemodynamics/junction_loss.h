#pragma once
/// \file Pressure over a fork: Unified0D (Mynard and Valen-Sendstad, Int J Numer Meth Biomed Engng 2015,
/// 31:e02717).

#include <span>
#include <vector>

namespace ostia::hemodynamics {

/// A branch that leaves a fork.
struct ForkBranch {
  double flow_ml_s = 0.0, area_mm2 = 0.0;
  double angle_rad = 0.0;  ///< from the direction of the branch before the fork, signed by its side
};
struct ForkDrop {
  double pa = 0.0;  ///< static pressure before the fork less that at the branch's beginning
  double by_own_pa_s_ml = 0.0, by_parent_pa_s_ml = 0.0;  ///< derivatives by its own and the parent's flow
};
/// One for each branch. All 0 where the parent's flow is not forward, and of a branch that nothing enters.
/// Areas are > 0.
std::vector<ForkDrop> fork_drops(double density_kg_m3, double parent_flow_ml_s, double parent_area_mm2,
                                 std::span<const ForkBranch> branches);

}  // namespace ostia::hemodynamics
