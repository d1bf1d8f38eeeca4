#pragma once
/// \file A bar of a round length in mm.

#include "canvas.h"

namespace ostia::figure {

/// The longest of 1, 2 or 5 times a power of ten mm that is no longer than `longest_px`.
double scale_bar_mm(double mm_per_px, double longest_px);
/// Its right end at `corner`, its text above.
void draw_scale_bar(Canvas& canvas, const Vec2& corner, double mm_per_px, double longest_px,
                    const Color& color, const Color& halo);

}  // namespace ostia::figure
