#pragma once
/// \file Feature images: what pulls a level set ([Antiga] 3.4).

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/seeds.h"

namespace ostia::segmentation {

/// How |grad I| is taken on the grid.
enum class GradientScheme {
  centred,  ///< (I[i+1] - I[i-1]) / 2h
  upwind    ///< max(-(I[i+1] - I[i]), I[i] - I[i-1]) / h ([Antiga] eq. 4): towards darker neighbours only,
            ///< never below 0
};

/// |grad I| in HU/mm on the voxels of `region`, with the spacing of each axis in its derivative; neighbours
/// outside the region but inside the image are used, and at the border of the image differences are
/// one-sided. Throws InvalidInput for a region that is empty or not inside the image.
imaging::FloatVolume gradient_magnitude(const imaging::ImageVolume& image, const imaging::Region& region,
                                        GradientScheme scheme,
                                        const core::TaskContext& task = core::no_task());

/// |grad (G * I)| in HU/mm on the voxels of `region`: derivatives of the image convolved with a Gaussian of
/// standard deviation `sigma_mm` (> 0), by centred differences of `imaging::gaussian_blurred`, which are the
/// exact derivatives of the discrete scale space (T. Lindeberg, IEEE Trans. Pattern Anal. Mach. Intell.
/// 12:234-254, 1990). Quiet where differences between voxels are not, blind to vessels much thinner than
/// sigma. Throws InvalidInput for a bad sigma or region.
imaging::FloatVolume gaussian_gradient_magnitude(const imaging::ImageVolume& image,
                                                 const imaging::Region& region, double sigma_mm,
                                                 const core::TaskContext& task = core::no_task());

/// exp(-(I - mean)^2 / sigma^2) - tau on the voxels of `region`: 1 - tau where the image is like the vessel,
/// -tau where it is not ([Luboz] 2.1). Throws InvalidInput for a sigma that is not positive or a bad region.
imaging::FloatVolume balloon_speed(const imaging::ImageVolume& image, const imaging::Region& region,
                                   double mean_hu, double sigma_hu, double tau);

/// log(1 + (P/k)^2) / 2 of a gradient magnitude P (in place of P): the same ridges, but faint and strong
/// walls pull alike, and what is below the noise `k_hu_per_mm` (> 0) pulls hardly at all.
void compress_feature(imaging::FloatVolume& gradient_magnitude, double k_hu_per_mm);

}  // namespace ostia::segmentation
