#pragma once
/// \file What the ends of a surface say about its unit of length.

#include "ostia/geometry/tri_mesh.h"

#include <optional>

namespace ostia::pipeline {

/// Widths of a surface's ends, open or under flat caps, in the file's own unit.
struct EndWidths {
  double thinnest = 0.0, widest = 0.0;
};
/// Nothing where it has no such ends, or is too broken to tell.
std::optional<EndWidths> end_widths(const geometry::FacedSurface& surface);

/// Outlets that no vessel has in millimetres, from a trunk as an aorta has it in centimetres.
bool speak_for_cm(const EndWidths& widths);
/// Thin as hardly any end of a tree in millimetres, and much thinner than its trunk: it may be either.
bool leave_cm_open(const EndWidths& widths);

}  // namespace ostia::pipeline
