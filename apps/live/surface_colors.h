#pragma once
/// \file What colours need to be known, found beside the pictures.

#include "preparation.h"

#include "ostia/glview/surface_values.h"

#include <optional>
#include <vector>

namespace ostia::live {

/// Ranges over the cycle, directions along the vessel, curvatures: found when a colour is first asked for.
class SurfaceColors {
 public:
  SurfaceColors(glview::ShownSurface surface, motion::MovingCage cage);

  struct Found {
    glview::SurfaceValue value = glview::SurfaceValue::none;
    glview::ValueRange range;
    std::vector<glview::Direction> along;         ///< where they were found for it
    std::optional<glview::BendingTable> bending;  ///< where it is of bending
  };
  const glview::ShownSurface& surface() const { return surface_; }  ///< not while it is busy
  /// Begins with it, unless it is busy with another one.
  void ask(glview::SurfaceValue value);
  bool busy() const { return work_.has_value(); }
  /// Whether `take` has something; waits so long at most.
  bool ready(std::chrono::milliseconds wait = {}) const { return work_ && work_->ready(wait); }
  /// What was asked for; waits. Throws what finding it threw.
  Found take();

 private:
  Found find(glview::SurfaceValue value, const core::TaskContext& task);
  glview::ShownSurface surface_;
  motion::MovingCage cage_;
  std::optional<Preparation<Found>> work_;  // last: it ends before what it works on
};

}  // namespace ostia::live
