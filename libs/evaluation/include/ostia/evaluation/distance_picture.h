#pragma once
/// \file A surface coloured by how far it lies outside or inside another one.

#include "ostia/core/task_context.h"
#include "ostia/figure/scene.h"
#include "ostia/geometry/tri_mesh.h"

#include <string>
#include <vector>

namespace ostia::evaluation {

/// At the centroid of each triangle of `result`: exact distance to `reference`, mm, positive outside. The
/// side is that of the reference's winding number where it is closed, of its nearest triangle elsewhere.
/// Throws InvalidInput for empty surfaces.
std::vector<double> signed_distances(const geometry::TriMesh& reference, const geometry::TriMesh& result,
                                     const core::TaskContext& task = core::no_task());

struct DistanceFigureOptions {
  double range_mm = 0.0;  ///< colours saturate there; 0: a round number about the 99 % quantile of |distance|
  std::string title{};
  int width_px = 920, height_px = 620;
};
/// Blue inside, light where it fits, vermilion outside; nine steps, named in the legend as a colour bar does.
figure::Picture distance_figure(const geometry::TriMesh& surface, const std::vector<double>& distance_mm,
                                const DistanceFigureOptions& options = {},
                                const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
