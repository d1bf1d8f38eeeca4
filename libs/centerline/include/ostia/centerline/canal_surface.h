#pragma once
/// \file The canal surface: the envelope of the maximal inscribed spheres along centerlines ([Antiga] section
/// 4, fig. 3).

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"

#include <vector>

namespace ostia::centerline {

/// The closed, outward envelope of the spheres along the lines, as an isosurface on a grid of `spacing_mm`.
/// Between points centre and radius are linear. Throws InvalidInput for no lines, a line with fewer than two
/// points or without radii, a spacing that is not positive.
geometry::TriMesh canal_surface(const std::vector<geometry::Centerline>& lines, double spacing_mm,
                                const core::TaskContext& task = core::no_task());
geometry::TriMesh canal_surface(const geometry::VesselTree& tree, double spacing_mm,
                                const core::TaskContext& task = core::no_task());

}  // namespace ostia::centerline
