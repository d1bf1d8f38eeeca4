#include "graph_editor.h"

#include "ostia/centerline/skeleton_edit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace ostia::centerline {
namespace {

using detail::GraphEditor;

struct End {
  std::int32_t node = 0, edge = 0;
  Vec3 position = Vec3::Zero(), outward = Vec3::Zero();
};

std::vector<End> ends_of(const GraphEditor& editor, double direction_mm) {
  std::vector<End> ends;
  for (const auto& [id, n] : editor.nodes()) {
    if (editor.degree(id) != 1) continue;
    const SkeletonEdge& e = editor.edges().at(*editor.edges_at(id).begin());
    ends.push_back({id, e.id, n.position, detail::line_end(e, e.from == id, direction_mm).outward});
  }
  return ends;
}

bool goes_on(const End& a, const End& b, const GapOptions& options) {
  const double most = std::cos(options.angle_deg * std::numbers::pi / 180.0) - 1e-12;
  if (a.outward.dot(-b.outward) < most) return false;
  const Vec3 gap = b.position - a.position;
  const double length = gap.norm();
  if (length < 0.2 * options.direction_mm) return true;
  return a.outward.dot(gap) >= most * length && -b.outward.dot(gap) >= most * length;
}

}  // namespace

void validate(const GapOptions& o) {
  detail::require(o.distance_mm >= 0.0 && o.distance_mm <= 100.0, "gaps", "distance_mm", o.distance_mm,
                  "[0, 100] mm");
  detail::require(o.angle_deg > 0.0 && o.angle_deg <= 180.0, "gaps", "angle_deg", o.angle_deg,
                  "(0, 180] degrees");
  detail::require(o.direction_mm > 0.0 && o.direction_mm <= 50.0, "gaps", "direction_mm", o.direction_mm,
                  "(0, 50] mm");
}

SkeletonGraph gaps_closed(const SkeletonGraph& graph, const GapOptions& options) {
  validate(options);
  detail::require_sound(graph, "gaps");
  GraphEditor editor(graph);
  const std::vector<End> ends = ends_of(editor, options.direction_mm);
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < ends.size(); ++a)
    for (std::size_t b = a + 1; b < ends.size(); ++b) {
      const double gap = (ends[a].position - ends[b].position).norm();
      if (gap <= options.distance_mm && goes_on(ends[a], ends[b], options)) pairs.emplace_back(gap, a, b);
    }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> used(ends.size(), false);
  for (const auto& [gap, a, b] : pairs) {
    if (used[a] || used[b]) continue;
    used[a] = used[b] = true;
    const SkeletonNode from = editor.node(ends[a].node), to = editor.node(ends[b].node);
    if (gap > 0.0) {
      editor.add_edge(from.id, to.id, {from.position, to.position}, {from.radius_mm, to.radius_mm});
    } else {
      // The same place: the one line is led to the other's node.
      const std::int32_t id = *editor.edges_at(to.id).begin();
      const SkeletonEdge line = editor.edges().at(id);
      editor.remove_edge(id);
      editor.remove_node(to.id);
      const bool at_from = line.from == to.id;
      editor.add_edge(at_from ? from.id : line.from, at_from ? line.to : from.id, line.points,
                      line.radius_mm);
    }
    for (const std::int32_t id : {from.id, to.id})
      if (editor.nodes().count(id) != 0) editor.join_at(id);
  }
  return editor.graph();
}

}  // namespace ostia::centerline
