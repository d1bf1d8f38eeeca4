#include "ostia/analysis/tree_ruler.h"
#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ostia::analysis {
namespace {

using geometry::GraphEdge;
using geometry::Vec3;

constexpr std::int32_t leaf_size = 4;

double width(double radius) {
  return std::isfinite(radius) && radius > 0.0 ? radius : 0.0;
}

/// A place on a segment's axis and one on the ray, mm from its origin.
struct Along {
  double t = 0.0, depth = 0.0;
};

/// Where the ray is nearest to the segment: the depth is at least 0.
Along nearest(const Vec3& from, const Vec3& to, const Vec3& origin, const Vec3& unit) {
  const Vec3 along = to - from, away = origin - from;
  const double a = along.squaredNorm(), b = along.dot(unit), c = along.dot(away), f = unit.dot(away);
  const double across = a - b * b;
  double t = 0.0;
  if (across > 1e-12 * a)
    t = std::clamp((c - b * f) / across, 0.0, 1.0);
  else if (b < 0.0)
    t = 1.0;  // seen end on: the end that is nearer to the eye
  if (t * b < f && a > 0.0) t = std::clamp(c / a, 0.0, 1.0);  // behind the eye: the nearest to the eye
  return {t, std::max(0.0, t * b - f)};
}

/// Where the ray enters a ball.
std::optional<double> into_ball(const Vec3& centre, double radius, const Vec3& origin, const Vec3& unit) {
  const Vec3 away = origin - centre;
  const double f = unit.dot(away), h = f * f - away.squaredNorm() + radius * radius;
  if (h < 0.0) return std::nullopt;
  return -f - std::sqrt(h);
}

/// Where the ray's whole line enters the balls whose centres and radii run evenly from one end to the other:
/// of the depths at which it enters each of them, the least is on the cone that touches them all, unless its
/// ball lies beyond an end.
std::optional<Along> entry(const Vec3& from, const Vec3& to, double r_from, double r_to, const Vec3& origin,
                           const Vec3& unit) {
  const Vec3 axis = to - from, away = origin - from;
  const double taper = r_from - r_to, whole = axis.squaredNorm() - taper * taper;
  if (whole > 0.0) {
    const double m1 = axis.dot(away), m2 = axis.dot(unit), m3 = unit.dot(away);
    const double k2 = whole - m2 * m2, k1 = whole * m3 - m1 * m2 + m2 * taper * r_from,
                 k0 = whole * away.squaredNorm() - m1 * m1 + 2.0 * m1 * taper * r_from -
                      axis.squaredNorm() * r_from * r_from;
    const double h = k1 * k1 - k0 * k2;
    if (h >= 0.0 && std::abs(k2) > 1e-12 * whole) {
      const double depth = (-std::sqrt(h) - k1) / k2;
      const double t = (m1 - r_from * taper + depth * m2) / whole;
      if (t > 0.0 && t < 1.0) return Along{t, depth};
    }
  }
  const auto first = into_ball(from, r_from, origin, unit), last = into_ball(to, r_to, origin, unit);
  if (!first && !last) return std::nullopt;
  return !last || (first && *first <= *last) ? Along{0.0, *first} : Along{1.0, *last};
}

/// What a ray hits of a segment: its wall, or without that the axis's nearest place where that is near
/// enough.
std::optional<Along> hit_of(const GraphEdge& e, const Vec3& from, const Vec3& to, const TreeRay& ray,
                            const Vec3& unit) {
  const Along near = nearest(from, to, ray.origin, unit);
  const double r_from = width(e.radius_from), r_to = width(e.radius_to);
  const auto wall = entry(from, to, r_from, r_to, ray.origin, unit);
  if (wall && wall->depth >= 0.0) return wall;
  const double apart = (ray.origin + near.depth * unit - (1.0 - near.t) * from - near.t * to).norm();
  if (apart > (1.0 - near.t) * r_from + near.t * r_to + ray.slack * near.depth) return std::nullopt;
  return wall ? Along{near.t, 0.0} : near;  // a wall behind the eye: the eye is in the vessel
}

}  // namespace

TreeRays::TreeRays(std::shared_ptr<const geometry::VesselGraph> graph, const core::TaskContext& task)
    : graph_(std::move(graph)) {
  const auto usable = [this](std::int32_t point) {
    return point >= 0 && static_cast<std::size_t>(point) < graph_->points.size() &&
           graph_->points[static_cast<std::size_t>(point)].allFinite();
  };
  for (std::size_t e = 0; e < graph_->edges.size(); ++e)
    if (usable(graph_->edges[e].from) && usable(graph_->edges[e].to))
      order_.push_back(static_cast<std::int32_t>(e));
  if (!order_.empty()) build(task);
}

TreeRays::Node TreeRays::node_of(std::int32_t first, std::int32_t last) const {
  Node node;
  node.lower.fill(std::numeric_limits<float>::infinity());
  node.upper.fill(-std::numeric_limits<float>::infinity());
  for (std::int32_t i = first; i < last; ++i) {
    const GraphEdge& e = graph_->edges[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    for (const auto& [p, r] : {std::pair(e.from, e.radius_from), {e.to, e.radius_to}}) {
      const Vec3& at = graph_->points[static_cast<std::size_t>(p)];
      for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        const auto outwards = std::numeric_limits<float>::infinity();
        node.lower[axis] =
            std::min(node.lower[axis], std::nextafter(static_cast<float>(at[a] - width(r)), -outwards));
        node.upper[axis] =
            std::max(node.upper[axis], std::nextafter(static_cast<float>(at[a] + width(r)), outwards));
      }
    }
  }
  return node;
}

