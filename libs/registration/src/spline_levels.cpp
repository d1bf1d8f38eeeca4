#include "spline_levels.h"

#include <cmath>

namespace ostia::registration {
namespace {

/// One axis of knot insertion: fine node j of coarse ones along `axis`.
SplineGrid refined_along(const SplineGrid& coarse, int axis) {
  SplineGrid fine;
  fine.nodes = coarse.nodes;
  fine.nodes.size[axis] = 2 * (coarse.nodes.size[axis] - 3) + 3;
  fine.nodes.spacing[axis] = 0.5 * coarse.nodes.spacing[axis];
  fine.nodes.origin += fine.nodes.spacing[axis] * fine.nodes.direction.col(axis);
  fine.shifts_mm.resize(fine.nodes.voxels());
  std::array<std::int64_t, 3> at{};
  for (at[2] = 0; at[2] < fine.nodes.size[2]; ++at[2])
    for (at[1] = 0; at[1] < fine.nodes.size[1]; ++at[1])
      for (at[0] = 0; at[0] < fine.nodes.size[0]; ++at[0]) {
        const std::int64_t j = at[axis];
        const auto node = [&](std::int64_t i) -> const Vec3& {
          std::array<std::int64_t, 3> from = at;
          from[axis] = i;
          return coarse.shifts_mm[coarse.nodes.offset(from[0], from[1], from[2])];
        };
        const std::int64_t i = (j + 1) / 2;
        fine.shifts_mm[fine.nodes.offset(at[0], at[1], at[2])] =
            j % 2 == 1 ? Vec3((node(i - 1) + 6.0 * node(i) + node(i + 1)) / 8.0)
                       : Vec3((node(j / 2) + node(j / 2 + 1)) / 2.0);
      }
  return fine;
}

}  // namespace

SplineGrid resting_spline(const geometry::Box3& box, double spacing_mm) {
  SplineGrid grid;
  for (int a = 0; a < 3; ++a) {
    const double extent = box.sizes()[a];
    const auto cells = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(extent / spacing_mm)));
    grid.nodes.size[a] = cells + 3;
    grid.nodes.spacing[a] = extent / static_cast<double>(cells);
    grid.nodes.origin[a] = box.min()[a] - grid.nodes.spacing[a];
  }
  grid.shifts_mm.assign(grid.nodes.voxels(), Vec3::Zero());
  return grid;
}

SplineGrid refined(const SplineGrid& coarse) {
  return refined_along(refined_along(refined_along(coarse, 0), 1), 2);
}

}  // namespace ostia::registration
