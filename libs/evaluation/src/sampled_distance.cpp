#include "sampled_distance.h"

#include "ostia/core/parallel.h"

#include <algorithm>

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

}  // namespace

DistanceSums operator+(const DistanceSums& a, const DistanceSums& b) {
  return {a.area + b.area, a.sum + b.sum, a.squares + b.squares, std::max(a.max, b.max)};
}

DistanceSums distances_to(const geometry::AabbTree& to, const geometry::TriMesh& from, double sample_mm,
                          const Region& counts, const core::TaskContext& task) {
  return core::parallel_reduce(
      from.triangles.size(), 64, DistanceSums{},
      [&](std::size_t first, std::size_t last) {
        task.throw_if_cancelled();
        DistanceSums sums;
        for (std::size_t t = first; t < last; ++t) {
          for_each_sample(from, from.triangles[t], sample_mm,
                          [&](const Vec3& p, double area) { add_sample(to, p, area, counts, sums); });
        }
        return sums;
      },
      [](const DistanceSums& a, const DistanceSums& b) { return a + b; });
}

}  // namespace ostia::evaluation
