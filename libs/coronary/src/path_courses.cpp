#include "path_courses.h"

#include <algorithm>
#include <cmath>

namespace ostia::coronary {

double sure(double over, double softness) {
  return 1.0 / (1.0 + std::exp(-over / softness));
}

double sweep_deg(const TreePath& path, double from_mm, double sign) {
  const std::size_t first = path.index(from_mm);
  double most = 0.0;
  for (std::size_t i = first; i < path.at.size() && path.at[i].depth_mm < groove_depth; ++i)
    most = std::max(most, sign * (path.at[i].angle_deg - path.at[first].angle_deg));
  return most;
}

HeartPlace way_to_apex(const TreePath& path) {
  constexpr double from = 0.5, to = 0.85;  // of the depth
  const auto deepest = std::max_element(path.at.begin(), path.at.end(),
                                        [](const auto& a, const auto& b) { return a.depth_mm < b.depth_mm; });
  HeartPlace way = path.ending(10.0);
  double angle = 0.0, count = 0.0;
  for (auto at = path.at.begin(); at != deepest; ++at) {
    if (at->depth_mm < from * deepest->depth_mm || at->depth_mm > to * deepest->depth_mm) continue;
    angle += at->angle_deg;
    count += 1.0;
  }
  if (count < 1.0 || deepest->depth_mm < least_lad_depth) return way;
  way.depth_mm = std::max(way.depth_mm, deepest->depth_mm);
  way.angle_deg = angle / count;
  return way;
}

}  // namespace ostia::coronary
