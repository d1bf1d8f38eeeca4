#pragma once
/// \file A lumen's surface made ready: welded, outward, its non-manifold places taken out, its holes found and capped.

#include <string>
#include <vector>

#include "ostia/centerline/end_points.h"
#include "ostia/geometry/tri_mesh.h"

namespace ostia::centerline {

struct LumenSurface {
  geometry::TriMesh wall;            ///< without caps
  geometry::TriMesh capped;          ///< begins with the points and triangles of `wall`
  std::vector<Opening> openings;     ///< longest border first
  std::vector<bool> on_border;       ///< points of `capped` that caps use
  std::vector<bool> only_in_caps;    ///< points of `capped` that `wall` does not have
  std::size_t welded_points = 0;     ///< points equal to an earlier one
  std::vector<std::string> warnings;
};

/// Flaps on non-manifold edges and the triangles around vertices where borders touch are left out, so that borders are simple
/// loops; a warning counts them. Throws InvalidInput for a point that is not finite, GeometryError when no triangles are left or
/// the borders cannot be made simple.
LumenSurface prepare_lumen(const geometry::TriMesh& lumen);

}  // namespace ostia::centerline
