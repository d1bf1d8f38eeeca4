#pragma once
/// \file Lengths that grow with bounded slope along a graph's edges.

#include "ostia/geometry/vec.h"

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace ostia::meshing {

/// Lowers values where they grow faster than `slope` along the way to a neighbour, in order of value
/// (Dijkstra 1959), so that the outcome is the largest that obeys. `neighbours(i)` is a range of points.
template <class Neighbours>
void limit_growth(const std::vector<geometry::Vec3>& points, const Neighbours& neighbours, double slope,
                  std::vector<double>& values) {
  using Item = std::pair<double, std::int32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  const auto lower_around = [&](std::size_t from, double value, const auto& lowered) {
    for (const std::int32_t v : neighbours(from)) {
      const auto to = static_cast<std::size_t>(v);
      if (values[to] <= value) continue;
      const double limit = value + slope * (points[to] - points[from]).norm();
      if (limit < values[to]) lowered(to, limit);
    }
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    bool steep = false;
    lower_around(i, values[i], [&](std::size_t, double) { steep = true; });
    if (steep) queue.emplace(values[i], static_cast<std::int32_t>(i));
  }
  while (!queue.empty()) {
    const auto [value, from] = queue.top();
    queue.pop();
    if (value > values[static_cast<std::size_t>(from)]) continue;
    lower_around(static_cast<std::size_t>(from), value, [&](std::size_t to, double limit) {
      values[to] = limit;
      queue.emplace(limit, static_cast<std::int32_t>(to));
    });
  }
}

}  // namespace ostia::meshing
