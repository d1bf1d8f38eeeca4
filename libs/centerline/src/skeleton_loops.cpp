#include "graph_editor.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace ostia::centerline {
namespace {

double mean_radius(const SkeletonEdge& edge) {
  const std::vector<double> s = geometry::abscissas(edge.points);
  double sum = 0.0;
  for (std::size_t i = 1; i < s.size(); ++i)
    sum += 0.5 * (edge.radius_mm[i - 1] + edge.radius_mm[i]) * (s[i] - s[i - 1]);
  return sum / s.back();
}

/// Widest lines first; what joins nothing new closes a loop (J. B. Kruskal, Proc. Am. Math. Soc. 7:48-50,
/// 1956).
std::vector<std::int32_t> closing_lines(const SkeletonGraph& graph) {
  std::map<std::int32_t, std::int32_t> index;
  for (const SkeletonNode& n : graph.nodes) index.emplace(n.id, static_cast<std::int32_t>(index.size()));
  std::vector<std::pair<double, const SkeletonEdge*>> lines;
  for (const SkeletonEdge& e : graph.edges) lines.emplace_back(mean_radius(e), &e);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  geometry::DisjointSets parts(index.size());
  std::vector<std::int32_t> closing;
  for (const auto& [radius, line] : lines)
    if (!parts.join(index.at(line->from), index.at(line->to))) closing.push_back(line->id);
  return closing;
}

}  // namespace

SkeletonGraph loops_opened(const SkeletonGraph& graph) {
  detail::require_sound(graph, "loops");
  detail::GraphEditor editor(graph);
  std::vector<std::int32_t> touched;
  for (const std::int32_t id : closing_lines(graph)) {
    const SkeletonEdge& line = editor.edges().at(id);
    touched.insert(touched.end(), {line.from, line.to});
    editor.remove_edge(id);
  }
  // Only now: two lines that become one must both be known to stay.
  for (const std::int32_t node : touched) {
    if (editor.nodes().count(node) == 0) continue;
    if (editor.degree(node) == 0)
      editor.remove_node(node);
    else
      editor.join_at(node);
  }
  return editor.graph();
}

}  // namespace ostia::centerline
