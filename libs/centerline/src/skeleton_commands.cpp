#include "graph_editor.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace ostia::centerline {
namespace {

using detail::GraphEditor;
using detail::GraphPlace;

GraphPlace place_on(const GraphEditor& editor, const Vec3& place, const PlaceOptions& options,
                    const std::string& command) {
  if (!place.allFinite()) throw InvalidInput(command + ": a place is not finite");
  const GraphPlace found = editor.closest(place, options.snap_mm);
  if (found.id < 0) throw InvalidInput(command + ": the skeleton is empty");
  if (found.distance_mm > options.reach_mm)
    throw InvalidInput(command + ": " + detail::text(place) + " lies " + std::to_string(found.distance_mm) +
                       " mm off the skeleton, more than " + std::to_string(options.reach_mm) +
                       " mm: give a place nearer to a line");
  return found;
}

}  // namespace

void validate(const PlaceOptions& o) {
  detail::require(o.snap_mm >= 0.0 && o.snap_mm <= 100.0, "skeleton", "snap_mm", o.snap_mm, "[0, 100] mm");
  detail::require(o.reach_mm > 0.0 && o.reach_mm <= 1000.0, "skeleton", "reach_mm", o.reach_mm,
                  "(0, 1000] mm");
}

SkeletonGraph connected(const SkeletonGraph& graph, const Vec3& from, const Vec3& to,
                        const PlaceOptions& options) {
  validate(options);
  detail::require_sound(graph, "connect");
  GraphEditor editor(graph);
  const auto node_at = [&](const Vec3& place) {
    const GraphPlace found = place_on(editor, place, options, "connect");
    return found.at_node ? found.id : editor.split(found);
  };
  const std::int32_t a = node_at(from), b = node_at(to);
  const SkeletonNode first = editor.node(a), last = editor.node(b);
  if (a == b || (first.position - last.position).norm() <= 1e-6)
    throw InvalidInput("connect: both places are the same one of the skeleton, " +
                       detail::text(first.position) + ": give two that are further apart than " +
                       std::to_string(options.snap_mm) + " mm");
  std::vector<Vec3> points = detail::straight_way(first.position, last.position);
  std::vector<double> radius_mm;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    radius_mm.push_back((1.0 - t) * first.radius_mm + t * last.radius_mm);
  }
  editor.add_edge(a, b, std::move(points), std::move(radius_mm));
  for (const std::int32_t n : {a, b}) editor.join_at(n);
  return editor.graph();
}

SkeletonGraph cut(const SkeletonGraph& graph, const Vec3& place, const PlaceOptions& options) {
  validate(options);
  detail::require_sound(graph, "cut");
  GraphEditor editor(graph);
  const GraphPlace found = place_on(editor, place, options, "cut");
  if (found.at_node && editor.degree(found.id) != 2)
    throw InvalidInput("cut: node " + std::to_string(found.id) + " at " + detail::text(found.point) + " is " +
                       std::to_string(found.distance_mm) +
                       " mm from the place: cut a line away from its nodes, or remove the edge");
  const std::int32_t at = found.at_node ? found.id : editor.split(found);
  const std::int32_t edge = *editor.edges_at(at).rbegin();
  editor.detach(edge, editor.edges().at(edge).from == at);
  return editor.graph();
}

SkeletonGraph removed(const SkeletonGraph& graph, std::int32_t edge_id) {
  detail::require_sound(graph, "remove");
  const SkeletonEdge gone = edge(graph, edge_id);
  GraphEditor editor(graph);
  editor.remove_edge(edge_id);
  for (const std::int32_t n : {gone.from, gone.to}) {
    if (editor.nodes().count(n) == 0) continue;
    if (editor.degree(n) == 0)
      editor.remove_node(n);
    else
      editor.join_at(n);
  }
  return editor.graph();
}

std::int32_t edge_at(const SkeletonGraph& graph, const Vec3& place, const PlaceOptions& options) {
  validate(options);
  detail::require_sound(graph, "remove");
  PlaceOptions lines = options;
  lines.snap_mm = 0.0;  // a line, not its node
  const GraphPlace found = place_on(GraphEditor(graph), place, lines, "remove");
  if (!found.at_node) return found.id;
  for (const SkeletonEdge& e : graph.edges)
    if (e.from == found.id || e.to == found.id) return e.id;
  throw InvalidInput("remove: no line is at " + detail::text(place));
}

}  // namespace ostia::centerline
