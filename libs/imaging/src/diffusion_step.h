#pragma once
/// \file One explicit step of a diffusion.

#include "ostia/core/task_context.h"
#include "ostia/imaging/diffusion.h"

#include <vector>

namespace ostia::imaging::detail {

struct StepOptions {
  Diffusion method = Diffusion::flux;
  double contrast = 1.0;  ///< k, > 0
  double dt = 0.0;        ///< mm^2
  double attachment = 0.0;
};

/// `next` = u after one step; `smooth` (on the same grid) decides where flux goes and is not looked at by the
/// other methods; `start` is the image that `attachment` pulls to.
void diffusion_step(const Geometry& grid, const std::vector<float>& u, const std::vector<float>& smooth,
                    const std::vector<float>& start, const StepOptions& options, std::vector<float>& next,
                    const core::TaskContext& task);

}  // namespace ostia::imaging::detail
