#include "ostia/analysis/graph_measures.h"

#include "network/graph_edges.h"

#include "ostia/core/error.h"

#include <cmath>
#include <numbers>

namespace ostia::analysis {
namespace {

using geometry::GraphEdge;
using geometry::VesselGraph;

void add(SubtreeTotals& to, const SubtreeTotals& more) {
  to.length_mm += more.length_mm;
  to.area_mm2 += more.area_mm2;
  to.volume_mm3 += more.volume_mm3;
  to.segments += more.segments;
  to.ends += more.ends;
}

BranchMeasure measure_branch(const VesselGraph& graph, const geometry::GraphBranch& branch) {
  BranchMeasure result;
  double weighted = 0.0, plain = 0.0;
  for (const std::int32_t e : branch.edges) {
    const ConeMeasure cone = measure_segment(graph, e);
    const double diameter = edge_at(graph, e).radius_from + edge_at(graph, e).radius_to;
    result.sum.length_mm += cone.length_mm;
    result.sum.area_mm2 += cone.area_mm2;
    result.sum.volume_mm3 += cone.volume_mm3;
    weighted += diameter * cone.length_mm;
    plain += diameter;
  }
  const GraphEdge& first = edge_at(graph, branch.edges.front());
  const GraphEdge& last = edge_at(graph, branch.edges.back());
  result.chord_mm =
      (graph.points[static_cast<std::size_t>(last.to)] - graph.points[static_cast<std::size_t>(first.from)])
          .norm();
  result.diameter_mm = result.sum.length_mm > 0.0 ? weighted / result.sum.length_mm
                                                  : plain / static_cast<double>(branch.edges.size());
  result.radius_from_mm = first.radius_from;
  result.radius_to_mm = last.radius_to;
  return result;
}

}  // namespace

ConeMeasure measure_cone(double length_mm, double radius_from_mm, double radius_to_mm) {
  constexpr double pi = std::numbers::pi;
  const double a = radius_from_mm, b = radius_to_mm;
  return {length_mm, pi * (a + b) * std::hypot(length_mm, a - b),
          pi * length_mm * (a * a + a * b + b * b) / 3.0};
}

ConeMeasure measure_segment(const VesselGraph& graph, std::int32_t edge) {
  const GraphEdge& e = edge_at(graph, edge);
  const double length =
      (graph.points[static_cast<std::size_t>(e.to)] - graph.points[static_cast<std::size_t>(e.from)]).norm();
  return measure_cone(length, e.radius_from, e.radius_to);
}

std::vector<SubtreeTotals> subtree_totals(const VesselGraph& graph, const TreeLinks& links) {
  std::vector<SubtreeTotals> totals(graph.edges.size());
  // From the ends inwards: all children of an edge stand behind it.
  for (std::size_t k = links.outward.size(); k-- > 0;) {
    const std::int32_t e = links.outward[k];
    SubtreeTotals& own = totals[static_cast<std::size_t>(e)];
    const ConeMeasure cone = measure_segment(graph, e);
    add(own, {cone.length_mm, cone.area_mm2, cone.volume_mm3, 1, own.segments == 0 ? 1 : 0});
    const std::int32_t parent = links.parent[static_cast<std::size_t>(e)];
    if (parent >= 0) add(totals[static_cast<std::size_t>(parent)], own);
  }
  return totals;
}

std::vector<BranchMeasure> measure_branches(const VesselGraph& graph, const TreeLinks& links) {
  std::vector<BranchMeasure> result;
  result.reserve(links.branches.size());
  for (const geometry::GraphBranch& branch : links.branches) result.push_back(measure_branch(graph, branch));
  return result;
}

TreeDistances::TreeDistances(const VesselGraph& graph, const TreeLinks& links)
    : from_root_(graph.points.size(), 0.0), before_(graph.points.size(), -1), level_(graph.points.size(), 0) {
  for (const std::int32_t e : links.outward) {
    const auto from = static_cast<std::size_t>(edge_at(graph, e).from);
    const auto to = static_cast<std::size_t>(edge_at(graph, e).to);
    from_root_[to] = from_root_[from] + measure_segment(graph, e).length_mm;
    before_[to] = static_cast<std::int32_t>(from);
    level_[to] = level_[from] + 1;
  }
}

std::optional<double> TreeDistances::between_mm(std::int32_t a, std::int32_t b) const {
  const auto count = static_cast<std::int64_t>(before_.size());
  for (const std::int32_t point : {a, b})
    if (point < 0 || point >= count)
      throw InvalidInput("distance along the tree: there is no point " + std::to_string(point) +
                         "; there are points 0 to " + std::to_string(count - 1));
  const double sum = from_root_mm(a) + from_root_mm(b);
  const auto level = [this](std::int32_t p) { return level_[static_cast<std::size_t>(p)]; };
  while (a != b) {
    std::int32_t& deeper = level(a) >= level(b) ? a : b;
    deeper = before_[static_cast<std::size_t>(deeper)];
    if (deeper < 0) return std::nullopt;
  }
  return sum - 2.0 * from_root_mm(a);
}

}  // namespace ostia::analysis
