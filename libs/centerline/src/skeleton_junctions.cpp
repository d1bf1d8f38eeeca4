#include "graph_editor.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/geometry/polyline.h"

#include <Eigen/Dense>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace ostia::centerline {
namespace {

using detail::GraphEditor;

// Weight of the old place beside each line's: lines that are nearly parallel say little of where they meet.
constexpr double old_place = 0.02;
constexpr double most_of_line = 1.0 / 3.0;
constexpr double nearly_half = 0.45;

double trimmed_at(const SkeletonEdge& line, double radius_mm, const JunctionOptions& options) {
  return std::min(options.trimmed_radii * radius_mm, most_of_line * length_mm(line));
}

// The part of a line from abscissa `from` to `to`.
SkeletonEdge part_of(const SkeletonEdge& line, double from, double to) {
  const std::vector<double> s = geometry::abscissas(line.points);
  SkeletonEdge part = line;
  part.points.clear();
  part.radius_mm.clear();
  const auto add = [&](double at) {
    const geometry::PolylineLocation place = geometry::at_abscissa(line.points, at);
    part.points.push_back(place.point);
    part.radius_mm.push_back((1.0 - place.t) * line.radius_mm[place.segment] +
                             place.t * line.radius_mm[place.segment + 1]);
  };
  add(from);
  for (std::size_t i = 0; i < s.size(); ++i)
    if (s[i] > from && s[i] < to) {
      part.points.push_back(line.points[i]);
      part.radius_mm.push_back(line.radius_mm[i]);
    }
  add(to);
  return part;
}

// Nearest to straight lines by least squares.
class Meeting {
 public:
  explicit Meeting(const Vec3& old)
      : normal_(old_place * geometry::Mat3::Identity()), right_(old_place * old) {}
  void add(const detail::LineEnd& end, double weight) {
    if (end.outward.isZero()) return;
    const geometry::Mat3 across =
        weight * (geometry::Mat3::Identity() - end.outward * end.outward.transpose());
    normal_ += across;
    right_ += across * end.point;
  }
  Vec3 place() const { return normal_.ldlt().solve(right_); }

 private:
  geometry::Mat3 normal_;
  Vec3 right_;
};

Vec3 meeting_place(const GraphEditor& editor, const SkeletonNode& node, const JunctionOptions& options) {
  Meeting meeting(node.position);
  // Two junctions never come to lie in one place.
  double most = options.most_radii * node.radius_mm;
  const auto& around = editor.edges_at(node.id);
  for (const std::int32_t id : std::set<std::int32_t>(around.begin(), around.end())) {
    const SkeletonEdge& line = editor.edges().at(id);
    const double whole = length_mm(line), cut = trimmed_at(line, node.radius_mm, options);
    const double reach = std::min(options.direction_mm, whole - 2.0 * cut);
    if (line.from != line.to) most = std::min(most, nearly_half * whole);
    for (const bool at_first : {true, false})
      if ((at_first ? line.from : line.to) == node.id)
        meeting.add(detail::line_end(at_first ? part_of(line, cut, whole) : part_of(line, 0.0, whole - cut),
                                     at_first, reach),
                    reach / options.direction_mm);
  }
  const Vec3 moved = meeting.place() - node.position;
  return node.position + (moved.norm() > most ? Vec3(moved * (most / moved.norm())) : moved);
}

// A straight way from a place to the line's first point, with the radius there.
void lead_from(const Vec3& place, SkeletonEdge& line) {
  std::vector<Vec3> way = detail::straight_way(place, line.points.front());
  way.pop_back();
  line.points.insert(line.points.begin(), way.begin(), way.end());
  line.radius_mm.insert(line.radius_mm.begin(), way.size(), line.radius_mm.front());
}

// The line with straight ways from where its own course begins and ends to its junctions.
void lead_to_junctions(GraphEditor& editor, std::int32_t id, const std::map<std::int32_t, Vec3>& moved,
                       const JunctionOptions& options) {
  const SkeletonEdge line = editor.edges().at(id);
  const auto from = moved.find(line.from), to = moved.find(line.to);
  if (from == moved.end() && to == moved.end()) return;
  const auto cut = [&](const auto& end, std::int32_t node) {
    return end == moved.end() ? 0.0 : trimmed_at(line, editor.nodes().at(node).radius_mm, options);
  };
  SkeletonEdge kept = part_of(line, cut(from, line.from), length_mm(line) - cut(to, line.to));
  if (from != moved.end()) lead_from(from->second, kept);
  if (to != moved.end()) {
    std::reverse(kept.points.begin(), kept.points.end());
    std::reverse(kept.radius_mm.begin(), kept.radius_mm.end());
    lead_from(to->second, kept);
    std::reverse(kept.points.begin(), kept.points.end());
    std::reverse(kept.radius_mm.begin(), kept.radius_mm.end());
  }
  editor.replace_line(id, std::move(kept.points), std::move(kept.radius_mm));
}

}  // namespace

void validate(const JunctionOptions& o) {
  const char* what = "skeleton junctions";
  detail::require(o.trimmed_radii >= 0.0 && o.trimmed_radii <= 5.0, what, "trimmed_radii", o.trimmed_radii,
                  "[0, 5]");
  detail::require(o.direction_mm > 0.0 && o.direction_mm <= 50.0, what, "direction_mm", o.direction_mm,
                  "(0, 50] mm");
  detail::require(o.most_radii >= 0.0 && o.most_radii <= 10.0, what, "most_radii", o.most_radii, "[0, 10]");
}

SkeletonGraph junctions_settled(const SkeletonGraph& graph, const JunctionOptions& options) {
  validate(options);
  detail::require_sound(graph, "skeleton junctions");
  GraphEditor editor(graph);
  std::map<std::int32_t, Vec3> moved;
  for (const SkeletonNode& n : graph.nodes)
    if (editor.degree(n.id) >= 3) moved[n.id] = meeting_place(editor, n, options);
  for (const SkeletonEdge& e : graph.edges) lead_to_junctions(editor, e.id, moved, options);
  for (const auto& [id, place] : moved) editor.node(id).position = place;
  SkeletonGraph result = editor.graph();
  result.oriented = graph.oriented;
  return result;
}

}  // namespace ostia::centerline
