#include "graph_radii.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::geometry {
namespace {

bool known(double radius) {
  return std::isfinite(radius) && radius > 0.0;
}

bool lacking(const GraphEdge& edge) {
  return !known(edge.radius_from) || !known(edge.radius_to);
}

/// The radius of an edge's one end.
struct Found {
  std::int32_t edge = 0;
  bool at_to = false;
  double radius = 0.0;
};

class RadiusFiller {
 public:
  explicit RadiusFiller(VesselGraph& graph)
      : graph_(graph), incidence_(graph), sum_(graph.points.size(), 0.0), count_(graph.points.size(), 0) {}

  std::size_t run(const core::TaskContext& task) {
    std::vector<std::int32_t> open;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const GraphEdge& edge = graph_.edges[e];
      if (known(edge.radius_from)) add(edge.from, edge.radius_from);
      if (known(edge.radius_to)) add(edge.to, edge.radius_to);
      if (lacking(edge)) open.push_back(static_cast<std::int32_t>(e));
    }
    std::size_t whole = 0;
    while (!open.empty()) {
      task.throw_if_cancelled();
      const std::vector<Found> found = round(open);
      open = apply(found);
      whole += std::exchange(whole_, 0);
    }
    return whole;
  }

 private:
  void add(std::int32_t point, double radius) {
    sum_[static_cast<std::size_t>(point)] += radius;
    ++count_[static_cast<std::size_t>(point)];
  }

  /// What this round finds counts from the next one on: the order of the segments does not matter.
  std::vector<Found> round(const std::vector<std::int32_t>& open) const {
    std::vector<Found> found;
    for (const std::int32_t e : open) {
      const GraphEdge& edge = graph_.edges[static_cast<std::size_t>(e)];
      for (const bool at_to : {false, true}) {
        if (known(at_to ? edge.radius_to : edge.radius_from)) continue;
        const auto point = static_cast<std::size_t>(at_to ? edge.to : edge.from);
        const double other = at_to ? edge.radius_from : edge.radius_to;
        if (count_[point] > 0)
          found.push_back({e, at_to, sum_[point] / count_[point]});
        else if (known(other))
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
      whole_ += !lacking(edge);
      const std::int32_t point = f.at_to ? edge.to : edge.from;
      if (count_[static_cast<std::size_t>(point)] == 0) fresh.push_back(point);
      add(point, f.radius);
    }
    std::vector<std::int32_t> next;
    const auto take = [&](std::int32_t e) {
      if (lacking(graph_.edges[static_cast<std::size_t>(e)])) next.push_back(e);
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
  std::vector<double> sum_;          // of the radii known at each point
  std::vector<std::int32_t> count_;  // how many they are
  std::size_t whole_ = 0;            // segments that the last round completed
};

}  // namespace

std::size_t fill_radii(VesselGraph& graph, const core::TaskContext& task) {
  return std::any_of(graph.edges.begin(), graph.edges.end(), lacking) ? RadiusFiller(graph).run(task) : 0;
}

}  // namespace ostia::geometry
