#pragma once
// Cutting the free ends of an analytic shape's surface flat.

#include "ostia/geometry/analytic_shapes.h"

#include <vector>

namespace ostia::geometry {

/// Where a tube ends in the open: the plane through `centre` with `normal` pointing out of the tube.
struct FreeEnd {
  Vec3 centre, normal;
  double radius;
};

/// Ends of tubes that are neither inside another tube nor closed on themselves.
std::vector<FreeEnd> free_ends(const AnalyticShape& shape);

/// Removes what lies beyond the end's plane near the end. The hole's border lies on the plane; with `exact`
/// also on the surface f = 0.
void cut_flat(TriMesh& mesh, const FreeEnd& end, const TubeDistance& f, double spacing_mm, bool exact);

}  // namespace ostia::geometry
