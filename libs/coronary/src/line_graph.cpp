#include "line_graph.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::coronary {
namespace {

constexpr double same_place_mm = 1e-9;

/// Points that stand still are left out; both ends stay where they are.
void without_standstill(LineGraph::Line& line) {
  std::vector<Vec3> points{line.points.front()};
  std::vector<double> radius{line.radius_mm.front()};
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    if ((line.points[i] - points.back()).norm() <= same_place_mm) {
      if (i + 1 < line.points.size() || points.size() < 2) continue;
      points.pop_back();
      radius.pop_back();
    }
    points.push_back(line.points[i]);
    radius.push_back(line.radius_mm[i]);
  }
  line.points = std::move(points);
  line.radius_mm = std::move(radius);
}

LineGraph::Line turned_round(LineGraph::Line line) {
  std::swap(line.from, line.to);
  std::reverse(line.points.begin(), line.points.end());
  std::reverse(line.radius_mm.begin(), line.radius_mm.end());
  return line;
}

}  // namespace

LineGraph::LineGraph(const centerline::SkeletonGraph& graph) {
  for (const centerline::SkeletonNode& node : graph.nodes) {
    nodes_[node.id] = {node.position, node.radius_mm};
    at_[node.id];
    next_node_ = std::max(next_node_, node.id + 1);
  }
  for (const centerline::SkeletonEdge& edge : graph.edges) {
    lines_[edge.id] = {edge.from, edge.to, edge.points, edge.radius_mm};
    at_[edge.from].insert(edge.id);
    at_[edge.to].insert(edge.id);
    next_line_ = std::max(next_line_, edge.id + 1);
  }
}

std::int32_t LineGraph::other_end(std::int32_t line, std::int32_t node) const {
  const Line& l = lines_.at(line);
  return l.from == node ? l.to : l.from;
}

std::int32_t LineGraph::add_node(const Node& node) {
  const std::int32_t id = next_node_++;
  nodes_[id] = node;
  at_[id];
  return id;
}

std::int32_t LineGraph::add_line(std::int32_t from, std::int32_t to, std::vector<Vec3> points,
                                 std::vector<double> radius_mm) {
  const std::int32_t id = next_line_++;
  Line line{from, to, std::move(points), std::move(radius_mm)};
  without_standstill(line);
  lines_[id] = std::move(line);
  at_.at(from).insert(id);
  at_.at(to).insert(id);
  return id;
}

void LineGraph::remove_line(std::int32_t id) {
  const Line& line = lines_.at(id);
  for (const std::int32_t node : {line.from, line.to}) {
    auto& there = at_.at(node);
    there.erase(there.find(id));
  }
  lines_.erase(id);
}

std::int32_t LineGraph::split(std::int32_t id, std::size_t point) {
  const Line whole = lines_.at(id);
  const auto at = static_cast<std::ptrdiff_t>(point);
  const std::int32_t middle = add_node({whole.points[point], whole.radius_mm[point]});
  remove_line(id);
  add_line(whole.from, middle, {whole.points.begin(), whole.points.begin() + at + 1},
           {whole.radius_mm.begin(), whole.radius_mm.begin() + at + 1});
  add_line(middle, whole.to, {whole.points.begin() + at, whole.points.end()},
           {whole.radius_mm.begin() + at, whole.radius_mm.end()});
  return middle;
}

void LineGraph::cut(std::int32_t id, std::size_t point) {
  const Line whole = lines_.at(id);
  const auto at = static_cast<std::ptrdiff_t>(point);
  remove_line(id);
  // A point apart, so that no two ends share a place.
  if (point >= 2) {
    const std::int32_t end = add_node({whole.points[point - 1], whole.radius_mm[point - 1]});
    add_line(whole.from, end, {whole.points.begin(), whole.points.begin() + at},
             {whole.radius_mm.begin(), whole.radius_mm.begin() + at});
  }
  if (point + 2 < whole.points.size()) {
    const std::int32_t end = add_node({whole.points[point + 1], whole.radius_mm[point + 1]});
    add_line(end, whole.to, {whole.points.begin() + at + 1, whole.points.end()},
             {whole.radius_mm.begin() + at + 1, whole.radius_mm.end()});
  }
}

