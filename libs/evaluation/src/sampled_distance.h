#pragma once
/// \file Unsigned distances from one surface to another, without the cost of telling inside from outside.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/geometry/aabb_tree.h"

namespace ostia::evaluation {

/// Sums over samples, weighted by area.
struct DistanceSums {
  double area = 0.0, sum = 0.0, squares = 0.0, max = 0.0;
  double mean() const { return area > 0.0 ? sum / area : 0.0; }
};
DistanceSums operator+(const DistanceSums& a, const DistanceSums& b);

/// From the points of `from` that count (all when empty) to the surface in `to`; each triangle in k^2 equal
/// parts whose edges are no longer than `sample_mm`, asked at their centroids.
DistanceSums distances_to(const geometry::AabbTree& to, const geometry::TriMesh& from, double sample_mm,
                          const Region& counts, const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
