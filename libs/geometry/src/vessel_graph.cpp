#include "ostia/geometry/vessel_graph.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <limits>
#include <string>

namespace ostia::geometry {
namespace {

struct Rows {
  std::vector<std::int64_t> first;
  std::vector<std::int32_t> edges;
};

/// The edges sorted by their point `end`, by counting: two arrays and no list for each point.
Rows rows_of(const VesselGraph& graph, std::int32_t GraphEdge::*end) {
  Rows rows;
  rows.first.assign(graph.points.size() + 1, 0);
  for (const GraphEdge& edge : graph.edges) ++rows.first[static_cast<std::size_t>(edge.*end) + 1];
  for (std::size_t i = 1; i < rows.first.size(); ++i) rows.first[i] += rows.first[i - 1];
  rows.edges.resize(graph.edges.size());
  // From the last edge to the first, each row filled from its end: rows stay in the order of the edges.
  std::vector<std::int64_t> last(rows.first.begin() + 1, rows.first.end());
  for (std::size_t e = graph.edges.size(); e-- > 0;)
    rows.edges[static_cast<std::size_t>(--last[static_cast<std::size_t>(graph.edges[e].*end)])] =
        static_cast<std::int32_t>(e);
  return rows;
}

void check_indices(const VesselGraph& graph) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (graph.points.size() > most || graph.edges.size() > most)
    throw InvalidInput("a network of vessels has at most 2,147,483,647 points and segments");
  const auto count = static_cast<std::int64_t>(graph.points.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    for (const std::int32_t point : {graph.edges[e].from, graph.edges[e].to})
      if (point < 0 || point >= count)
        throw InvalidInput("segment " + std::to_string(e) + " of the network names point " +
                           std::to_string(point) + ", but there are points 0 to " +
                           std::to_string(count - 1));
}

class BranchFinder {
 public:
  BranchFinder(const VesselGraph& graph, const GraphIncidence& incidence)
      : graph_(graph), incidence_(incidence), seen_(graph.edges.size(), false) {}

  std::vector<GraphBranch> all() {
    std::vector<GraphBranch> found;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e)
      if (!passes(graph_.edges[e].from)) found.push_back(walk(static_cast<std::int32_t>(e)));
    const auto open = static_cast<std::ptrdiff_t>(found.size());
    for (std::size_t e = 0; e < graph_.edges.size(); ++e)
      if (!seen_[e]) found.push_back(circle(static_cast<std::int32_t>(e)));
    const auto earlier = [](const GraphBranch& a, const GraphBranch& b) { return a.edges[0] < b.edges[0]; };
    std::sort(found.begin() + open, found.end(), earlier);
    std::inplace_merge(found.begin(), found.begin() + open, found.end(), earlier);
    return found;
  }

 private:
  bool passes(std::int32_t point) const {
    return incidence_.arriving(point).size() == 1 && incidence_.leaving(point).size() == 1;
  }
  GraphBranch walk(std::int32_t edge) {
    GraphBranch branch;
    while (!seen_[static_cast<std::size_t>(edge)]) {
      seen_[static_cast<std::size_t>(edge)] = true;
      branch.edges.push_back(edge);
      const std::int32_t next = graph_.edges[static_cast<std::size_t>(edge)].to;
      if (!passes(next)) break;
      edge = incidence_.leaving(next)[0];
    }
    branch.edges.shrink_to_fit();
    return branch;
  }
  GraphBranch circle(std::int32_t edge) {
    GraphBranch branch = walk(edge);
    const auto lower = [this](std::int32_t a, std::int32_t b) {
      return graph_.edges[static_cast<std::size_t>(a)].from < graph_.edges[static_cast<std::size_t>(b)].from;
    };
    const auto first = std::min_element(branch.edges.begin(), branch.edges.end(), lower);
    std::rotate(branch.edges.begin(), first, branch.edges.end());
    return branch;
  }

  const VesselGraph& graph_;
  const GraphIncidence& incidence_;
  std::vector<bool> seen_;
};

std::span<const std::int32_t> row(const std::vector<std::int64_t>& first,
                                  const std::vector<std::int32_t>& edges, std::int32_t point) {
  const auto at = static_cast<std::size_t>(point);
  return {edges.data() + first[at], static_cast<std::size_t>(first[at + 1] - first[at])};
}

}  // namespace

GraphIncidence::GraphIncidence(const VesselGraph& graph) {
  check_indices(graph);
  Rows leaving = rows_of(graph, &GraphEdge::from);
  first_leaving_ = std::move(leaving.first);
  leaving_ = std::move(leaving.edges);
  Rows arriving = rows_of(graph, &GraphEdge::to);
  first_arriving_ = std::move(arriving.first);
  arriving_ = std::move(arriving.edges);
}

std::span<const std::int32_t> GraphIncidence::leaving(std::int32_t point) const {
  return row(first_leaving_, leaving_, point);
}

std::span<const std::int32_t> GraphIncidence::arriving(std::int32_t point) const {
  return row(first_arriving_, arriving_, point);
}

std::vector<GraphBranch> branches(const VesselGraph& graph, const GraphIncidence& incidence) {
  return BranchFinder(graph, incidence).all();
}

}  // namespace ostia::geometry
