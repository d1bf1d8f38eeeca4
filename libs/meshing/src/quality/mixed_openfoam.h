#pragma once
/// \file OpenFOAM's measures of cells and faces.

#include "quality/mixed_sides.h"

#include "ostia/core/task_context.h"
#include "ostia/meshing/mixed_quality.h"

#include <vector>

namespace ostia::meshing {

/// Sets the measures and what the boundary's match with the sides says.
void measure_sides(const geometry::MixedMesh& mesh, MixedQuality& quality, const core::TaskContext& task);

/// Of each element, tetrahedra first, the worst of its sides.
void measure_sides_of_elements(const geometry::MixedMesh& mesh, std::vector<double>& non_orthogonality_deg,
                               std::vector<double>& skewness, const core::TaskContext& task);

}  // namespace ostia::meshing