void TreeRays::build(const core::TaskContext& task) {
  struct Part {
    std::int32_t first, last, parent;  // parent: whose right child this is; -1: of none
  };
  std::vector<Part> waiting{{0, static_cast<std::int32_t>(order_.size()), -1}};
  std::size_t done = 0;
  while (!waiting.empty()) {
    const Part part = waiting.back();
    waiting.pop_back();
    const auto index = static_cast<std::int32_t>(nodes_.size());
    if (part.parent >= 0) nodes_[static_cast<std::size_t>(part.parent)].next = index;
    nodes_.push_back(node_of(part.first, part.last));
    if (part.last - part.first <= leaf_size) {
      nodes_.back().next = part.first;
      nodes_.back().count = part.last - part.first;
      done += static_cast<std::size_t>(part.last - part.first);
      task.throw_if_cancelled();
      task.set_progress(static_cast<double>(done) / static_cast<double>(order_.size()));
      continue;
    }
    int longest = 0;
    const Node& node = nodes_.back();
    for (int a = 1; a < 3; ++a) {
      const auto size = [&node](int axis) {
        return node.upper[static_cast<std::size_t>(axis)] - node.lower[static_cast<std::size_t>(axis)];
      };
      if (size(a) > size(longest)) longest = a;
    }
    const auto middle_of = [this, longest](std::int32_t edge) {
      const GraphEdge& e = graph_->edges[static_cast<std::size_t>(edge)];
      return graph_->points[static_cast<std::size_t>(e.from)][longest] +
             graph_->points[static_cast<std::size_t>(e.to)][longest];
    };
    const std::int32_t half = (part.first + part.last) / 2;
    std::nth_element(order_.begin() + part.first, order_.begin() + half, order_.begin() + part.last,
                     [&](std::int32_t a, std::int32_t b) {
                       const double ma = middle_of(a), mb = middle_of(b);
                       return ma != mb ? ma < mb : a < b;
                     });
    waiting.push_back({half, part.last, index});
    waiting.push_back({part.first, half, -1});
  }
}

std::optional<TreeRayHit> TreeRays::first(const TreeRay& ray, std::span<const std::uint8_t> shown) const {
  if (nodes_.empty()) return std::nullopt;
  const Vec3 unit = ray.direction.normalized();
  if (!unit.allFinite() || !(ray.direction.norm() > 0.0))
    throw InvalidInput("a ray into a tree needs a direction");
  std::optional<TreeRayHit> best;
  const auto depth_of_box = [&](const Node& node) {
    // The slack is that at the box's far corner: never too little.
    Vec3 corner;
    for (int a = 0; a < 3; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      corner[a] =
          std::max(std::abs(node.lower[axis] - ray.origin[a]), std::abs(node.upper[axis] - ray.origin[a]));
    }
    const double slack = ray.slack * corner.norm();
    double in = 0.0, out = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      const double low = node.lower[axis] - slack - ray.origin[a],
                   high = node.upper[axis] + slack - ray.origin[a];
      if (unit[a] == 0.0) {
        if (low > 0.0 || high < 0.0) return std::numeric_limits<double>::infinity();
        continue;
      }
      in = std::max(in, std::min(low / unit[a], high / unit[a]));
      out = std::min(out, std::max(low / unit[a], high / unit[a]));
    }
    return in <= out ? in : std::numeric_limits<double>::infinity();
  };
  const auto try_edge = [&](std::int32_t edge) {
    if (!shown.empty() && !shown[static_cast<std::size_t>(edge)]) return;
    const GraphEdge& e = graph_->edges[static_cast<std::size_t>(edge)];
    const Vec3 &from = graph_->points[static_cast<std::size_t>(e.from)],
               &to = graph_->points[static_cast<std::size_t>(e.to)];
    const auto hit = hit_of(e, from, to, ray, unit);
    if (!hit) return;
    const double depth = hit->depth;
    if (best && (depth > best->depth_mm || (depth == best->depth_mm && edge > best->place.edge))) return;
    best = TreeRayHit{{edge, hit->t}, ray.origin + depth * unit, depth};
  };
  std::vector<std::int32_t> waiting{0};
  while (!waiting.empty()) {
    const std::int32_t index = waiting.back();
    waiting.pop_back();
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    const double depth = depth_of_box(node);
    if (std::isinf(depth) || (best && depth > best->depth_mm)) continue;
    if (node.count > 0) {
      for (std::int32_t i = node.next; i < node.next + node.count; ++i)
        try_edge(order_[static_cast<std::size_t>(i)]);
      continue;
    }
    const bool left_first = depth_of_box(nodes_[static_cast<std::size_t>(index + 1)]) <=
                            depth_of_box(nodes_[static_cast<std::size_t>(node.next)]);
    waiting.push_back(left_first ? node.next : index + 1);
    waiting.push_back(left_first ? index + 1 : node.next);
  }
  return best;
}

}  // namespace ostia::analysis
