#pragma once
/// \file Upright tubes of contrast: discs on axial slices that go on from slice to slice.

#include "disc_fit.h"

#include "ostia/core/task_context.h"

#include <vector>

namespace ostia::coronary {

/// Discs of neighbouring slices, from below upwards.
struct DiscColumn {
  std::vector<DiscFit> discs;
  double length_mm() const { return (discs.back().centre - discs.front().centre).norm(); }
  double mean_radius_mm() const;
  double mean_hu() const;
};

struct ColumnOptions {
  DiscFitOptions disc;
  double slice_step_mm = 2.0, grid_step_mm = 4.0;
  double least_round = 0.7, largest_residual = 0.07;
  double largest_shift = 0.9;    ///< of a centre from slice to slice, in slice steps
  double largest_change = 0.12;  ///< of the radius from slice to slice, as a share
  double least_length_mm = 12.0;
};

/// Longest first. Slices are planes across the patient's z, whatever the image's axes.
std::vector<DiscColumn> disc_columns(const imaging::ImageVolume& image, const ColumnOptions& options,
                                     const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
