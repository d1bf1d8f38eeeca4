#include "sampled_distance.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

void add_sample(const geometry::AabbTree& to, const Vec3& p, double weight, const Region& counts,
                DistanceSums& sums) {
  if (counts && !counts(p)) return;
  const double d = to.closest(p).distance;
  sums.area += weight;
  sums.sum += weight * d;
  sums.squares += weight * d * d;
  sums.max = std::max(sums.max, d);
}

void add_triangle(const geometry::AabbTree& to, const Vec3& a, const Vec3& b, const Vec3& c, double sample_mm,
                  const Region& counts, DistanceSums& sums) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const int k = std::max(1, static_cast<int>(std::ceil(longest / sample_mm)));
  const double weight = 0.5 * (b - a).cross(c - a).norm() / (static_cast<double>(k) * k);
  const Vec3 u = (b - a) / k, v = (c - a) / k;
  for (int i = 0; i < k; ++i) {
    for (int j = 0; i + j < k; ++j) {
      add_sample(to, a + (i + 1.0 / 3.0) * u + (j + 1.0 / 3.0) * v, weight, counts, sums);
      if (i + j + 1 < k) add_sample(to, a + (i + 2.0 / 3.0) * u + (j + 2.0 / 3.0) * v, weight, counts, sums);
    }
  }
}

}  // namespace

DistanceSums operator+(const DistanceSums& a, const DistanceSums& b) {
  return {a.area + b.area, a.sum + b.sum, a.squares + b.squares, std::max(a.max, b.max)};
}

DistanceSums distances_to(const geometry::AabbTree& to, const geometry::TriMesh& from, double sample_mm,
                          const Region& counts, const core::TaskContext& task) {
  const auto at = [&](std::int32_t i) { return from.points[static_cast<std::size_t>(i)]; };
  return core::parallel_reduce(
      from.triangles.size(), 64, DistanceSums{},
      [&](std::size_t first, std::size_t last) {
        task.throw_if_cancelled();
        DistanceSums sums;
        for (std::size_t t = first; t < last; ++t) {
          const auto& [a, b, c] = from.triangles[t];
          add_triangle(to, at(a), at(b), at(c), sample_mm, counts, sums);
        }
        return sums;
      },
      [](const DistanceSums& a, const DistanceSums& b) { return a + b; });
}

}  // namespace ostia::evaluation
