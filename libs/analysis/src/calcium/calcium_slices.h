#pragma once
/// \file The slices that calcium is scored on.

#include "ostia/analysis/calcium_score.h"

#include <vector>

namespace ostia::analysis {

struct CalciumSlices {
  imaging::FloatVolume
      image;                  ///< slices along k; those across the patient's length, whatever the scan's axes
  double slice_mm = 0.0;      ///< distance of the scan's own
  int averaged = 1;           ///< of them in one of these
  std::vector<double> share;  ///< of each: of `averaged` that it is made of (the last may have fewer)
  /// What one of them counts in the Agatston score: its height over the definition's.
  double height(std::int64_t k, double definition_mm) const {
    return image.geometry.spacing.z() * share[static_cast<std::size_t>(k)] / definition_mm;
  }
  double voxel_mm3(std::int64_t k) const {
    return image.geometry.spacing.prod() * share[static_cast<std::size_t>(k)];
  }
};

/// Throws InvalidInput where slices are too far apart or too few.
CalciumSlices calcium_slices(const imaging::ImageVolume& image, const CalciumOptions& options,
                             const core::TaskContext& task);

}  // namespace ostia::analysis
