#pragma once
/// \file Surfaces from points with normals. See docs/methods/poisson-surface.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::meshing {

struct PoissonOptions {
  double cell_mm = 0.0;  ///< of the grid on which the surface is found, >= 0; 0: the points' mean spacing
  int band_cells = 3;    ///< the surface keeps within so many cells of a point; in [1, 20]
};
void validate(const PoissonOptions& options);  ///< throws InvalidInput

/// The surface of the solid whose boundary was sampled (Kazhdan, Bolitho and Hoppe 2006, by which [Yi] 5.1
/// makes vessels of masks): the indicator function whose gradient is nearest to the normals, solved on a
/// Delaunay tetrahedralisation that is refined about the points, where it equals the mean of its values at
/// the points nearby. `normals` point outward, one a point, of any length above 0. Closed, outward and free
/// of self-intersections; none farther than `band_cells` from every point. Deterministic. Throws InvalidInput
/// (fewer than 4 points, not finite ones, a normal without length, points in a plane, a grid of 2^31 nodes or
/// more), NumericalError where the system cannot be solved, Cancelled.
geometry::TriMesh poisson_surface(const std::vector<geometry::Vec3>& points,
                                  const std::vector<geometry::Vec3>& normals,
                                  const PoissonOptions& options = {},
                                  const core::TaskContext& task = core::no_task());

/// The same through the vertices of a closed outward surface, such as a mask's stairs.
geometry::TriMesh poisson_surface(const geometry::TriMesh& surface, const PoissonOptions& options = {},
                                  const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