void LineGraph::tidy(const std::set<std::int32_t>& keep) {
  std::vector<std::int32_t> ids;
  for (const auto& [id, node] : nodes_) ids.push_back(id);
  for (const std::int32_t id : ids) {
    const auto& there = at_.at(id);
    if (there.empty()) {
      nodes_.erase(id);
      at_.erase(id);
      continue;
    }
    if (there.size() != 2 || keep.contains(id) || *there.begin() == *std::next(there.begin())) continue;
    const std::int32_t a = *there.begin(), b = *std::next(there.begin());
    Line before = lines_.at(a), after = lines_.at(b);
    if (before.to != id) before = turned_round(std::move(before));
    if (after.from != id) after = turned_round(std::move(after));
    remove_line(a);
    remove_line(b);
    before.points.insert(before.points.end(), after.points.begin() + 1, after.points.end());
    before.radius_mm.insert(before.radius_mm.end(), after.radius_mm.begin() + 1, after.radius_mm.end());
    add_line(before.from, after.to, std::move(before.points), std::move(before.radius_mm));
    nodes_.erase(id);
    at_.erase(id);
  }
}

std::map<std::int32_t, LineGraph::Reach> LineGraph::reach(std::int32_t from) const {
  std::map<std::int32_t, Reach> reached{{from, {}}};
  std::set<std::pair<double, std::int32_t>> open{{0.0, from}};
  while (!open.empty()) {
    const auto [mm, node] = *open.begin();
    open.erase(open.begin());
    if (mm > reached.at(node).mm) continue;
    for (const std::int32_t id : at_.at(node)) {
      const double there = mm + length_mm(lines_.at(id));
      const std::int32_t other = other_end(id, node);
      const auto known = reached.find(other);
      if (known != reached.end() && known->second.mm <= there) continue;
      reached[other] = {there, id};
      open.insert({there, other});
    }
  }
  return reached;
}

std::map<std::int32_t, std::int32_t> LineGraph::parts() const {
  std::map<std::int32_t, std::int32_t> part;
  for (const auto& [id, node] : nodes_) {
    if (part.contains(id)) continue;
    std::vector<std::int32_t> open{id};
    part[id] = id;
    while (!open.empty()) {
      const std::int32_t here = open.back();
      open.pop_back();
      for (const std::int32_t line : at_.at(here))
        if (const std::int32_t other = other_end(line, here); part.emplace(other, id).second)
          open.push_back(other);
    }
  }
  return part;
}

centerline::SkeletonGraph LineGraph::graph() const {
  using centerline::SkeletonNodeKind;
  centerline::SkeletonGraph graph;
  for (const auto& [id, node] : nodes_) {
    const auto& there = at_.at(id);
    const bool closed = there.size() == 2 && *there.begin() == *std::next(there.begin());
    const SkeletonNodeKind kind = there.empty()       ? SkeletonNodeKind::point
                                  : there.size() == 1 ? SkeletonNodeKind::end
                                  : closed            ? SkeletonNodeKind::loop_anchor
                                  : there.size() == 2 ? SkeletonNodeKind::passage
                                                      : SkeletonNodeKind::junction;
    graph.nodes.push_back({id, node.at, kind, node.radius_mm});
  }
  for (const auto& [id, line] : lines_)
    graph.edges.push_back({id, line.from, line.to, line.points, line.radius_mm});
  return graph;
}

double length_mm(const LineGraph::Line& line) {
  return geometry::length(line.points);
}

Vec3 outward(const LineGraph::Line& line, bool at_first, double over_mm) {
  const double whole = length_mm(line), back = std::min(over_mm, whole);
  const Vec3 end = at_first ? line.points.front() : line.points.back();
  const Vec3 inside = geometry::at_abscissa(line.points, at_first ? back : whole - back).point;
  const Vec3 way = end - inside;
  return way.norm() > same_place_mm ? Vec3(way.normalized()) : Vec3(Vec3::Zero());
}

double mean_radius(const LineGraph::Line& line, bool at_first, double from_mm, double to_mm) {
  const std::vector<double> s = geometry::abscissas(line.points);
  double sum = 0.0, all = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double away = at_first ? s[i] : s.back() - s[i];
    all += line.radius_mm[i];
    if (away < from_mm || away > to_mm) continue;
    sum += line.radius_mm[i];
    ++count;
  }
  return count > 0 ? sum / count : all / static_cast<double>(s.size());
}

std::vector<Vec3> straight_points(const Vec3& from, const Vec3& to) {
  constexpr double step_mm = 0.5;
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from).norm() / step_mm)));
  std::vector<Vec3> points;
  for (int i = 0; i < pieces; ++i) points.push_back(from + (static_cast<double>(i) / pieces) * (to - from));
  points.push_back(to);
  return points;
}

}  // namespace ostia::coronary
