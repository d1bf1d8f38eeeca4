#pragma once
/// \file Places laid onto axes by a rigid motion.

#include "change/paired_vessels.h"

#include "ostia/geometry/rigid_fit.h"

#include <vector>

namespace ostia::analysis {

struct LaidPlaces {
  geometry::RigidFit motion;
  double mean_mm = 0.0;    ///< distance of the places that have a foot on their axis, none left out
  std::size_t places = 0;  ///< how many these are
};

/// From `start` on, Gauss's and Newton's steps on the distances across the axes. Places beyond an axis' end
/// do not count, those three times as far off as the median (but 1 mm at least) have no say in the motion.
/// The start itself where no step makes it better.
/// `hold`, from 0 to 1: how a way along the axes from the start weighs beside a distance across them. 0: not
/// at all, so that what bends of the axes say of it alone decides.
LaidPlaces lay_on_axes(const std::vector<PlacesOnAxis>& all, const geometry::RigidFit& start,
                       double hold = 0.0);

}  // namespace ostia::analysis
