#pragma once
/// \file The built-in case held against its truth.

#include "ostia/evaluation/axis_error.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/phantom/builtin_case.h"
#include "ostia/pipeline/model.h"

namespace ostia::pipeline {

/// Errors away from the ends (nearer than two radii to a cut, where the model stops on purpose) and, for the
/// axes, further than 2.5 radii from the bifurcation, where an axis is a matter of definition.
struct TruthErrors {
  evaluation::SurfaceDistances lumen;
  evaluation::AxisSummary axis;
  double throat_radius_mm = 0.0;  ///< least radius found within the stenosis
  double true_throat_radius_mm = 0.0;
  double throat_relative = 0.0;  ///< |found - true| / true
};
TruthErrors compare_with_truth(const phantom::BuiltinCase& truth, const Model& model,
                               const core::TaskContext& task = core::no_task());

/// The built-in case as a job's input, and the branches a person would have clicked.
Source source_of(const phantom::BuiltinCase& builtin);
std::vector<segmentation::BranchSeeds> branches_of(const phantom::BuiltinCase& builtin);

}  // namespace ostia::pipeline
