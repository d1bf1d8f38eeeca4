#include "tube_front.h"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <utility>

namespace ostia::coronary {
namespace {

struct Step {
  std::array<std::int64_t, 3> by;
  std::int64_t offset;
  float mm;
};

std::array<Step, 26> neighbours(const imaging::Geometry& grid) {
  std::array<Step, 26> steps{};
  std::size_t n = 0;
  for (std::int64_t k = -1; k <= 1; ++k)
    for (std::int64_t j = -1; j <= 1; ++j)
      for (std::int64_t i = -1; i <= 1; ++i) {
        if (i == 0 && j == 0 && k == 0) continue;
        const geometry::Vec3 by(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        steps[n++] = {{i, j, k},
                      i + grid.size[0] * (j + grid.size[1] * k),
                      static_cast<float>(grid.spacing.cwiseProduct(by).norm())};
      }
  return steps;
}

}  // namespace

FrontNodes run_tube_front(const imaging::FloatVolume& tube, const std::vector<FrontSource>& sources,
                          double least, const core::TaskContext& task) {
  constexpr std::size_t look_up_every = 4096;
  const imaging::Geometry& grid = tube.geometry;
  const std::array<Step, 26> steps = neighbours(grid);
  FrontNodes nodes;
  using Waiting = std::pair<float, std::int64_t>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue;
  for (const FrontSource& source : sources)
    if (nodes.try_emplace(source.voxel, FrontNode{.of = static_cast<std::int32_t>(source.of)}).second)
      queue.emplace(0.0F, source.voxel);
  std::size_t settled = 0;
  while (!queue.empty()) {
    const auto [cost, voxel] = queue.top();
    queue.pop();
    FrontNode& here = nodes.at(voxel);
    if (here.settled) continue;
    here.settled = true;
    if (++settled % look_up_every == 0) task.throw_if_cancelled();
    const FrontNode from = here;  // the map may move it below
    const std::array<std::int64_t, 3> at{voxel % grid.size[0], voxel / grid.size[0] % grid.size[1],
                                         voxel / (grid.size[0] * grid.size[1])};
    for (const Step& step : steps) {
      bool inside = true;
      for (std::size_t a = 0; a < 3; ++a)
        inside = inside && at[a] + step.by[a] >= 0 && at[a] + step.by[a] < grid.size[a];
      if (!inside) continue;
      const std::int64_t to = voxel + step.offset;
      const float speed = std::min(1.0F, tube.voxels[static_cast<std::size_t>(to)]);
      if (speed < static_cast<float>(least)) continue;
      const float next = from.cost + step.mm / (speed * speed);
      const auto [entry, fresh] = nodes.try_emplace(to);
      FrontNode& there = entry->second;
      if (!fresh && (there.settled || there.cost <= next)) continue;
      there = {.before = voxel, .cost = next, .length_mm = from.length_mm + step.mm, .of = from.of};
      queue.emplace(next, to);
    }
  }
  return nodes;
}

}  // namespace ostia::coronary
