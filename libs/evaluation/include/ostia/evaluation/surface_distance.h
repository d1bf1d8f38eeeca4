#pragma once
/// \file How far two surfaces are apart.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <functional>

namespace ostia::evaluation {

/// Which points of the surfaces count; all when empty.
using Region = std::function<bool(const geometry::Vec3&)>;

struct SurfaceDistanceOptions {
  double sample_mm = 0.2;   ///< triangles are sampled at least this densely, > 0
  Region reference_region;  ///< which points of the reference are asked
  Region result_region;     ///< which points of the result are asked
};

/// Exact point-to-triangle distances from each surface to the other, weighted by area, mm. Signed values are
/// those of the result's points: positive outside the reference (which must then be closed).
struct SurfaceDistances {
  double msd_mm = 0.0;  ///< mean over both surfaces
  double rms_sd_mm = 0.0;
  double hd95_mm = 0.0;    ///< the larger of the two one-sided 95 % quantiles
  double max_sd_mm = 0.0;  ///< the larger of the two one-sided maxima (Hausdorff)
  double signed_mean_mm = 0.0;
  double signed_sd_mm = 0.0;
};

/// Throws InvalidInput for empty surfaces, or where no point counts.
SurfaceDistances compare_surfaces(const geometry::TriMesh& reference, const geometry::TriMesh& result,
                                  const SurfaceDistanceOptions& options = {},
                                  const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
