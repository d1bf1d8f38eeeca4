#pragma once
/// \file Vesselness as A. F. Frangi et al. published it (MICCAI 1998): a method to compare with.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::experiments {

struct FrangiOptions {
  std::vector<double> sigmas_mm{0.6, 0.9, 1.35, 2.0};  ///< radii of 0.85 to 2.8 mm answer most
  double alpha = 0.5, beta = 0.5;                      ///< of plates and blobs
  double c_share = 0.5;  ///< c over the largest norm of the Hessian at the scale
};

/// In [0, 1], for bright vessels: (1 - exp(-A^2 / 2 alpha^2)) exp(-B^2 / 2 beta^2) (1 - exp(-S^2 / 2 c^2)),
/// the largest over the scales; A = |l2 / l3|, B = |l1| / sqrt |l2 l3|, S = |H|, of the Hessian after a
/// Gaussian, times its variance, with eigenvalues |l1| <= |l2| <= |l3|; 0 where l2 or l3 is above 0, and in
/// the image's outermost voxels. The same for any number of threads. Throws Cancelled.
imaging::FloatVolume frangi_vesselness(const imaging::ImageVolume& image, const FrangiOptions& options = {},
                                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
