#pragma once
/// \file Axes of a rough mask eased where no wall could follow them.

#include "ostia/centerline/axis_fit.h"

namespace ostia::coronary {

/// Where the axis turns by more than 50 degrees within two thirds of its radius, or comes back to itself
/// within half of it, it is made smoother there and nowhere else. Ends stay.
void ease_kinks(centerline::Axis& axis);

/// An end that turns back within four radii (by more than half a circle), so that its wall would run into
/// itself, goes as far as where it turns. Returns whether it did.
bool trim_hooked_end(centerline::Axis& axis);

}  // namespace ostia::coronary
