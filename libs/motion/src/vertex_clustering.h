#pragma once
/// \file A coarser copy of a surface, for distances alone.

#include "ostia/geometry/tri_mesh.h"

namespace ostia::motion {

/// About `most_points` of the surface's points and the triangles that are left between them: one point for
/// each cube of a grid, that nearest to the mean of those in it, so that all lie on the surface. It may have
/// small faults. The surface itself where it has no more points than that. Deterministic.
geometry::TriMesh clustered(const geometry::TriMesh& mesh, std::size_t most_points);

}  // namespace ostia::motion
