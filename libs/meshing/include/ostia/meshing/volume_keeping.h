#pragma once
/// \file Triangles that hold the volume of the surface they stand for. See docs/methods/foreign-surfaces.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::meshing {

/// What was done.
struct VolumeKept {
  double before_mm3 = 0.0, after_mm3 = 0.0, reference_mm3 = 0.0;
  double largest_move_mm = 0.0;
  int rounds = 0;
};

/// Points on a curved wall make triangles that cut it short: sixteen edges around a vessel hold 2.6 % less
/// than the circle. Moves the wall's points along their normals, by about edge^2 / 12 radius, until the
/// triangles about each have no mean distance from `reference` (the surface before remeshing, closed); those
/// of the rings about caps stay. No point moves by more than a tenth of its shortest edge. Both surfaces are
/// closed, outward, with the same faces. Throws InvalidInput (no triangles; face ids), Cancelled.
VolumeKept keep_volume(geometry::FacedSurface& remeshed, const geometry::FacedSurface& reference,
                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
