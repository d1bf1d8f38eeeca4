#pragma once
/// \file Measurements as the 3D scene shows them.

#include "ostia/session/workbench.h"
#include "ostia/view/scene_marks.h"

#include <optional>
#include <vector>

namespace ostia::view {

/// All that are to be seen (none where `marks_shown` is off), each with its name or number and its first
/// value as the 2D views write them. Points, angles and areas stand where they were placed. A stenosis, a
/// volume or a ring of CT numbers follows its vessel as it is now: a line along the axis, the lumen's outline
/// at its ends (a stenosis: at its narrowest place, too), and a dot on the axis for each abscissa. What has
/// lost its vessel is left out.
std::vector<SceneMeasurement> scene_measurements(const session::Workbench& bench);

/// One of them, whether it is in the case or not, without a label.
std::optional<SceneMeasurement> in_scene(const session::Workbench& bench,
                                         const analysis::Measurement& measurement);

/// Where a hand takes hold of it: its points, or the places of its abscissas on the axis. Empty where the
/// vessel is not there.
std::vector<Vec3> handles_of(const session::Workbench& bench, const analysis::Measurement& measurement);

}  // namespace ostia::view
