#pragma once
/// \file A lumen's surface made ready: welded, outward, its non-manifold places taken out, its holes found
/// and capped.

#include "ostia/centerline/end_points.h"
#include "ostia/centerline/known_surface.h"
#include "ostia/geometry/tri_mesh.h"

#include <string>
#include <vector>

namespace ostia::centerline {

struct LumenSurface {
  geometry::TriMesh wall;    ///< without caps
  geometry::TriMesh capped;  ///< begins with the points and triangles of `wall`
  geometry::TriMesh
      sampled;  ///< `capped` with long edges of its wall cut: its points are dense enough for the diagram
  std::vector<Opening> openings;   ///< longest border first
  std::vector<bool> on_border;     ///< points of `sampled` that caps use
  std::vector<bool> only_in_caps;  ///< points of `sampled` that only caps use
  std::size_t welded_points = 0;   ///< points equal to an earlier one
  std::vector<std::string> warnings;
};

/// `wall` with every edge longer than `longest_mm` halved until none is left; new points lie on the edges,
/// after the old ones.
geometry::TriMesh with_edges_cut(const geometry::TriMesh& wall, double longest_mm);

/// Flaps on non-manifold edges and the triangles around vertices where borders touch are left out, so that
/// borders are simple loops; a warning counts them. Throws InvalidInput for a point that is not finite,
/// GeometryError when no triangles are left or the borders cannot be made simple.
LumenSurface prepare_lumen(const geometry::TriMesh& lumen, const KnownSurface* known = nullptr);

/// The wall of it alone, for who needs no diagram: without the sampling, which has millions of points where a
/// part is next to flat.
geometry::TriMesh simple_wall(const geometry::TriMesh& lumen);

}  // namespace ostia::centerline
