#pragma once
/// \file A tree of vessels as flow sees it: sections along branches, joined at forks.

#include "ostia/hemodynamics/section.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::hemodynamics {

/// A section below this area lets nothing through.
constexpr double shut_mm2 = 1e-4;

/// The lumen at one place of a branch.
struct Station {
  double s_mm = 0.0;      ///< along the axis of `Branch::vessel`, ascending
  double area_mm2 = 0.0;  ///< <= shut_mm2: occluded
  SectionShape shape = {};
  double curvature_per_mm = 0.0;  ///< of the axis, >= 0
  Vec3 point = Vec3::Zero();      ///< of the axis, for pictures and files
  double diameter_mm() const;     ///< of the circle of equal area
};

/// Pressure over flow that is told instead of worked out: linear Q + quadratic Q |Q|. The linear part is not
/// below 0; the quadratic one is where pressure comes back.
struct LumpedDrop {
  double linear_pa_s_ml = 0.0, quadratic_pa_s2_ml2 = 0.0;
};

/// What lies between two forks, a root or an end.
struct Branch {
  std::int32_t segment = 0;  ///< of the tree that it was made of
  std::int32_t vessel = 0;   ///< whose axis the abscissas are of
  std::string name;
  int parent = -1;  ///< index of the branch it leaves; none: it begins at the aorta
  double angle_rad =
      0.0;  ///< between its direction and its parent's; its sign tells the sides of a fork apart
  /// Of this branch alone: what lies within its parent's lumen is left out. None: `lumped` is all.
  std::vector<Station> stations;
  LumpedDrop lumped;  ///< beside what the stations take
};

struct Network {
  std::vector<Branch> branches;  ///< a parent before its children
};

/// Branches that nothing leaves, ascending: where outlets are.
std::vector<std::size_t> outlets_of(const Network& network);
/// Branches that begin at the aorta, ascending.
std::vector<std::size_t> roots_of(const Network& network);
/// Throws InvalidInput that names the branch: no branches, no root, a child before its parent, a single
/// station, abscissas that do not ascend, what is not finite or below 0.
void validate(const Network& network);
void validate(const Branch& branch);

}  // namespace ostia::hemodynamics
