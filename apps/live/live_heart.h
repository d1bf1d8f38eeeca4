#pragma once
/// \file A heart as the viewer takes it: what was read, prepared to be drawn.

#include "live_input.h"

#include "ostia/core/task_context.h"
#include "ostia/glview/shown_surface.h"
#include "ostia/motion/moving_cage.h"

#include <vector>

namespace ostia::live {

struct LiveHeart {
  LiveInput input;
  motion::MovingCage cage;
  glview::ShownSurface surface;        ///< without directions
  std::vector<geometry::Vec3> places;  ///< of the surface's points at ten phases
};

/// Reads and prepares. Throws as `read_input`, and InvalidInput for a surface or motion that cannot be shown;
/// Cancelled.
LiveHeart read_heart(const Options& options, const core::TaskContext& task = core::no_task());

}  // namespace ostia::live
