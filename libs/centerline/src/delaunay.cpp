#include "ostia/centerline/delaunay.h"

#include "growing_delaunay.h"
#include "hilbert_order.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace ostia::centerline {
namespace {

void require_finite(const std::vector<geometry::Vec3>& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InvalidInput("point " + std::to_string(i) + " has a coordinate that is not finite");
}

bool finite(const GrowingDelaunay::Four& cell) {
  return std::ranges::min(cell) >= 0;
}

// Cells are numbered by the lowest place of their corners along the curve: neighbours in space lie close
// together in memory.
Delaunay to_arrays(const GrowingDelaunay& grown, const std::vector<std::int32_t>& along_curve) {
  const std::vector<GrowingDelaunay::Four>& corners = grown.corners();
  std::vector<std::int32_t> rank(along_curve.size()), next(along_curve.size() + 1, 0);
  for (std::size_t i = 0; i < along_curve.size(); ++i)
    rank[static_cast<std::size_t>(along_curve[i])] = static_cast<std::int32_t>(i);
  std::vector<std::int32_t> number(corners.size(), -1);  // the lowest rank, then the number
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (!finite(corners[c])) continue;
    const auto rank_of = [&](std::size_t k) { return rank[static_cast<std::size_t>(corners[c][k])]; };
    number[c] = std::min({rank_of(0), rank_of(1), rank_of(2), rank_of(3)});
    ++next[static_cast<std::size_t>(number[c]) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::int32_t& n : number)
    if (n >= 0) n = next[static_cast<std::size_t>(n)]++;
  Delaunay result;
  result.cells.resize(static_cast<std::size_t>(next.back()));
  result.neighbours.resize(result.cells.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (number[c] < 0) continue;
    const auto place = static_cast<std::size_t>(number[c]);
    result.cells[place] = corners[c];
    for (std::size_t i = 0; i < 4; ++i)
      result.neighbours[place][i] = number[static_cast<std::size_t>(grown.neighbour(c, i))];
  }
  return result;
}

}  // namespace

Delaunay delaunay(const std::vector<geometry::Vec3>& points, const core::TaskContext& task) {
  require_finite(points);
  const std::vector<std::int32_t> along_curve = along_hilbert_curve(points);
  std::vector<std::int32_t> order = in_rounds(along_curve);
  task.throw_if_cancelled();
  GrowingDelaunay grown(points);
  if (!grown.begin(order))
    throw GeometryError("the " + std::to_string(points.size()) +
                        " points of the surface do not span a volume: give a surface that encloses a lumen");
  std::size_t dropped = 0;
  for (std::size_t i = 4; i < order.size(); ++i) {
    if (i % 1024 == 0) {
      task.throw_if_cancelled();
      task.set_progress(static_cast<double>(i) / static_cast<double>(order.size()));
    }
    if (!grown.insert(order[i])) ++dropped;
  }
  task.throw_if_cancelled();
  Delaunay result = to_arrays(grown, along_curve);
  result.dropped_points = dropped;
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::centerline
