#pragma once
/// \file The wall that an edit implies: between a new line and what is left beside it, and at a vessel's
/// ends.

#include "editing/wall_editing.h"

#include <vector>

namespace ostia::lumen {

/// Samples where a stroke leaves the wall around the axis without any for longer than samples are apart: on
/// the periodic cubic spline rho(theta) through the new line and the kept wall, at the abscissas of the line.
/// They are not drawn (origin `start`) and stand for nothing that a person said: they keep the interpolation
/// from bulging where lines are far apart. `kept`: without what the stroke dismisses.
std::vector<SurfaceSample> samples_between(const AxisCurve& axis, const std::vector<WallPlace>& kept,
                                           const std::vector<SurfaceSample>& line, double spacing_mm);

/// The caps of a vessel whose wall has changed at an end of its own stretch are made anew from the wall
/// there, so that no old cap stands about a narrower end. A line that runs past the end is the cap's wall
/// itself: then it stays.
void renew_caps(WallChange& change);

}  // namespace ostia::lumen
