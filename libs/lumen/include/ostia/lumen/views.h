#pragma once
/// \file The views of `reformat` as surfaces on which contour lines are drawn.

#include "ostia/lumen/contour_lines.h"
#include "ostia/reformat/curved_reformation.h"
#include "ostia/reformat/plane.h"

namespace ostia::lumen {

/// Copies what it needs: the reformation or plane need not outlive it.
ViewSurface view_of(const reformat::CurvedReformation& reformation);
ViewSurface view_of(const reformat::Plane& plane);

}  // namespace ostia::lumen
