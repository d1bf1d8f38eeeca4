#include "graph_editor.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace ostia::centerline {
namespace {

using detail::GraphEditor;
using Distances = std::map<std::int32_t, double>;  // by node

// Lengths of the shortest ways along the lines, from what is there already (Dijkstra).
void spread(const GraphEditor& editor, const std::vector<std::int32_t>& sources, Distances& distance) {
  std::set<std::pair<double, std::int32_t>> open;
  for (const std::int32_t n : sources) {
    distance[n] = 0.0;
    open.insert({0.0, n});
  }
  while (!open.empty()) {
    const auto [d, n] = *open.begin();
    open.erase(open.begin());
    if (d > distance.at(n)) continue;
    for (const std::int32_t id : editor.edges_at(n)) {
      const SkeletonEdge& e = editor.edges().at(id);
      const std::int32_t other = e.from == n ? e.to : e.from;
      const double there = d + length_mm(e);
      const auto known = distance.find(other);
      if (known != distance.end() && known->second <= there) continue;
      distance[other] = there;
      open.insert({there, other});
    }
  }
}

std::int32_t inlet_at(GraphEditor& editor, const Vec3& place, double snap_mm) {
  if (!place.allFinite()) throw InvalidInput("orientation: an inlet's place is not finite");
  const detail::GraphPlace end = editor.closest_end(place);
  if (end.distance_mm <= snap_mm) return end.id;
  const detail::GraphPlace near = editor.closest(place, 0.0);
  if (near.id < 0 || !(near.distance_mm <= snap_mm))
    throw InvalidInput("orientation: the inlet " + detail::text(place) + " lies " +
                       std::to_string(near.distance_mm) + " mm off the skeleton, more than " +
                       std::to_string(snap_mm) + " mm: give a place on a line, or raise snap_mm");
  return near.at_node ? near.id : editor.split(near);
}

// The widest end of each component that no distance reaches; its widest node where it has no end.
std::vector<std::int32_t> guess_inlets(const GraphEditor& editor, Distances& distance) {
  std::vector<std::int32_t> guessed;
  for (const auto& [seed, unused] : editor.nodes()) {
    if (distance.count(seed) != 0) continue;
    Distances component;
    spread(editor, {seed}, component);
    std::int32_t best = seed;
    const auto rank = [&](std::int32_t n) {
      return std::make_pair(editor.degree(n) == 1, editor.nodes().at(n).radius_mm);
    };
    for (const auto& [n, d] : component)
      if (rank(best) < rank(n)) best = n;
    guessed.push_back(best);
    spread(editor, {best}, distance);
  }
  return guessed;
}

}  // namespace

void validate(const OrientOptions& o) {
  detail::require(o.snap_mm > 0.0 && o.snap_mm <= 1000.0, "orientation", "snap_mm", o.snap_mm,
                  "(0, 1000] mm");
}

OrientedSkeleton oriented(const SkeletonGraph& graph, const std::vector<Vec3>& inlets,
                          const OrientOptions& options) {
  validate(options);
  detail::require_sound(graph, "orientation");
  if (graph.edges.empty()) throw InvalidInput("orientation: the skeleton has no lines");
  GraphEditor editor(graph);
  OrientedSkeleton result;
  for (const Vec3& place : inlets) result.inlets.push_back(inlet_at(editor, place, options.snap_mm));
  Distances distance;
  spread(editor, result.inlets, distance);
  if (options.guess) result.guessed = guess_inlets(editor, distance);
  std::vector<std::int32_t> against;
  for (const auto& [id, e] : editor.edges()) {
    if (e.from == e.to || distance.count(e.from) == 0) continue;
    if (std::make_pair(distance.at(e.to), e.to) < std::make_pair(distance.at(e.from), e.from))
      against.push_back(id);
  }
  for (const std::int32_t id : against) editor.reverse(id);
  result.graph = editor.graph();
  result.graph.oriented = true;
  return result;
}

}  // namespace ostia::centerline
