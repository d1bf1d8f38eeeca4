#include "growth/joint_rule.h"

#include <algorithm>

namespace ostia::analysis {

using geometry::GraphEdge;

double JointRule::length(std::int32_t edge) const {
  return (graph_.points[static_cast<std::size_t>(edge_at(edge).to)] -
          graph_.points[static_cast<std::size_t>(edge_at(edge).from)])
      .norm();
}

bool JointRule::share_a_point(std::int32_t a, std::int32_t b) const {
  const GraphEdge &e = edge_at(a), &f = edge_at(b);
  return e.from == f.from || e.from == f.to || e.to == f.from || e.to == f.to;
}

/// From a place on a segment: its distal end, then its proximal one and what lies before it, as far as
/// `reach`.
std::vector<JointRule::Station> JointRule::way_up(std::int32_t edge, double at, double reach) const {
  const double own = length(edge);
  std::vector<Station> stations{{edge_at(edge).to, (1.0 - at) * own}};
  double way = at * own;
  std::int32_t point = edge_at(edge).from;
  for (int steps = 0; way <= reach && steps < 100'000; ++steps) {
    stations.push_back({point, way});
    const std::int32_t before = arriving_[static_cast<std::size_t>(point)];
    if (before < 0) break;
    way += length(before);
    point = edge_at(before).from;
  }
  return stations;
}

bool JointRule::covers(std::int32_t a, std::int32_t b, const ConeContact& hit) const {
  if (share_a_point(a, b)) return true;
  const GraphEdge &e = edge_at(a), &f = edge_at(b);
  const double radii = std::max(e.radius_from, e.radius_to) + std::max(f.radius_from, f.radius_to);
  const double reach = std::max(options_.bend_reach, options_.fork_reach) * radii;
  std::vector<Station> up_a = way_up(a, hit.s, reach);
  const std::vector<Station> up_b = way_up(b, hit.t, reach);
  std::stable_sort(up_a.begin(), up_a.end(),
                   [](const Station& x, const Station& y) { return x.point < y.point; });
  for (const Station& station : up_b) {
    const auto same = std::lower_bound(up_a.begin(), up_a.end(), station.point,
                                       [](const Station& x, std::int32_t point) { return x.point < point; });
    if (same == up_a.end() || same->point != station.point) continue;
    const bool straight = station.point == e.to || station.point == f.to;
    return same->way + station.way <= (straight ? options_.bend_reach : options_.fork_reach) * radii;
  }
  return false;
}

}  // namespace ostia::analysis
