#pragma once
/// \file Pictures of a finished run.

#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"
#include "ostia/solver/flow_result.h"

namespace ostia::solver {

/// The wall from its broad side and from behind, coloured by the magnitude of its shear stress (time-averaged
/// where the flow is pulsatile) from 0 to a round value above 99 % of the area; colours go with the
/// square root, so that low values and a stenosis are seen in one picture.
figure::Picture wall_shear_picture(const FlowResult& result, const core::TaskContext& task = core::no_task());

/// The lumen cut open half-way along the line of sight onto its broad side, coloured by the speed of the
/// blood (of the mean velocity where the flow is pulsatile).
figure::Picture speed_picture(const FlowResult& result, const core::TaskContext& task = core::no_task());

}  // namespace ostia::solver
