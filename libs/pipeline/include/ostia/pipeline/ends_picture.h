#pragma once
/// \file A picture of a lumen's ends, for a person who has to say where they are to be cut.

#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/meshing/clip.h"

#include <vector>

namespace ostia::pipeline {

/// The lumen as a whole, seen broadside, with the ends that could not be cut as red balls with their names,
/// and each of the first five of them from near by with the axis that leads to it. Throws InvalidInput for an
/// empty surface or no end.
figure::Picture picture_of_ends(const geometry::TriMesh& lumen, const geometry::VesselTree& axes,
                                const std::vector<meshing::EndPlane>& not_cut,
                                const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
