#pragma once
/// \file The part of a surface's Voronoi diagram that lies inside it ([Antiga] section 4: the embedded
/// Voronoi diagram).

#include "ostia/centerline/known_surface.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::centerline {

/// Vertices are circumcentres of Delaunay cells, polygons are dual to Delaunay edges; polygons meet along
/// edges that may belong to any number of them (a non-manifold complex).
struct InnerVoronoi {
  std::vector<geometry::Vec3> points;  ///< mm
  std::vector<double> radius;  ///< circumradius: the largest sphere that holds no point of the surface, mm
  std::vector<std::array<std::int32_t, 4>>
      links;  ///< Voronoi edges: the up to four neighbours of a point, else -1
  std::vector<std::int32_t>
      polygon_first;                  ///< first corner of polygon i in `corners`; one more entry at the end
  std::vector<std::int32_t> corners;  ///< points around each polygon, in order
  std::vector<std::int32_t>
      incidence_first;  ///< first polygon of point i in `incidence`; one more entry at the end
  std::vector<std::int32_t> incidence;  ///< polygons around each point
  std::size_t delaunay_cells = 0;
  std::size_t doubtful_cells = 0;  ///< settled by the winding number
  std::size_t dropped_points = 0;
  std::size_t polygon_count() const { return polygon_first.empty() ? 0 : polygon_first.size() - 1; }
};

/// The inner Voronoi diagram of the points that `capped` uses. `capped` is outward and without holes (small
/// faults are tolerated); `on_border` (one a point, or empty) marks points near which the normals do not tell
/// inside from outside (cap borders), `skip` (one a point, or empty) points that only caps use and that are
/// no sites of the diagram.
///
/// A cell is inside when its circumcentre is: where all four corners' normals agree clearly their vote
/// decides, elsewhere the generalised winding number of the circumcentre. A cell so flat that its
/// circumcentre is lost to round-off takes its neighbour's, which lies on the same axis. `known` may bring
/// the tree and the tetrahedra. Throws GeometryError when nothing is inside, and what `delaunay` throws.
InnerVoronoi inner_voronoi(const geometry::TriMesh& capped, const std::vector<bool>& on_border = {},
                           const std::vector<bool>& skip = {},
                           const core::TaskContext& task = core::no_task(),
                           const KnownSurface* known = nullptr);

}  // namespace ostia::centerline
