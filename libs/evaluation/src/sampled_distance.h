#pragma once
/// \file Unsigned distances from one surface to another, without the cost of telling inside from outside.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>

namespace ostia::evaluation {

/// visit(centroid, area) of each of the k^2 equal parts of a triangle, k the least with edges no longer than
/// `sample_mm`, at most 64.
template <class Visit>
void for_each_sample(const geometry::TriMesh& mesh, const geometry::Triangle& triangle, double sample_mm,
                     const Visit& visit) {
  const auto corner = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(triangle[i])]; };
  const geometry::Vec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
  const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
  const int k = std::clamp(static_cast<int>(std::ceil(longest / sample_mm)), 1, 64);
  const double area = 0.5 * ab.cross(ac).norm() / (k * k);
  const auto at = [&](double u, double v) { visit(geometry::Vec3(a + ab * u + ac * v), area); };
  for (int i = 0; i < k; ++i) {
    for (int j = 0; i + j < k; ++j) {
      at((i + 1.0 / 3.0) / k, (j + 1.0 / 3.0) / k);
      if (i + j + 1 < k) at((i + 2.0 / 3.0) / k, (j + 2.0 / 3.0) / k);
    }
  }
}

/// Sums over samples, weighted by area.
struct DistanceSums {
  double area = 0.0, sum = 0.0, squares = 0.0, max = 0.0;
  double mean() const { return area > 0.0 ? sum / area : 0.0; }
};
DistanceSums operator+(const DistanceSums& a, const DistanceSums& b);

/// From the points of `from` that count (all when empty) to the surface in `to`, asked at the
/// samples of each triangle.
DistanceSums distances_to(const geometry::AabbTree& to, const geometry::TriMesh& from, double sample_mm,
                          const Region& counts, const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
