#include "growth/round_cones.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

using geometry::Vec3;

/// A cone made ready for many questions.
struct Axis {
  Vec3 from, along;  ///< the second of length 1, or 0 for a single ball at the wider end
  double length, radius, slope;

  explicit Axis(const RoundCone& cone) : from(cone.from), along(cone.to - cone.from) {
    length = along.norm();
    radius = cone.radius_from;
    slope = length > 0.0 ? (cone.radius_to - cone.radius_from) / length : 0.0;
    if (length > 0.0) along /= length;
    if (length == 0.0) radius = std::max(cone.radius_from, cone.radius_to);
  }
  Vec3 point(double u) const { return from + u * along; }
  double radius_at(double u) const { return radius + slope * u; }
};

/// The place on the axis where distance less radius is least for a point.
double best_place(const Axis& axis, const Vec3& point) {
  if (std::abs(axis.slope) >= 1.0) return axis.slope > 0.0 ? axis.length : 0.0;
  const Vec3 off = point - axis.from;
  const double foot = off.dot(axis.along);
  const double side = std::sqrt(std::max(0.0, off.squaredNorm() - foot * foot));
  const double ahead = side * axis.slope / std::sqrt(1.0 - axis.slope * axis.slope);
  return std::clamp(foot + ahead, 0.0, axis.length);
}

double squared_distance_of_segments(const RoundCone& a, const RoundCone& b) {
  const Vec3 u = a.to - a.from, v = b.to - b.from, w = a.from - b.from;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  double s = det > 1e-14 * uu * vv ? std::clamp((uv * vw - vv * uw) / det, 0.0, 1.0) : 0.0;
  double t = vv > 0.0 ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0.0;
  s = uu > 0.0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0.0;
  t = vv > 0.0 ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0.0;
  return (w + s * u - t * v).squaredNorm();
}

}  // namespace

RoundCone round_cone(const geometry::VesselGraph& graph, std::int32_t edge) {
  const geometry::GraphEdge& e = graph.edges[static_cast<std::size_t>(edge)];
  return {graph.points[static_cast<std::size_t>(e.from)], graph.points[static_cast<std::size_t>(e.to)],
          e.radius_from, e.radius_to};
}

std::optional<ConeContact> contact(const RoundCone& a, const RoundCone& b) {
  const double most = std::max(a.radius_from, a.radius_to) + std::max(b.radius_from, b.radius_to);
  // Most pairs are further apart than their greatest radii reach; a hair more for round-off.
  if (squared_distance_of_segments(a, b) > most * most * (1.0 + 1e-9)) return std::nullopt;
  const Axis p(a), q(b);
  const auto gap = [&](double u) {
    const Vec3 centre = p.point(u);
    const double v = best_place(q, centre);
    return (centre - q.point(v)).norm() - p.radius_at(u) - q.radius_at(v);
  };
  constexpr double golden = 0.6180339887498949;
  double low = 0.0, high = p.length;
  double u1 = high - golden * (high - low), u2 = low + golden * (high - low);
  double g1 = gap(u1), g2 = gap(u2);
  for (int i = 0; i < 64 && high - low > 1e-12 * p.length; ++i) {
    if (g1 <= g2) {
      high = u2, u2 = u1, g2 = g1;
      u1 = high - golden * (high - low);
      g1 = gap(u1);
    } else {
      low = u1, u1 = u2, g1 = g2;
      u2 = low + golden * (high - low);
      g2 = gap(u2);
    }
  }
  double u = 0.5 * (low + high);
  for (const double end : {0.0, p.length})
    if (gap(end) < gap(u)) u = end;
  const double depth = -gap(u);
  if (!(depth > 0.0)) return std::nullopt;
  const double v = best_place(q, p.point(u));
  const Vec3 between = q.point(v) - p.point(u);
  const double distance = between.norm();
  ConeContact result{depth, p.length > 0.0 ? u / p.length : 0.0, q.length > 0.0 ? v / q.length : 0.0,
                     p.point(u)};
  if (distance > 0.0)
    result.place += between * (std::clamp(p.radius_at(u) - 0.5 * depth, 0.0, distance) / distance);
  return result;
}

}  // namespace ostia::analysis
