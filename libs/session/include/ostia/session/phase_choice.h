#pragma once
/// \file Which phase of a study is the sharpest: the work beside the window, image by image.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/phase_sharpness.h"
#include "ostia/session/beating.h"
#include "ostia/session/series_stack.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// Where the edges are that are looked at.
enum class SharpnessPlaces {
  heart,         ///< there are no axes yet
  same_axes,     ///< about the case's axes, which lie elsewhere at other phases: a wider way about them
  carried_axes,  ///< about the axes, carried by the motion
};

struct PhaseChoice {
  evaluation::BestPhase best;  ///< numbers are those of the stack's entries
  SharpnessPlaces places = SharpnessPlaces::heart;
  std::vector<std::string> faults;  ///< of each entry: why it could not be read; empty where it was
};

/// Work for another thread: nothing in it changes. One image is in memory beside those that are held.
struct PhaseChoiceWork {
  static constexpr double about_carried_mm = 5.0, about_same_mm = 10.0;
  SeriesStack stack;
  std::vector<std::size_t> compared;       ///< cine_of(stack); others are left out as not measured
  std::vector<StackImages::Image> held;    ///< of each entry; null: is read
  std::vector<Vec3> axes_mm;               ///< points of the arteries' axes; none: the heart is looked at
  std::shared_ptr<const Beating> beating;  ///< carries the axes; null: they are the same at all phases
  /// An image that cannot be read or measured is named in `faults` and left out. Throws Cancelled.
  PhaseChoice chosen(const core::TaskContext& task = core::no_task()) const;
};

/// Points a millimetre apart on the axes, each stretch once; without the aorta ("Aorta").
std::vector<Vec3> axis_points(const lumen::LumenModel& model);
/// The same where the motion has carried them.
std::vector<Vec3> axis_points(const Beating& beating, double phase);

}  // namespace ostia::session
