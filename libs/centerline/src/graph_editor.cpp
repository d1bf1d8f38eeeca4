#include "graph_editor.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace ostia::centerline::detail {
namespace {

constexpr double same_mm = 1e-9;

// Points that stand still are left out; the last one stays.
void tidy(std::vector<Vec3>& points, std::vector<double>& radius_mm) {
  std::vector<Vec3> kept{points.front()};
  std::vector<double> radii{radius_mm.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - kept.back()).norm() <= same_mm) {
      if (i + 1 < points.size() || kept.size() < 2) continue;
      kept.pop_back();
      radii.pop_back();
    }
    kept.push_back(points[i]);
    radii.push_back(radius_mm[i]);
  }
  points = std::move(kept);
  radius_mm = std::move(radii);
}

template <class T>
void append(std::vector<T>& line, const std::vector<T>& more) {
  line.insert(line.end(), more.begin() + 1, more.end());
}

}  // namespace

void require_sound(const SkeletonGraph& graph, const char* what) {
  if (const auto fault = find_fault(graph)) throw InvalidInput(std::string(what) + ": " + *fault);
}

void require(bool good, const char* what, const char* name, double value, const char* allowed) {
  if (good) return;
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, "%s: %s is %g; it must be in %s", what, name, value, allowed);
  throw InvalidInput(buffer);
}

std::string text(const Vec3& place) {
  return "(" + core::fixed_text(place.x(), 2) + ", " + core::fixed_text(place.y(), 2) + ", " +
         core::fixed_text(place.z(), 2) + ") mm";
}

LineEnd line_end(const SkeletonEdge& edge, bool at_first, double length_mm) {
  constexpr int steps = 16;
  const double whole = geometry::length(edge.points);
  const double reach = std::min(length_mm, whole);
  // Over t from -1 inside to 0 at the end, at equal steps: mean and slope.
  Vec3 mean = Vec3::Zero(), slope = Vec3::Zero();
  double spread = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double t = -1.0 + static_cast<double>(i) / steps;
    const Vec3 p = geometry::at_abscissa(edge.points, at_first ? -t * reach : whole + t * reach).point;
    mean += p / (steps + 1);
    slope += (t + 0.5) * p;
    spread += (t + 0.5) * (t + 0.5);
  }
  slope /= spread;
  LineEnd end;
  end.point = mean + 0.5 * slope;
  if (slope.norm() > same_mm) end.outward = slope.normalized();
  return end;
}

std::vector<Vec3> straight_way(const Vec3& from, const Vec3& to) {
  constexpr double step_mm = 0.5;
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from).norm() / step_mm)));
  std::vector<Vec3> points;
  for (int i = 0; i < pieces; ++i) points.push_back(from + (static_cast<double>(i) / pieces) * (to - from));
  points.push_back(to);
  return points;
}

GraphEditor::GraphEditor(const SkeletonGraph& graph) {
  for (const SkeletonNode& n : graph.nodes) {
    nodes_[n.id] = n;
    incident_[n.id];
    next_node_ = std::max(next_node_, n.id + 1);
  }
  for (const SkeletonEdge& e : graph.edges) {
    edges_[e.id] = e;
    incident_[e.from].insert(e.id);
    incident_[e.to].insert(e.id);
    next_edge_ = std::max(next_edge_, e.id + 1);
  }
}

std::size_t GraphEditor::degree(std::int32_t node) const {
  return incident_.at(node).size();
}

std::int32_t GraphEditor::add_node(const Vec3& position, double radius_mm) {
  const std::int32_t id = next_node_++;
  nodes_[id] = {id, position, SkeletonNodeKind::point, radius_mm};
  incident_[id];
  return id;
}

std::int32_t GraphEditor::add_edge(std::int32_t from, std::int32_t to, std::vector<Vec3> points,
                                   std::vector<double> radius_mm) {
  const std::int32_t id = next_edge_++;
  tidy(points, radius_mm);
  edges_[id] = {id, from, to, std::move(points), std::move(radius_mm)};
  incident_.at(from).insert(id);
  incident_.at(to).insert(id);
  return id;
}

void GraphEditor::replace_line(std::int32_t edge, std::vector<Vec3> points, std::vector<double> radius_mm) {
  tidy(points, radius_mm);
  edges_.at(edge).points = std::move(points);
  edges_.at(edge).radius_mm = std::move(radius_mm);
}

void GraphEditor::reverse(std::int32_t edge) {
  SkeletonEdge& e = edges_.at(edge);
  std::swap(e.from, e.to);
  std::reverse(e.points.begin(), e.points.end());
  std::reverse(e.radius_mm.begin(), e.radius_mm.end());
}

void GraphEditor::remove_edge(std::int32_t edge) {
  const SkeletonEdge& e = edges_.at(edge);
  for (const std::int32_t n : {e.from, e.to}) {
    auto& at = incident_.at(n);
    at.erase(at.find(edge));
  }
  edges_.erase(edge);
}

