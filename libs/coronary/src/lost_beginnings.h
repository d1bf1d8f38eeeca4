#pragma once
/// \file Arteries that begin beyond the aorta's wall: behind a closed ostium, or one that was not seen.

#include "tube_front.h"

#include "ostia/coronary/tree_growth.h"

#include <vector>

namespace ostia::coronary {

/// What a front from the ostia left.
struct LeftBehind {
  const imaging::ImageVolume& image;
  const imaging::FloatVolume& tube;       ///< likeness to a tube as a share of the contrast
  const imaging::FloatVolume& radius_mm;  ///< of that tube
  const FrontNodes& reached;
  const std::vector<GrownBranch>& branches;
  double fat_hu = -90.0, wall_hu = 60.0;
  double least_tube = 0.25;
};

/// Tubes as bright and as wide as coronary arteries and 30 mm long that the front did not reach, begin at
/// most `farthest_mm` outside of the wall of root and ascending aorta, lead away from it, run neither in lung
/// nor beside what was reached (as veins do). The longest first. None where the aorta has fewer than three
/// stations. Throws Cancelled.
std::vector<Ostium> beginnings_beyond_wall(const LeftBehind& left, const Aorta& aorta, double farthest_mm,
                                           const core::TaskContext& task);

}  // namespace ostia::coronary
