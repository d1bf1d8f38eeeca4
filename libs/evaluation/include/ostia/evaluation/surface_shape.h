#pragma once
/// \file What a surface is like by itself: area, volume, and how bumpy it is.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::evaluation {

/// Principal curvatures at a vertex, 1/mm, kappa1 >= kappa2; positive where the surface bulges outward (a
/// ball of radius r: both 1/r). NaN where they cannot be had: borders, fewer than five neighbours, a fit
/// without a single solution.
struct PrincipalCurvatures {
  double kappa1 = 0.0, kappa2 = 0.0;
};

/// By the least-squares quadric z = a x^2 + b x y + c y^2 + d x + e y through the vertex, over its direct
/// neighbours, in the frame of its normal. Vertices with fewer than five neighbours take their neighbours'
/// too. Throws InvalidInput for a surface without triangles or with points that are not finite.
std::vector<PrincipalCurvatures> curvatures(const geometry::TriMesh& mesh,
                                            const core::TaskContext& task = core::no_task());

struct SurfaceShape {
  double area_mm2 = 0.0;
  bool closed = false;      ///< every edge has two triangles
  double volume_mm3 = 0.0;  ///< NaN for an open surface
  /// Root mean squares over the vertices, weighted by a third of the area of the triangles around each.
  double rms_kappa1 = 0.0, rms_kappa2 = 0.0, rms_curvature = 0.0;  ///< last: of sqrt(kappa1^2 + kappa2^2)
  std::size_t vertices_left_out = 0;                               ///< whose curvatures are NaN
};
/// Throws what curvatures() throws. All root mean squares are NaN when no vertex has curvatures.
SurfaceShape shape_of(const geometry::TriMesh& mesh, const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
