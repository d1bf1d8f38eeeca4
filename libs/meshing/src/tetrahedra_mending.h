#pragma once
/// \file Points of bad tetrahedra moved to open their smallest dihedral angles (Freitag and Ollivier-Gooch
/// 1997).

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstddef>

namespace ostia::meshing {

/// Moves inner points only, each so that the smallest dihedral angle around it grows; connectivity stays.
/// Returns the number of points moved. Deterministic.
std::size_t mend_tetrahedra(geometry::VolumeMesh& mesh, double below_deg, int rounds,
                            const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
