#include "ostia/geometry/axis_curve.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"
#include "ostia/geometry/zero_crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::geometry {
namespace {

// Fine enough that cubic pieces follow a spline with a radius of curvature of 1 mm to 1e-6 mm.
constexpr double table_step_mm = 0.05;
constexpr double longest_mm = 1e4;
constexpr std::size_t block_intervals = 16;

Centerline checked(const Centerline& line) {
  if (line.points.size() < 2) {
    throw InvalidInput("an axis needs at least two points, this one has " +
                       std::to_string(line.points.size()));
  }
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (!line.points[i].allFinite())
      throw InvalidInput("point " + std::to_string(i) + " of the axis is not finite");
  }
  if (!line.radius.empty() && line.radius.size() != line.points.size())
    throw InvalidInput("the axis has " + std::to_string(line.points.size()) + " points and " +
                       std::to_string(line.radius.size()) + " radii; give one a point");
  for (std::size_t i = 0; i < line.radius.size(); ++i) {
    if (!(line.radius[i] > 0.0) || !std::isfinite(line.radius[i]))
      throw InvalidInput("radius " + std::to_string(i) + " of the axis is " + std::to_string(line.radius[i]) +
                         " mm; it must be positive");
  }
  if (length(line.points) > longest_mm)
    throw InvalidInput("the axis is " + std::to_string(length(line.points)) + " mm long; the limit is " +
                       std::to_string(longest_mm) + " mm (is the file in another unit?)");
  return line;
}

}  // namespace

AxisCurve::AxisCurve(const Centerline& line) {
  checked(line);
  const ArcLengthSpline spline(line.points);
  length_ = spline.length();
  const auto intervals = static_cast<std::size_t>(std::max(1.0, std::ceil(length_ / table_step_mm)));
  step_ = length_ / static_cast<double>(intervals);
  std::vector<Vec3> points, directions;
  for (std::size_t i = 0; i <= intervals; ++i) {
    const double s = std::min(length_, step_ * static_cast<double>(i));
    points.push_back(spline.point(s));
    directions.push_back(spline.tangent(s));
  }
  const Vec3 first_normal =
      line.frames.empty() ? initial_normal(directions.front()) : line.frames.front().normal;
  const std::vector<Frame> frames = rotation_minimising_frames(points, directions, first_normal);
  for (std::size_t i = 0; i < points.size(); ++i)
    nodes_.push_back({points[i], directions[i], frames[i].normal});

  for (std::size_t first = 0; first < intervals; first += block_intervals) {
    const std::size_t last = std::min(intervals, first + block_intervals);
    Block block;
    block.centre = points[(first + last) / 2];
    for (std::size_t i = first; i <= last; ++i)
      block.radius = std::max(block.radius, (points[i] - block.centre).norm());
    block.radius += step_;  // pieces between the nodes
    blocks_.push_back(block);
  }
  if (!line.radius.empty()) {
    // Arc length of the given points on the spline: chords are shorter by a common, small share.
    radius_s_ = abscissas(line.points);
    const double share = length_ / radius_s_.back();
    for (double& s : radius_s_) s *= share;
    radius_ = line.radius;
  }
}

std::size_t AxisCurve::interval(double s_mm, double& t) const {
  const double x = std::clamp(s_mm, 0.0, length_) / step_;
  const std::size_t i = std::min(nodes_.size() - 2, static_cast<std::size_t>(x));
  t = std::min(1.0, x - static_cast<double>(i));
  return i;
}

Vec3 AxisCurve::point(double s_mm) const {
  double t = 0.0;
  const std::size_t i = interval(s_mm, t);
  const Node &a = nodes_[i], &b = nodes_[i + 1];
  const double u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * a.point + t * t * (3.0 - 2.0 * t) * b.point +
         step_ * t * u * (u * a.tangent - t * b.tangent);
}

Vec3 AxisCurve::derivative(std::size_t i, double t) const {
  const Node &a = nodes_[i], &b = nodes_[i + 1];
  const double u = 1.0 - t;
  return (6.0 * t * u / step_) * (b.point - a.point) + u * (1.0 - 3.0 * t) * a.tangent +
         t * (3.0 * t - 2.0) * b.tangent;
}

Frame AxisCurve::frame(double s_mm) const {
  double t = 0.0;
  const std::size_t i = interval(s_mm, t);
  const Vec3 tangent = derivative(i, t).normalized();
  const Vec3 normal = (1.0 - t) * nodes_[i].normal + t * nodes_[i + 1].normal;
  const Vec3 across = (normal - normal.dot(tangent) * tangent).normalized();
  return {tangent, across, tangent.cross(across)};
}

