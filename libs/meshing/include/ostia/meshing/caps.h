#pragma once
/// \file Flat caps on the open ends of a lumen.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/clip.h"

namespace ostia::meshing {

struct CapOptions {
  /// Edge length inside the cap as a multiple of the mean edge of its loop. In [0.3, 10].
  double edge_factor = 1.0;
};
void validate(const CapOptions& options);

/// The surface closed by one flat cap an end: constrained Delaunay triangles over the loop and points inside
/// it, relaxed. CellEntityIds: wall 1, caps from 2 in the order of `ends`; named `inlet_<vessel>` and
/// `outlet_<vessel>`. Outward. The points of `clipped.mesh` keep their indices. Throws GeometryError naming
/// an end whose loop crosses itself.
geometry::FacedSurface cap_ends(const ClippedSurface& clipped, const CapOptions& options = {},
                                const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
