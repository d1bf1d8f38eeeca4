#include "line_points.h"

#include <algorithm>

namespace ostia::centerline::detail {
namespace {

using geometry::Box3;
using geometry::Vec3;

constexpr std::size_t points_a_run = 16, runs_a_group = 16;

double squared_gap(const Box3& box, const Vec3& p) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0.0).squaredNorm();
}

/// The box of each next `count`.
template <class Item>
std::vector<Box3> boxes_of(const std::vector<Item>& items, std::size_t count) {
  std::vector<Box3> boxes((items.size() + count - 1) / count);
  for (std::size_t i = 0; i < items.size(); ++i) boxes[i / count].extend(items[i]);
  return boxes;
}

}  // namespace

LinePoints::LinePoints(const std::vector<Vec3>& points)
    : points_(points), runs_(boxes_of(points, points_a_run)), groups_(boxes_of(runs_, runs_a_group)) {}

void LinePoints::search_run(std::size_t run, const Vec3& query, Nearest& best) const {
  const std::size_t last = std::min((run + 1) * points_a_run, points_.size());
  for (std::size_t i = run * points_a_run; i < last; ++i) {
    const double squared = (points_[i] - query).squaredNorm();
    const auto point = static_cast<std::int32_t>(i);
    if (squared < best.squared || (squared == best.squared && point < best.point)) best = {squared, point};
  }
}

std::int32_t LinePoints::nearest(const Vec3& query, double within_squared, std::size_t& run) const {
  Nearest best{within_squared};
  const std::size_t begun = std::min(run, runs_.size());
  if (begun < runs_.size()) search_run(begun, query, best);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (squared_gap(groups_[g], query) > best.squared) continue;
    const std::size_t last = std::min((g + 1) * runs_a_group, runs_.size());
    for (std::size_t r = g * runs_a_group; r < last; ++r)
      if (r != begun && squared_gap(runs_[r], query) <= best.squared) search_run(r, query, best);
  }
  if (best.point >= 0) run = static_cast<std::size_t>(best.point) / points_a_run;
  return best.point;
}

}  // namespace ostia::centerline::detail