void GraphEditor::remove_node(std::int32_t node) {
  nodes_.erase(node);
  incident_.erase(node);
}

std::int32_t GraphEditor::join_at(std::int32_t node) {
  const auto& at = incident_.at(node);
  if (at.size() != 2 || *at.begin() == *std::next(at.begin())) return -1;
  const std::int32_t keep = *at.begin(), other = *std::next(at.begin());
  const bool leaves = edges_.at(keep).from == node;  // then the other part comes before it
  SkeletonEdge rest = edges_.at(other);
  if ((rest.from == node) == leaves) {
    std::swap(rest.from, rest.to);
    std::reverse(rest.points.begin(), rest.points.end());
    std::reverse(rest.radius_mm.begin(), rest.radius_mm.end());
  }
  remove_edge(other);
  SkeletonEdge joined = edges_.at(keep);
  remove_edge(keep);
  if (leaves) std::swap(joined, rest);
  append(joined.points, rest.points);
  append(joined.radius_mm, rest.radius_mm);
  joined.to = rest.to;
  joined.id = keep;
  tidy(joined.points, joined.radius_mm);
  incident_.at(joined.from).insert(keep);
  incident_.at(joined.to).insert(keep);
  edges_[keep] = std::move(joined);
  remove_node(node);
  return keep;
}

std::int32_t GraphEditor::split(const GraphPlace& place) {
  SkeletonEdge before = edges_.at(place.id);
  const double radius =
      (1.0 - place.t) * before.radius_mm[place.segment] + place.t * before.radius_mm[place.segment + 1];
  const std::int32_t middle = add_node(place.point, radius);
  const auto at = static_cast<std::ptrdiff_t>(place.segment) + 1;
  std::vector<Vec3> points{place.point};
  std::vector<double> radii{radius};
  points.insert(points.end(), before.points.begin() + at, before.points.end());
  radii.insert(radii.end(), before.radius_mm.begin() + at, before.radius_mm.end());
  const std::int32_t end = before.to;
  before.points.resize(static_cast<std::size_t>(at));
  before.radius_mm.resize(static_cast<std::size_t>(at));
  before.points.push_back(place.point);
  before.radius_mm.push_back(radius);
  before.to = middle;
  tidy(before.points, before.radius_mm);
  auto& old_end = incident_.at(end);
  old_end.erase(old_end.find(place.id));
  incident_.at(middle).insert(place.id);
  edges_[place.id] = std::move(before);
  add_edge(middle, end, std::move(points), std::move(radii));
  return middle;
}

void GraphEditor::detach(std::int32_t edge, bool at_from) {
  SkeletonEdge& e = edges_.at(edge);
  std::int32_t& side = at_from ? e.from : e.to;
  const std::int32_t own = add_node(at_from ? e.points.front() : e.points.back(),
                                    at_from ? e.radius_mm.front() : e.radius_mm.back());
  auto& at = incident_.at(side);
  at.erase(at.find(edge));
  side = own;
  incident_.at(own).insert(edge);
}

GraphPlace GraphEditor::closest(const Vec3& place, double snap_mm) const {
  GraphPlace best;
  best.id = -1;
  best.distance_mm = std::numeric_limits<double>::infinity();
  for (const auto& [id, n] : nodes_) {
    const double d = (n.position - place).norm();
    if (d < best.distance_mm) best = {true, id, 0, 0.0, n.position, d};
  }
  if (best.id >= 0 && best.distance_mm <= snap_mm) return best;
  for (const auto& [id, e] : edges_) {
    const geometry::PolylineLocation at = geometry::closest(e.points, place);
    const double d = (at.point - place).norm();
    const bool inside =
        (at.point - e.points.front()).norm() > same_mm && (at.point - e.points.back()).norm() > same_mm;
    if (inside && d < best.distance_mm) best = {false, id, at.segment, at.t, at.point, d};
  }
  return best;
}

GraphPlace GraphEditor::closest_end(const Vec3& place) const {
  GraphPlace best;
  best.id = -1;
  best.distance_mm = std::numeric_limits<double>::infinity();
  for (const auto& [id, n] : nodes_) {
    const double d = (n.position - place).norm();
    if (degree(id) == 1 && d < best.distance_mm) best = {true, id, 0, 0.0, n.position, d};
  }
  return best;
}

SkeletonGraph GraphEditor::graph() const {
  SkeletonGraph result;
  for (const auto& [id, n] : nodes_) {
    SkeletonNode copy = n;
    const auto& at = incident_.at(id);
    const bool closed = at.size() == 2 && *at.begin() == *std::next(at.begin());
    copy.kind = at.empty()       ? SkeletonNodeKind::point
                : at.size() == 1 ? SkeletonNodeKind::end
                : closed         ? SkeletonNodeKind::loop_anchor
                : at.size() == 2 ? SkeletonNodeKind::passage
                                 : SkeletonNodeKind::junction;
    result.nodes.push_back(copy);
  }
  for (const auto& [id, e] : edges_) result.edges.push_back(e);
  return result;
}

}  // namespace ostia::centerline::detail
