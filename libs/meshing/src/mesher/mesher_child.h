#pragma once
/// \file The meshers' processes, and what happens when one fails.

#include "mesher/mesher_job.h"

#include "ostia/core/task_context.h"
#include "ostia/meshing/tetrahedralize.h"

namespace ostia::meshing {

/// TetGen; where that fails once more with less asked for; where that fails too Mesh_3, as options.mesher
/// allows. Tells in report.made_by and report.warnings what it came to. Throws GeometryError, ResourceError,
/// Cancelled.
MesherResult run_mesher(MesherJob job, const TetrahedralizeOptions& options, TetrahedralizeReport& report,
                        const core::TaskContext& task);

}  // namespace ostia::meshing
