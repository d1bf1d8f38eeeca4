#pragma once
/// \file The wall that editing starts from.

#include "ostia/core/task_context.h"
#include "ostia/geometry/contour_set.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/lumen/lumen_model.h"

#include <functional>
#include <optional>
#include <vector>

namespace ostia::lumen {

/// How densely a wall is sampled: a ring every `spacing`, so many samples on it that they are as far apart.
struct SamplingOptions {
  double spacing_mm = 1.0;        ///< of samples on a wide, even wall, [0.1, 5]
  double least_spacing_mm = 0.4;  ///< where curvature and narrowing ask for more
  int least_around = 8;           ///< samples of a ring
};
void validate(const SamplingOptions& options);

/// A wall about an axis: the distance from it in the direction theta at the abscissa s, mm, > 0.
using RadialWall = std::function<double(double s_mm, double theta)>;

/// Samples of a wall given about an axis, from `from_mm` to `to_mm`, with rounded caps beyond a vessel's
/// ends; denser where the wall narrows or bends. Ids are counted from `first_id`.
std::vector<SurfaceSample> samples_of(const geometry::AxisCurve& axis, const RadialWall& wall, double from_mm,
                                      double to_mm, std::int64_t first_id,
                                      const SamplingOptions& options = {});

/// Models of a whole tree (docs/methods/start-surface.md). Throw InvalidInput for a tree with a fault, a
/// vessel of fewer than three points, without a segment of its own or shorter than its radius, an axis with a
/// kink or a loop (naming the vessel and the abscissa), or radii that are not positive. Tube: of the axes'
/// own radii, or of one regular radius.
LumenModel model_of_tubes(const geometry::VesselTree& tree, std::optional<double> radius_mm = {},
                          const SamplingOptions& options = {});
/// From radial walls, one a vessel of the tree (an image's boundary on rays); a vessel without one starts as
/// a tube.
LumenModel model_of_walls(const geometry::VesselTree& tree, const std::vector<RadialWall>& walls,
                          const SamplingOptions& options = {});
/// From a closed or open surface: along rays from the axis to its nearest crossing, a tube where there is
/// none.
LumenModel model_of_surface(const geometry::VesselTree& tree, const geometry::TriMesh& surface,
                            const SamplingOptions& options = {},
                            const core::TaskContext& task = core::no_task());
/// From contours: the stretches that they cover are theirs, the rest is a tube of the axis' radii, and the
/// passage is smooth. Vessels are matched by name; of one place only one observer's lumen may be given.
LumenModel model_of_contours(const geometry::VesselTree& tree, const geometry::ContourSet& contours,
                             const SamplingOptions& options = {});

}  // namespace ostia::lumen
