#pragma once
/// \file Spots of calcium in slices, and the lesions that they are of.

#include "calcium/calcium_slices.h"

#include "ostia/imaging/morphology.h"

namespace ostia::analysis {

/// A connected spot in one slice, large enough to count.
struct CalciumSpot {
  std::int64_t slice = 0, first_voxel = 0;  ///< offset of one of its voxels in the image
  double area_mm2 = 0.0, peak_hu = 0.0;
};

struct CalciumSpots {
  std::vector<CalciumSpot> spots;
  imaging::Components parts;  ///< of what the spots cover, in space
};
CalciumSpots calcium_spots(const CalciumSlices& slices, const CalciumOptions& options,
                           const core::TaskContext& task);

/// 1 to 4 by the brightest voxel (Agatston et al. 1990); 0 below the threshold of 130 HU.
int agatston_weight(double peak_hu);

/// Of each part, [0] of nothing: measures, centre, peak and slices. The rest stays as it is.
std::vector<CalciumLesion> measured_parts(const CalciumSlices& slices, const CalciumSpots& found,
                                          const CalciumOptions& options, const core::TaskContext& task);

}  // namespace ostia::analysis
