#pragma once
/// \file A large vessel followed section by section.

#include "disc_fit.h"

#include "ostia/core/task_context.h"

#include <vector>

namespace ostia::coronary {

struct FollowOptions {
  DiscFitOptions disc;
  double step_mm = 1.5;
  double least_round = 0.55;
  double largest_change = 0.10;  ///< of the radius from section to section, as a share
  double largest_shift = 0.6;    ///< of a centre off the way ahead, in steps
  double hindsight_mm = 12.0;    ///< the way ahead is the line through so much of the way behind
  double longest_mm = 400.0;
};

struct TubeSection {
  DiscFit disc;
  Vec3 tangent = Vec3::UnitZ();
};

/// Goes on from `way` (at least two discs, in the direction to follow) until a section does not fit any more,
/// the image ends or the way comes back to itself. Returns the new sections alone.
std::vector<TubeSection> follow_tube(const imaging::ImageVolume& image, const std::vector<DiscFit>& way,
                                     const FollowOptions& options, const core::TaskContext& task);

}  // namespace ostia::coronary
