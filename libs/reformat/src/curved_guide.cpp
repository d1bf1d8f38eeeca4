#include "curved_guide.h"

#include "ostia/geometry/zero_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::reformat {
namespace {

constexpr double node_step_mm = 0.05;
constexpr std::size_t block_intervals = 16;
constexpr double stall_mm = 1e-6;  // a projected way that counts as none

Vec3 across(const Vec3& a, const Vec3& v) {
  return a - a.dot(v) * v;
}

/// The projected length between two abscissas: Gauss-Legendre, three points.
double projected_length(const geometry::AxisCurve& axis, const Vec3& v, double from, double to) {
  constexpr std::array<double, 3> at{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double s = 0.5 * (from + to) + 0.5 * (to - from) * at[i];
    sum += weight[i] * across(axis.frame(s).tangent, v).norm();
  }
  return sum * (to - from);
}

Vec3 fixed_direction(const geometry::AxisCurve& axis, double theta) {
  const Vec3 chord = axis.point(axis.length()) - axis.point(0.0);
  const Vec3 along = chord.norm() > 1e-3 ? Vec3(chord.normalized()) : axis.frame(0.0).tangent;
  const Vec3 first = geometry::initial_normal(along);
  return geometry::radial_direction({along, first, along.cross(first)}, theta).normalized();
}

/// Near the centre of curvature a minimum and a maximum of the distance may lie within one interval, whose
/// ends have the same sign then: where in between `sign * ahead` is not positive, or 0 where nowhere.
template <class Ahead>
double lowest_inside(const Ahead& ahead, double sign) {
  constexpr double edge = 1e-3, golden = 0.6180339887498949;
  const auto f = [&](double t) { return sign * ahead(t); };
  if (!(f(edge) < f(0.0) && f(1.0 - edge) < f(1.0))) return 0.0;
  double low = 0.0, high = 1.0;
  double a = high - golden, b = low + golden, fa = f(a), fb = f(b);
  for (int i = 0; i < 60; ++i) {
    if (fa <= 0.0) return a;
    if (fb <= 0.0) return b;
    if (fa < fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - golden * (high - low);
      fa = f(a);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + golden * (high - low);
      fb = f(b);
    }
  }
  return 0.0;
}

}  // namespace

std::shared_ptr<const CurvedReformation::Guide> CurvedReformation::Guide::of_axis(
    const geometry::AxisCurve& axis) {
  auto guide = std::make_shared<Guide>();
  const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(axis.length() / node_step_mm)));
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double at = axis.length() * static_cast<double>(i) / static_cast<double>(pieces);
    guide->w.push_back(at);
    guide->points.push_back(axis.point(at));
    guide->directions.push_back(axis.frame(at).tangent);
  }
  guide->make_blocks();
  return guide;
}

std::shared_ptr<const CurvedReformation::Guide> CurvedReformation::Guide::of_projection(
    const geometry::AxisCurve& axis, double theta) {
  auto guide = std::make_shared<Guide>();
  guide->stretched = true;
  const Vec3 v = fixed_direction(axis, theta);
  guide->v = v;
  const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(axis.length() / node_step_mm)));
  double way = 0.0, before = 0.0, low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double at = axis.length() * static_cast<double>(i) / static_cast<double>(pieces);
    if (i > 0) way += projected_length(axis, v, before, at);
    before = at;
    const Vec3 point = axis.point(at);
    low = std::min(low, point.dot(v));
    high = std::max(high, point.dot(v));
    const bool only_one = i == pieces && guide->w.size() == 1;  // an axis of no length to speak of
    if (only_one) way = std::max(way, guide->w.back() + stall_mm);
    if (i > 0 && way < guide->w.back() + stall_mm) continue;
    const Vec3 direction = across(axis.frame(at).tangent, v);
    const Vec3 flat = across(point, v);
    Vec3 unit = direction.norm() > 1e-4 ? Vec3(direction.normalized()) : Vec3::Zero();
    if (unit.isZero() && i > 0) {
      const Vec3 step = flat - guide->points.back();
      unit = step.norm() > 0.0 ? Vec3(step.normalized()) : guide->directions.back();
    }
    guide->w.push_back(way);
    guide->s.push_back(at);
    guide->points.push_back(flat);
    guide->directions.push_back(unit);
  }
  guide->s.back() = axis.length();
  if (guide->directions.front().isZero()) {  // the axis sets out along v
    guide->directions.front() = guide->w.size() > 1 ? guide->directions[1] : v.unitOrthogonal();
  }
  guide->middle = 0.5 * (low + high);
  guide->make_blocks();
  return guide;
}

std::size_t CurvedReformation::Guide::interval(double at) const {
  const auto upper = std::upper_bound(w.begin() + 1, w.end() - 1, at);
  return static_cast<std::size_t>(upper - w.begin()) - 1;
}

Vec3 CurvedReformation::Guide::piece(std::size_t i, double t) const {
  const double u = 1.0 - t, h = w[i + 1] - w[i];
  return u * u * (1.0 + 2.0 * t) * points[i] + t * t * (3.0 - 2.0 * t) * points[i + 1] +
         h * t * u * (u * directions[i] - t * directions[i + 1]);
}

