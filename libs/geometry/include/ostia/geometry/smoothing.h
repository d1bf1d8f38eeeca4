#pragma once
/// \file Smoothing of surfaces without shrinkage.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

namespace ostia::geometry {

struct TaubinOptions {
  int iterations = 30;     ///< pairs of a shrinking and an inflating step, >= 0
  double pass_band = 0.1;  ///< k_PB of Taubin 1995, in (0, 2): the smaller, the smoother
  double lambda = 0.33;    ///< weight of the shrinking step, in (0, 1); the inflating one follows from k_PB =
                           ///< 1/lambda + 1/mu
};
/// Throws InvalidInput out of range, and where the two would make the roughest ripples grow.
void validate(const TaubinOptions& options);

/// Taubin's lambda|mu filter (1995; [Antiga] 3.3) with equal weights for all neighbours. Border points stay.
/// Connectivity is kept. Throws InvalidInput for points that are not finite, Cancelled within one iteration.
TriMesh taubin_smoothed(const TriMesh& mesh, const TaubinOptions& options = {},
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::geometry