double AxisCurve::radius(double s_mm) const {
  if (radius_.empty()) return 0.0;
  const double s = std::clamp(s_mm, 0.0, length_);
  const auto upper = std::upper_bound(radius_s_.begin() + 1, radius_s_.end() - 1, s);
  const auto i = static_cast<std::size_t>(upper - radius_s_.begin());
  const double h = radius_s_[i] - radius_s_[i - 1];
  const double t = h > 0.0 ? std::clamp((s - radius_s_[i - 1]) / h, 0.0, 1.0) : 0.0;
  return (1.0 - t) * radius_[i - 1] + t * radius_[i];
}

Vec3 AxisCurve::curvature_vector(double s_mm) const {
  // Over two table steps: the pieces' own second derivatives jump at the nodes.
  const double from = std::max(0.0, s_mm - step_), to = std::min(length_, s_mm + step_);
  const Vec3 change = (frame(to).tangent - frame(from).tangent) / (to - from);
  const Vec3 tangent = frame(s_mm).tangent;
  return change - change.dot(tangent) * tangent;
}

Vec3 AxisCurve::place(double s_mm, double theta, double rho_mm) const {
  return point(s_mm) + rho_mm * radial_direction(frame(s_mm), theta);
}

AxisFoot AxisCurve::foot_at(double s_mm, const Vec3& place, bool past_end) const {
  AxisFoot foot;
  foot.s_mm = s_mm;
  const Vec3 offset = place - point(s_mm);
  foot.theta = angle_of(frame(s_mm), offset);
  foot.rho_mm = offset.norm();
  foot.past_end = past_end;
  return foot;
}

void AxisCurve::add_feet(std::size_t first, std::size_t last, const Vec3& place, double reach_mm,
                         std::vector<AxisFoot>& out) const {
  // The distance falls where the place lies ahead (positive) and grows where it lies behind.
  const auto ahead = [&](std::size_t i) { return (place - nodes_[i].point).dot(nodes_[i].tangent); };
  double before = ahead(first);
  for (std::size_t i = first; i < last; ++i) {
    const double after = ahead(i + 1);
    if (before > 0.0 && after <= 0.0) {
      const double t = zero_crossing([&](double at) {
        return (place - point(step_ * (static_cast<double>(i) + at))).dot(derivative(i, at));
      });
      const AxisFoot foot = foot_at(step_ * (static_cast<double>(i) + t), place, false);
      if (foot.rho_mm <= reach_mm) out.push_back(foot);
    }
    before = after;
  }
}

std::vector<AxisFoot> AxisCurve::feet(const Vec3& place, double reach_mm) const {
  if (!place.allFinite()) throw InvalidInput("a place that is not finite has no foot on an axis");
  std::vector<AxisFoot> found;
  const std::size_t intervals = nodes_.size() - 1;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if ((place - blocks_[b].centre).norm() - blocks_[b].radius > reach_mm) continue;
    const std::size_t first = b * block_intervals;
    add_feet(first, std::min(intervals, first + block_intervals), place, reach_mm, found);
  }
  const double at_start = (place - nodes_.front().point).dot(nodes_.front().tangent);
  const double at_end = (place - nodes_.back().point).dot(nodes_.back().tangent);
  if (at_start <= 0.0) found.push_back(foot_at(0.0, place, at_start < 0.0));
  if (at_end > 0.0) found.push_back(foot_at(length_, place, true));
  std::erase_if(found, [&](const AxisFoot& foot) { return foot.rho_mm > reach_mm; });
  std::sort(found.begin(), found.end(), [](const AxisFoot& a, const AxisFoot& b) {
    return a.rho_mm != b.rho_mm ? a.rho_mm < b.rho_mm : a.s_mm < b.s_mm;
  });
  return found;
}

AxisFoot AxisCurve::nearest_foot(const Vec3& place) const {
  // A ball that is sure to hold the nearest point bounds the search.
  double bound = std::numeric_limits<double>::infinity();
  for (const Block& block : blocks_) bound = std::min(bound, (place - block.centre).norm());
  const std::vector<AxisFoot> found = feet(place, bound + 1e-9);
  if (!found.empty()) return found.front();
  throw NumericalError("no foot on the axis was found for a place " + std::to_string(bound) + " mm from it");
}

std::optional<AxisFoot> AxisCurve::foot_near(const Vec3& place, double s_mm, double window_mm) const {
  std::optional<AxisFoot> best;
  for (const AxisFoot& foot : feet(place, std::numeric_limits<double>::max())) {
    const double gap = std::abs(foot.s_mm - s_mm);
    if (gap <= window_mm && (!best || gap < std::abs(best->s_mm - s_mm))) best = foot;
  }
  return best;
}

Centerline AxisCurve::sampled(double step_mm) const {
  if (!(step_mm > 0.0)) throw InvalidInput("an axis is sampled at positive steps");
  Centerline line;
  const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(length_ / step_mm)));
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double s = length_ * static_cast<double>(i) / static_cast<double>(pieces);
    line.points.push_back(point(s));
    if (!radius_.empty()) line.radius.push_back(radius(s));
    line.abscissa.push_back(s);
    line.frames.push_back(frame(s));
  }
  return line;
}

}  // namespace ostia::geometry
