#pragma once
/// \file The aorta of a contrast-enhanced CT, found without a click.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::coronary {

using geometry::Vec3;

/// docs/methods/coronary-aorta.md gives the method and where the defaults come from.
struct AortaOptions {
  double least_hu = 150.0;  ///< mean intensity that counts as contrast, [100, 400]
  /// Of the aorta, (least, 4000]: what is brighter is undiluted contrast in a vein.
  double most_hu = 4000.0;
  double smallest_radius_mm = 8.0;  ///< of the aorta, [5, 20]
  double largest_radius_mm = 25.0;  ///< (smallest, 40]
  double work_spacing_mm = 1.5;     ///< of the image that is looked at, [1, 3]
  double least_column_mm = 12.0;    ///< of ascending aorta that stands upright in the image, [6, 60]
};
void validate(const AortaOptions& options);  ///< throws InvalidInput

/// A section across the aorta.
struct AortaStation {
  Vec3 centre = Vec3::Zero();    ///< LPS, mm
  Vec3 tangent = Vec3::UnitZ();  ///< unit, away from the heart
  double radius_mm = 0.0;        ///< of the circle through most of the lumen's edge
  double round = 0.0;            ///< share of the edge that lies on it, [0, 1]
};

struct Aorta {
  /// From the root, or from the image's border where the root lies beyond it, through the ascending aorta and
  /// as far along the arch as it can be followed; equal steps.
  std::vector<AortaStation> stations;
  double lumen_hu = 0.0;  ///< mean over the ascending aorta
  double noise_hu = 0.0;  ///< median of the sections' standard deviations
};

/// Upright tubes of contrast are found as discs on axial slices that go on from slice to slice; the ascending
/// aorta is the longest of those about as bright as the brightest even one that has no like far in front of
/// it and no lung behind it (the descending aorta has both). From there it is followed both ways, section by
/// section. Deterministic. Throws InvalidInput for options out of range or an empty image, GeometryError
/// where no such tube is there
/// ("no contrast-filled aorta ...": what was looked for, what was seen, what to do), Cancelled.
Aorta find_aorta(const imaging::ImageVolume& image, const AortaOptions& options = {},
                 const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
