#pragma once
/// \file Views of an image for a case's report.

#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/reformat/plane_image.h"

#include <vector>

namespace ostia::phantom {

/// The largest value along each pixel's line of sight within `thickness_mm` about the plane; NaN where no
/// sample lies in the image.
reformat::PlaneImage maximum_projection(const imaging::ImageVolume& image, const reformat::Plane& plane,
                                        double thickness_mm, const core::TaskContext& task = core::no_task());

figure::Picture axial_gallery(const imaging::ImageVolume& image);
figure::Picture projections(const CasePlan& plan, const imaging::ImageVolume& image,
                            const core::TaskContext& task);
/// Along each of RCA, LAD and LCX, cut along the frame's normal, with the true boundaries.
figure::Picture straightened_views(const CasePlan& plan, const imaging::ImageVolume& image);
/// Across the vessel at the throats of the worst stenoses, with the true lumen and outer wall.
figure::Picture stenosis_sections(const CasePlan& plan, const imaging::ImageVolume& image);
/// The heart's surface with the arteries on it: the patient's own, what was grown, from four sides.
figure::Picture heart_picture(const CasePlan& plan, const core::TaskContext& task);
bool has_stenosis_in(const CasePlan& plan, const imaging::Geometry& grid);

}  // namespace ostia::phantom
