#pragma once
/// \file A lumen cut open half-way along the direction of sight.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"

#include <vector>

namespace ostia::solver {

/// The surface on which the wall in front is as far as the wall behind: it follows curved vessels, as no
/// plane does. Linear in each tetrahedron (a prism is three).
struct MidCut {
  geometry::TriMesh surface;   ///< towards the viewer
  std::vector<double> values;  ///< of each triangle, the mean of its corners
  geometry::TriMesh behind;    ///< the wall behind it
};
/// `values` and `wall` belong to the mesh's points and to the wall's surface of `wall_surface`.
MidCut mid_cut(const geometry::MixedMesh& mesh, const geometry::TriMesh& wall,
               const std::vector<std::int32_t>& wall_points, const std::vector<double>& values,
               const geometry::Vec3& sight, const core::TaskContext& task = core::no_task());

}  // namespace ostia::solver
