#pragma once
/// \file Isotropic remeshing to a size field: split, collapse, flip, relax on the original surface (Botsch
/// and Kobbelt 2004; Dunyach et al. 2013; criteria of [Antiga] 6.1).

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/sizing.h"

#include <string>
#include <vector>

namespace ostia::meshing {

struct RemeshOptions {
  int iterations = 10;               ///< rounds of split, collapse, flip, relax; in [1, 100]
  int mending_rounds = 12;           ///< rounds that work on the worst triangles only; in [0, 100]
  double mend_below_angle_deg = 32;  ///< triangles with a smaller angle than this are worked on; in [0, 50]
  double max_cap_deviation =
      0.02;  ///< a cap farther from its plane than this fraction of its size is refused; in (0, 1]
};
void validate(const RemeshOptions& options);

/// What was done.
struct RemeshReport {
  int iterations = 0;
  std::size_t splits = 0, collapses = 0, flips = 0;
  double mean_edge_ratio = 0.0;       ///< mean over the wall's edges of length over target: 1 is best
  double edge_ratio_deviation = 0.0;  ///< mean of |length / target - 1|
  double min_angle_deg = 0.0;
  std::size_t self_intersections = 0;
  std::vector<std::string> warnings;
};

struct RemeshedOpen {
  geometry::TriMesh mesh;
  RemeshReport report;
};
struct RemeshedSurface {
  geometry::FacedSurface surface;
  RemeshReport report;
};

/// Remeshes an open or closed manifold surface. `edge_lengths_mm`: the target at each input point. Points
/// stay on the input surface; border points stay on the input's border polylines. Deterministic. Throws
/// InvalidInput (options, sizes), GeometryError (not manifold, not oriented).
RemeshedOpen remesh(const geometry::TriMesh& surface, const std::vector<double>& edge_lengths_mm,
                    const RemeshOptions& options = {}, const core::TaskContext& task = core::no_task());

/// The same for a closed surface with faces: the walls are remeshed, the rings between wall and caps are kept
/// as curves (points move along them only), and the caps are triangulated anew in their planes. Ids and names
/// are kept. Throws GeometryError for a cap that is not flat or has not exactly one ring.
RemeshedSurface remesh(const geometry::FacedSurface& surface, const std::vector<double>& edge_lengths_mm,
                       const RemeshOptions& options = {}, const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
