#include "graph_checks.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace ostia::geometry {
namespace {

bool lower(const Vec3& a, const Vec3& b) {
  return std::make_tuple(a.x(), a.y(), a.z()) < std::make_tuple(b.x(), b.y(), b.z());
}

}  // namespace

void check_size(const VesselGraph& graph) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (graph.points.size() > most || graph.edges.size() > most)
    throw InvalidInput("a network of vessels has at most 2,147,483,647 points and segments");
}

std::vector<bool> finite_points(const VesselGraph& graph) {
  std::vector<bool> finite(graph.points.size());
  for (std::size_t i = 0; i < finite.size(); ++i) finite[i] = graph.points[i].allFinite();
  return finite;
}

std::vector<std::int32_t> first_at_its_place(const std::vector<Vec3>& points,
                                             const std::vector<bool>& finite) {
  std::vector<std::int32_t> first(points.size());
  std::iota(first.begin(), first.end(), 0);
  std::vector<std::int32_t> order;
  order.reserve(points.size());
  for (const std::int32_t i : first)
    if (finite[static_cast<std::size_t>(i)]) order.push_back(i);
  const auto at = [&](std::int32_t i) -> const Vec3& { return points[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    if (lower(at(a), at(b))) return true;
    return !lower(at(b), at(a)) && a < b;
  });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (at(order[i]) == at(order[i - 1]))
      first[static_cast<std::size_t>(order[i])] = first[static_cast<std::size_t>(order[i - 1])];
  return first;
}

std::vector<std::int32_t> first_between_its_points(const VesselGraph& graph) {
  std::vector<std::int32_t> order;
  order.reserve(graph.edges.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (within(graph, graph.edges[e]) && graph.edges[e].from != graph.edges[e].to)
      order.push_back(static_cast<std::int32_t>(e));
  const auto ends = [&](std::int32_t e) {
    const GraphEdge& edge = graph.edges[static_cast<std::size_t>(e)];
    return std::minmax({edge.from, edge.to});
  };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return std::make_pair(ends(a), a) < std::make_pair(ends(b), b);
  });
  std::vector<std::int32_t> first(graph.edges.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (ends(order[i]) == ends(order[i - 1]))
      first[static_cast<std::size_t>(order[i])] = first[static_cast<std::size_t>(order[i - 1])];
  return first;
}

Degrees degrees_of(const VesselGraph& graph) {
  Degrees degrees{std::vector<std::int32_t>(graph.points.size(), 0),
                  std::vector<std::int32_t>(graph.points.size(), 0)};
  for (const GraphEdge& edge : graph.edges) {
    if (!within(graph, edge)) continue;
    ++degrees.leaving[static_cast<std::size_t>(edge.from)];
    ++degrees.arriving[static_cast<std::size_t>(edge.to)];
  }
  return degrees;
}

}  // namespace ostia::geometry
