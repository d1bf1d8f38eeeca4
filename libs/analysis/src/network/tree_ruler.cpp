#include "ostia/analysis/tree_ruler.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

using geometry::GraphEdge;
using geometry::Vec3;

std::size_t at(std::int32_t index) {
  return static_cast<std::size_t>(index);
}

/// The part of a segment, from 0 to 1, that lies in a sphere; empty where first >= second.
std::pair<double, double> inside(const Vec3& from, const Vec3& to, const Vec3& centre, double radius) {
  const Vec3 along = to - from, away = from - centre;
  const double a = along.squaredNorm();
  if (a == 0.0) return away.norm() <= radius ? std::pair(0.0, 1.0) : std::pair(1.0, 0.0);
  const double b = along.dot(away), c = away.squaredNorm() - radius * radius;
  const double root = b * b - a * c;
  if (!(root > 0.0)) return {1.0, 0.0};
  return {std::max(0.0, (-b - std::sqrt(root)) / a), std::min(1.0, (-b + std::sqrt(root)) / a)};
}

}  // namespace

TreeRuler::TreeRuler(std::shared_ptr<const geometry::VesselGraph> graph, const core::TaskContext& task)
    : graph_(std::move(graph)) {
  const geometry::GraphIncidence incidence(*graph_);
  try {
    report_ = measure_tree(*graph_, task);
    distances_.emplace(*graph_, report_->links);
  } catch (const InvalidInput& error) {
    report_.reset();
    why_no_tree_ = error.what();
  }
  ends_.resize(graph_->points.size());
  for (std::size_t p = 0; p < ends_.size(); ++p)
    ends_[p] = incidence.leaving(static_cast<std::int32_t>(p)).empty() ? 1 : 0;
}

double TreeRuler::length_mm(std::int32_t edge) const {
  const GraphEdge& e = graph_->edges[at(edge)];
  return (graph_->points[at(e.to)] - graph_->points[at(e.from)]).norm();
}

SegmentFacts TreeRuler::facts(std::int32_t edge) const {
  const GraphEdge& e = graph_->edges.at(at(edge));
  SegmentFacts facts;
  facts.reference = graph_->references.empty() ? edge : graph_->references[at(edge)];
  facts.cone = measure_segment(*graph_, edge);
  facts.radius_from_mm = e.radius_from;
  facts.radius_to_mm = e.radius_to;
  if (!report_) return facts;
  facts.of_tree = true;
  facts.branch = report_->links.branch_of[at(edge)];
  facts.strahler = report_->strahler[at(facts.branch)];
  facts.diameter_order = report_->diameter_orders.of_branch[at(facts.branch)];
  facts.from_root_mm = distances_->from_root_mm(e.from);
  facts.behind = report_->subtrees[at(edge)];
  return facts;
}

Vec3 TreeRuler::point(const TreePlace& place) const {
  const GraphEdge& e = graph_->edges.at(at(place.edge));
  return (1.0 - place.t) * graph_->points[at(e.from)] + place.t * graph_->points[at(e.to)];
}

double TreeRuler::radius_mm(const TreePlace& place) const {
  const GraphEdge& e = graph_->edges.at(at(place.edge));
  return (1.0 - place.t) * e.radius_from + place.t * e.radius_to;
}

double TreeRuler::straight_mm(const TreePlace& a, const TreePlace& b) const {
  return (point(a) - point(b)).norm();
}

std::optional<double> TreeRuler::along_mm(const TreePlace& a, const TreePlace& b) const {
  if (!distances_) return std::nullopt;
  const double la = length_mm(a.edge), lb = length_mm(b.edge);
  if (a.edge == b.edge) return std::abs(a.t - b.t) * la;
  const GraphEdge &ea = graph_->edges[at(a.edge)], &eb = graph_->edges[at(b.edge)];
  // There is one way in a tree, it leaves each segment at one of its ends, and any other is longer.
  std::optional<double> least;
  for (const auto& [from, out] : {std::pair(ea.from, a.t * la), {ea.to, (1.0 - a.t) * la}})
    for (const auto& [to, in] : {std::pair(eb.from, b.t * lb), {eb.to, (1.0 - b.t) * lb}}) {
      const std::optional<double> between = distances_->between_mm(from, to);
      if (!between) return std::nullopt;
      const double way = out + *between + in;
      if (!least || way < *least) least = way;
    }
  return least;
}

std::optional<double> TreeRuler::angle_rad(std::int32_t a, std::int32_t b) const {
  const auto direction = [this](std::int32_t edge) -> Vec3 {
    const GraphEdge& e = graph_->edges.at(at(edge));
    return graph_->points[at(e.to)] - graph_->points[at(e.from)];
  };
  const Vec3 da = direction(a), db = direction(b);
  if (!(da.norm() > 0.0) || !(db.norm() > 0.0)) return std::nullopt;
  return std::atan2(da.cross(db).norm(), da.dot(db));
}

const ForkAngles* TreeRuler::fork_behind(std::int32_t edge) const {
  if (!report_) return nullptr;
  const geometry::GraphBranch& branch = report_->links.branches[at(report_->links.branch_of[at(edge)])];
  const std::int32_t end = graph_->edges[at(branch.edges.back())].to;
  const auto found = std::lower_bound(report_->angles.begin(), report_->angles.end(), end,
                                      [](const ForkAngles& one, std::int32_t p) { return one.point < p; });
  return found != report_->angles.end() && found->point == end ? &*found : nullptr;
}

std::vector<std::uint8_t> TreeRuler::subtree(std::int32_t edge) const {
  std::vector<std::uint8_t> part(graph_->edges.size(), 0);
  if (!report_) return part;
  part.at(at(edge)) = 1;
  for (const std::int32_t e : report_->links.outward) {
    const std::int32_t parent = report_->links.parent[at(e)];
    if (parent >= 0 && part[at(parent)]) part[at(e)] = 1;
  }
  return part;
}

SubtreeTotals TreeRuler::within(const Vec3& centre, double radius_mm) const {
  if (!(radius_mm >= 0.0)) throw InvalidInput("the radius of a region must not be below 0");
  SubtreeTotals totals;
  for (const GraphEdge& e : graph_->edges) {
    const Vec3 &from = graph_->points[at(e.from)], &to = graph_->points[at(e.to)];
    const auto [first, last] = inside(from, to, centre, radius_mm);
    if (!(first < last)) continue;
    const auto radius = [&e](double t) { return (1.0 - t) * e.radius_from + t * e.radius_to; };
    const ConeMeasure part = measure_cone((last - first) * (to - from).norm(), radius(first), radius(last));
    totals.length_mm += part.length_mm;
    totals.area_mm2 += part.area_mm2;
    totals.volume_mm3 += part.volume_mm3;
    ++totals.segments;
    if (last == 1.0 && ends_[at(e.to)]) ++totals.ends;
  }
  return totals;
}

}  // namespace ostia::analysis
