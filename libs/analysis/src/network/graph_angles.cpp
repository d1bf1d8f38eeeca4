#include "ostia/analysis/graph_angles.h"

#include "network/graph_edges.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::analysis {
namespace {

using geometry::GraphEdge;
using geometry::GraphIncidence;
using geometry::Vec3;
using geometry::VesselGraph;

/// From a fork along one of its branches, away from the fork.
Vec3 reached(const VesselGraph& graph, const TreeLinks& links, std::int32_t edge, bool outward,
             double reach) {
  const auto b = static_cast<std::size_t>(links.branch_of[static_cast<std::size_t>(edge)]);
  const std::vector<std::int32_t>& chain = links.branches[b].edges;
  const auto point = [&graph](std::int32_t p) { return graph.points[static_cast<std::size_t>(p)]; };
  const GraphEdge& first = edge_at(graph, edge);
  const Vec3 fork = point(outward ? first.from : first.to);
  Vec3 at = fork;
  double left = reach;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const GraphEdge& e = edge_at(graph, outward ? chain[k] : chain[chain.size() - 1 - k]);
    const Vec3 next = point(outward ? e.to : e.from);
    const double length = (next - at).norm();
    if (length >= left && length > 0.0 && left > 0.0) return at + (next - at) * (left / length) - fork;
    at = next;
    left -= length;
    if (left <= 0.0 && (at - fork).squaredNorm() > 0.0) break;
  }
  return at - fork;
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double tilt(const Vec3& along, const Vec3& a, const Vec3& b) {
  const Vec3 normal = a.cross(b);
  // Where both lie in one line there is no plane.
  if (normal.norm() <= 1e-12 * a.norm() * b.norm()) return 0.0;
  return std::atan2(std::abs(along.dot(normal)), along.cross(normal).norm());
}

}  // namespace

std::vector<ForkAngles> fork_angles(const VesselGraph& graph, const GraphIncidence& incidence,
                                    const TreeLinks& links, double reach) {
  if (!std::isfinite(reach) || reach < 0.0)
    throw InvalidInput("angles at forks: a reach of " + std::to_string(reach) + " radii; give 0 or more");
  std::vector<ForkAngles> result;
  for (std::size_t p = 0; p < graph.points.size(); ++p) {
    const auto point = static_cast<std::int32_t>(p);
    const auto arriving = incidence.arriving(point), leaving = incidence.leaving(point);
    if (arriving.empty() || leaving.size() < 2) continue;
    const double far_mm = reach * edge_at(graph, arriving[0]).radius_to;
    const auto narrower = [&graph](std::int32_t a, std::int32_t b) {
      return edge_at(graph, a).radius_from < edge_at(graph, b).radius_from;
    };
    const std::int32_t wide = *std::max_element(leaving.begin(), leaving.end(), narrower);
    const Vec3 along = -reached(graph, links, arriving[0], false, far_mm);
    const Vec3 first = reached(graph, links, wide, true, far_mm);
    for (const std::int32_t other : leaving) {
      if (other == wide) continue;
      const Vec3 second = reached(graph, links, other, true, far_mm);
      result.push_back({point, arriving[0], wide, other, angle(first, second), angle(along, first),
                        angle(along, second), tilt(along, first, second)});
    }
  }
  return result;
}

std::optional<double> murray_exponent(double parent_radius, const std::vector<double>& child_radii) {
  if (child_radii.size() < 2 || !(parent_radius > 0.0)) return std::nullopt;
  for (const double radius : child_radii)
    if (!(radius > 0.0) || radius >= parent_radius) return std::nullopt;
  const auto excess = [&](double k) {
    double sum = -1.0;
    for (const double radius : child_radii) sum += std::pow(radius / parent_radius, k);
    return sum;
  };
  // It falls all the way from n - 1 at k = 0, so there is one root.
  double low = 0.0, high = 1.0;
  while (excess(high) > 0.0) {
    low = high;
    high *= 2.0;
    if (high > 1e12) return std::nullopt;
  }
  for (int i = 0; i < 60 && high - low > 1e-12 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<ForkExponent> fork_exponents(const VesselGraph& graph, const GraphIncidence& incidence) {
  std::vector<ForkExponent> result;
  std::vector<double> radii;
  for (std::size_t p = 0; p < graph.points.size(); ++p) {
    const auto point = static_cast<std::int32_t>(p);
    const auto arriving = incidence.arriving(point), leaving = incidence.leaving(point);
    if (arriving.empty() || leaving.size() < 2) continue;
    const double parent = edge_at(graph, arriving[0]).radius_to;
    radii.clear();
    double squares = 0.0;
    for (const std::int32_t child : leaving) {
      radii.push_back(edge_at(graph, child).radius_from);
      squares += radii.back() * radii.back();
    }
    result.push_back({point, arriving[0], murray_exponent(parent, radii),
                      parent > 0.0 ? squares / (parent * parent) : 0.0});
  }
  return result;
}

}  // namespace ostia::analysis