Vec3 CurvedReformation::Guide::slope(std::size_t i, double t) const {
  const double u = 1.0 - t, h = w[i + 1] - w[i];
  return (6.0 * t * u / h) * (points[i + 1] - points[i]) + u * (1.0 - 3.0 * t) * directions[i] +
         t * (3.0 * t - 2.0) * directions[i + 1];
}

Vec3 CurvedReformation::Guide::point(const geometry::AxisCurve& axis, double at) const {
  if (at <= w.front()) return points.front() + (at - w.front()) * directions.front();
  if (at >= w.back()) return points.back() + (at - w.back()) * directions.back();
  if (!stretched) return axis.point(at);
  const std::size_t i = interval(at);
  return piece(i, (at - w[i]) / (w[i + 1] - w[i]));
}

geometry::Frame CurvedReformation::Guide::frame(const geometry::AxisCurve& axis, double at) const {
  if (!stretched) return axis.frame(at);
  Vec3 tangent;
  if (at <= w.front()) {
    tangent = directions.front();
  } else if (at >= w.back()) {
    tangent = directions.back();
  } else {
    const std::size_t i = interval(at);
    tangent = slope(i, (at - w[i]) / (w[i + 1] - w[i]));
    // At a cusp, where the axis turns through v, the projection comes to rest and turns back.
    tangent = tangent.norm() > 1e-9 ? Vec3(tangent.normalized()) : directions[i];
  }
  return {tangent, v, tangent.cross(v)};
}

double CurvedReformation::Guide::abscissa(double at) const {
  if (!stretched) return at;
  if (at <= w.front()) return at - w.front();
  if (at >= w.back()) return s.back() + at - w.back();
  const std::size_t i = interval(at);
  return s[i] + (s[i + 1] - s[i]) * (at - w[i]) / (w[i + 1] - w[i]);
}

double CurvedReformation::Guide::coordinate(double s_mm) const {
  if (!stretched) return s_mm;
  if (s_mm <= 0.0) return w.front() + s_mm;
  if (s_mm >= s.back()) return w.back() + s_mm - s.back();
  const auto upper = std::upper_bound(s.begin() + 1, s.end() - 1, s_mm);
  const auto i = static_cast<std::size_t>(upper - s.begin()) - 1;
  return w[i] + (w[i + 1] - w[i]) * (s_mm - s[i]) / (s[i + 1] - s[i]);
}

std::vector<CurvedReformation::Guide::Foot> CurvedReformation::Guide::feet(const geometry::AxisCurve& axis,
                                                                           const Vec3& place) const {
  std::vector<Foot> found;
  const Vec3 at = stretched ? across(place, v) : place;
  const double at_start = (at - points.front()).dot(directions.front());
  const double at_end = (at - points.back()).dot(directions.back());
  if (at_start <= 0.0) found.push_back({w.front() + at_start, true});
  for (const Block& block : blocks) {
    const Vec3 offset = at - block.centre;
    if (std::abs(offset.dot(block.direction)) > offset.norm() * block.turn + block.reach) continue;
    for (std::size_t i = block.first; i < block.last; ++i) add_feet(axis, at, i, found);
  }
  if (at_end > 0.0) found.push_back({w.back() + at_end, true});
  return found;
}

void CurvedReformation::Guide::add_feet(const geometry::AxisCurve& axis, const Vec3& at, std::size_t i,
                                        std::vector<Foot>& found) const {
  const double h = w[i + 1] - w[i];
  const double before = (at - points[i]).dot(directions[i]);
  const double after = (at - points[i + 1]).dot(directions[i + 1]);
  const bool crosses = (before > 0.0) != (after > 0.0);
  if (!crosses && std::min(std::abs(before), std::abs(after)) >= h) return;
  const auto ahead = [&](double t) {  // how far the place lies ahead, along the guide
    if (stretched) return (at - piece(i, t)).dot(slope(i, t));
    const double here = w[i] + t * h;
    return (at - axis.point(here)).dot(axis.frame(here).tangent);
  };
  const auto add = [&](double from, double to, bool nearest) {
    const auto part = [&](double t) { return ahead(from + t * (to - from)); };
    found.push_back({w[i] + h * (from + (to - from) * geometry::zero_crossing(part)), nearest});
  };
  if (crosses) {
    add(0.0, 1.0, before > 0.0);
    return;
  }
  const double split = lowest_inside(ahead, before > 0.0 ? 1.0 : -1.0);
  if (split <= 0.0) return;
  add(0.0, split, before > 0.0);
  add(split, 1.0, before <= 0.0);
}

void CurvedReformation::Guide::make_blocks() {
  const std::size_t intervals = w.size() - 1;
  for (std::size_t first = 0; first < intervals; first += block_intervals) {
    const std::size_t last = std::min(intervals, first + block_intervals), middle_node = (first + last) / 2;
    Block block{first, last, points[middle_node], directions[middle_node], 0.0, 0.0};
    double longest = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      block.turn = std::max(block.turn, (directions[i] - block.direction).norm());
      block.reach = std::max(block.reach, (points[i] - block.centre).norm());
      if (i > first) longest = std::max(longest, w[i] - w[i - 1]);
    }
    block.reach += longest;
    blocks.push_back(block);
  }
}

}  // namespace ostia::reformat
