#include "graph_radii.h"

#include <algorithm>
#include <cmath>

namespace ostia::geometry {
namespace {

/// The radius of an edge's one end.
struct Found {
  std::int32_t edge = 0;
  bool at_to = false;
  double radius = 0.0;
};

class RadiusFiller {
 public:
  explicit RadiusFiller(VesselGraph& graph) : graph_(graph), incidence_(graph), at_(graph.points.size()) {}

  void run(const PointRadii& spare, const core::TaskContext& task) {
    std::vector<std::int32_t> open;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const GraphEdge& edge = graph_.edges[e];
      at_.add(edge.from, edge.radius_from);
      at_.add(edge.to, edge.radius_to);
      if (lacks_radius(edge)) open.push_back(static_cast<std::int32_t>(e));
    }
    for (std::size_t i = 0; i < at_.count.size(); ++i) {
      if (at_.count[i] > 0) continue;
      at_.sum[i] = spare.sum[i];
      at_.count[i] = spare.count[i];
    }
    while (!open.empty()) {
      task.throw_if_cancelled();
      open = apply(round(open));
    }
  }

 private:
  /// What this round finds counts from the next one on: the order of the segments does not matter.
  std::vector<Found> round(const std::vector<std::int32_t>& open) const {
    std::vector<Found> found;
    for (const std::int32_t e : open) {
      const GraphEdge& edge = graph_.edges[static_cast<std::size_t>(e)];
      for (const bool at_to : {false, true}) {
        if (known_radius(at_to ? edge.radius_to : edge.radius_from)) continue;
        const auto point = static_cast<std::size_t>(at_to ? edge.to : edge.from);
        const double other = at_to ? edge.radius_from : edge.radius_to;
        if (at_.count[point] > 0)
          found.push_back({e, at_to, at_.sum[point] / at_.count[point]});
        else if (known_radius(other))
          found.push_back({e, at_to, other});
      }
    }
    return found;
  }

  /// The segments that the next round can do something about.
  std::vector<std::int32_t> apply(const std::vector<Found>& found) {
    std::vector<std::int32_t> fresh;  // points where nothing was known before
    for (const Found& f : found) {
      GraphEdge& edge = graph_.edges[static_cast<std::size_t>(f.edge)];
      (f.at_to ? edge.radius_to : edge.radius_from) = f.radius;
      const std::int32_t point = f.at_to ? edge.to : edge.from;
      if (at_.count[static_cast<std::size_t>(point)] == 0) fresh.push_back(point);
      at_.add(point, f.radius);
    }
    std::vector<std::int32_t> next;
    const auto take = [&](std::int32_t e) {
      if (lacks_radius(graph_.edges[static_cast<std::size_t>(e)])) next.push_back(e);
    };
    for (const Found& f : found) take(f.edge);
    for (const std::int32_t point : fresh) {
      for (const std::int32_t e : incidence_.leaving(point)) take(e);
      for (const std::int32_t e : incidence_.arriving(point)) take(e);
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    return next;
  }

  VesselGraph& graph_;
  const GraphIncidence incidence_;
  PointRadii at_;
};

}  // namespace

bool known_radius(double radius) {
  return std::isfinite(radius) && radius > 0.0;
}

bool lacks_radius(const GraphEdge& edge) {
  return !known_radius(edge.radius_from) || !known_radius(edge.radius_to);
}

void fill_radii(VesselGraph& graph, const PointRadii& spare, const core::TaskContext& task) {
  if (std::any_of(graph.edges.begin(), graph.edges.end(), lacks_radius)) RadiusFiller(graph).run(spare, task);
}

}  // namespace ostia::geometry
