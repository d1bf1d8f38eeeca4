#pragma once
/// \file `ostia mesh --refine-from`: lengths from a solver's result.

#include "commands.h"

#include "ostia/geometry/vec.h"
#include "ostia/pipeline/model.h"

namespace ostia::app {

/// Throws UsageError for options that need others; nothing is read.
void check_refinement(const MeshCommand& options);
/// Reads the result and sets the lengths of surface and inside; nothing where it was not asked for. `box` is
/// around what is meshed. Throws what pipeline::refinement_by throws.
void apply_refinement(const MeshCommand& options, const geometry::Box3& box, pipeline::ModelOptions& how,
                      const core::TaskContext& task);

}  // namespace ostia::app
