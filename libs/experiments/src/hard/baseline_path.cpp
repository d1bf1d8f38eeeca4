#include "hard/baseline_path.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <set>
#include <utility>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

struct WayStep {
  std::array<std::int64_t, 3> by{};
  std::int64_t offset = 0;
  double length_mm = 0.0;
};

std::vector<WayStep> way_steps(const imaging::Geometry& grid) {
  std::vector<WayStep> steps;
  for (std::int64_t k = -1; k <= 1; ++k)
    for (std::int64_t j = -1; j <= 1; ++j)
      for (std::int64_t i = -1; i <= 1; ++i)
        if (i != 0 || j != 0 || k != 0)
          steps.push_back({{i, j, k},
                           grid.offset(i, j, k),
                           grid.spacing.cwiseProduct(Vec3(double(i), double(j), double(k))).norm()});
  return steps;
}

std::array<std::int64_t, 3> voxel_of(const imaging::Geometry& grid, std::int64_t offset) {
  const std::int64_t row = offset / grid.size[0];
  return {offset % grid.size[0], row % grid.size[1], row / grid.size[1]};
}

std::int64_t voxel_at(const imaging::Geometry& grid, const Vec3& place) {
  const Vec3 index = grid.index(place);
  std::array<std::int64_t, 3> at{};
  for (std::size_t a = 0; a < 3; ++a)
    at[a] = std::clamp<std::int64_t>(std::llround(index[static_cast<int>(a)]), 0, grid.size[a] - 1);
  return grid.offset(at[0], at[1], at[2]);
}

}  // namespace

imaging::FloatVolume cost_per_mm(const imaging::ImageVolume& image, const CheapestWayOptions& options,
                                 const core::TaskContext& task) {
  imaging::FloatVolume cost = frangi_vesselness(image, options.vesselness, task);
  core::parallel_for(cost.voxels.size(), 1 << 16, [&](std::size_t i) {
    const double bright =
        1.0 / (1.0 + std::exp((options.bright_hu - image.voxels[i]) / options.bright_width_hu));
    cost.voxels[i] = static_cast<float>(1.0 / (cost.voxels[i] * bright + options.least));
  });
  return cost;
}

std::vector<std::vector<Vec3>> cheapest_ways(const imaging::FloatVolume& cost_per_mm, const Vec3& from,
                                             const std::vector<Vec3>& to, const core::TaskContext& task) {
  const imaging::Geometry& grid = cost_per_mm.geometry;
  const std::vector<WayStep> steps = way_steps(grid);
  const std::int64_t start = voxel_at(grid, from);
  std::set<std::int64_t> ends;  // those that are not reached yet
  for (const Vec3& place : to) ends.insert(voxel_at(grid, place));
  std::vector<double> paid(cost_per_mm.voxels.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> came_by(cost_per_mm.voxels.size(), 0);
  using Place = std::pair<double, std::int64_t>;
  std::priority_queue<Place, std::vector<Place>, std::greater<>> front;
  const auto cost_at = [&](std::int64_t at) { return cost_per_mm.voxels[static_cast<std::size_t>(at)]; };
  paid[static_cast<std::size_t>(start)] = 0.0;
  front.emplace(0.0, start);
  std::int64_t taken = 0;
  while (!front.empty()) {
    const auto [so_far, here] = front.top();
    front.pop();
    if (so_far > paid[static_cast<std::size_t>(here)]) continue;
    if (ends.erase(here) > 0 && ends.empty()) break;
    if (++taken % 65536 == 0) task.throw_if_cancelled();
    const std::array<std::int64_t, 3> at = voxel_of(grid, here);
    for (std::size_t n = 0; n < steps.size(); ++n) {
      bool inside = true;
      for (std::size_t a = 0; a < 3; ++a)
        inside &= at[a] + steps[n].by[a] >= 0 && at[a] + steps[n].by[a] < grid.size[a];
      if (!inside) continue;
      const std::int64_t next = here + steps[n].offset;
      const double price = so_far + 0.5 * steps[n].length_mm * (double(cost_at(here)) + cost_at(next));
      if (price >= paid[static_cast<std::size_t>(next)]) continue;
      paid[static_cast<std::size_t>(next)] = price;
      came_by[static_cast<std::size_t>(next)] = static_cast<std::uint8_t>(n);
      front.emplace(price, next);
    }
  }
  std::vector<std::vector<Vec3>> ways;
  for (const Vec3& place : to) {
    std::vector<Vec3>& way = ways.emplace_back();
    for (std::int64_t here = voxel_at(grid, place);;
         here -= steps[came_by[static_cast<std::size_t>(here)]].offset) {
      const std::array<std::int64_t, 3> at = voxel_of(grid, here);
      way.push_back(grid.world(Vec3(double(at[0]), double(at[1]), double(at[2]))));
      if (here == start) break;
    }
    std::ranges::reverse(way);
  }
  return ways;
}

}  // namespace ostia::experiments
