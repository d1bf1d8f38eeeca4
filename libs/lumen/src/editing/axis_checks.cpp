#include "wall/sampling.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::lumen {
namespace {

using core::fixed_text;
using std::numbers::pi;
/// A turn of more than this within two thirds of the radius is a kink.
constexpr double kink_rad = pi / 3.0;
/// An axis that comes back to itself nearer than this share of its radius makes a loop.
constexpr double loop_share = 0.5;
constexpr double check_step_mm = 0.2;
constexpr double evened_mm = 0.4, table_step_mm = 0.1;

bool owns(const geometry::VesselTree& tree, const geometry::Vessel& vessel, std::int32_t segment) {
  for (const geometry::Vessel& v : tree.vessels) {
    if (std::find(v.segments.begin(), v.segments.end(), segment) != v.segments.end())
      return v.id == vessel.id;
  }
  return false;
}

/// Points and radii of the segments that are the vessel's own.
geometry::Centerline own_part(const geometry::VesselTree& tree, const geometry::Vessel& vessel) {
  geometry::Vessel own = vessel;
  std::erase_if(own.segments, [&](std::int32_t id) { return !owns(tree, vessel, id); });
  if (own.segments.empty())
    throw InvalidInput(
        vessel_label(vessel) +
        " has no segment of its own: another vessel runs the whole way; leave one of them out");
  return geometry::vessel_axis(tree, own);
}

void check_points(const geometry::VesselTree& tree, const geometry::Vessel& vessel) {
  const geometry::Centerline line = geometry::vessel_axis(tree, vessel);
  if (line.size() < 3)
    throw InvalidInput(vessel_label(vessel) + " has an axis of " + std::to_string(line.size()) +
                       " points; too few to tell how it runs, give at least three");
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!(line.radius[i] > 0.0) || !std::isfinite(line.radius[i]))
      throw InvalidInput(vessel_label(vessel) + " has a radius of " + fixed_text(line.radius[i], 2) +
                         " mm at " + fixed_text(line.abscissa[i], 2) + " mm; radii must be positive");
  }
}

/// Abscissas where one segment of the vessel ends and the next begins.
std::vector<double> joints_of(const geometry::VesselTree& tree, const geometry::Vessel& vessel) {
  std::vector<double> joints;
  double s = 0.0;
  for (std::size_t i = 0; i + 1 < vessel.segments.size(); ++i) {
    s += geometry::segment(tree, vessel.segments[i]).axis.abscissa.back();
    joints.push_back(s);
  }
  return joints;
}

/// A branch may leave its parent at any angle: the joint itself lies inside the parent's lumen.
void check_kink(const AxisCurve& axis, const std::vector<double>& joints, const std::string& name) {
  for (double s = 0.0; s <= axis.length(); s += check_step_mm) {
    const double half = axis.radius(s) / 3.0;
    const auto near_joint = [&](double joint) { return std::abs(joint - s) < 3.0 * half; };
    if (std::any_of(joints.begin(), joints.end(), near_joint)) continue;
    const double low = std::max(0.0, s - half), high = std::min(axis.length(), s + half);
    const double turn =
        std::acos(std::clamp(axis.frame(low).tangent.dot(axis.frame(high).tangent), -1.0, 1.0));
    if (turn > kink_rad)
      throw InvalidInput(name + " has a kink at " + fixed_text(s, 2) + " mm: its axis turns by " +
                         std::to_string(std::lround(turn * 180.0 / pi)) + " degrees within " +
                         fixed_text(high - low, 2) + " mm; smooth the axis there");
  }
}

void check_loop(const AxisCurve& axis, const std::string& name) {
  std::vector<Vec3> points;
  std::vector<double> radius;
  const auto count = static_cast<std::size_t>(std::ceil(axis.length() / check_step_mm));
  const double step = axis.length() / static_cast<double>(count);
  for (std::size_t i = 0; i <= count; ++i) {
    points.push_back(axis.point(step * static_cast<double>(i)));
    radius.push_back(axis.radius(step * static_cast<double>(i)));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto j = i + static_cast<std::size_t>(std::ceil(2.0 * radius[i] / step)) + 1;
    while (j < points.size()) {
      const double gap = (points[j] - points[i]).norm();
      const double least = loop_share * std::min(radius[i], radius[j]);
      if (gap < least)
        throw InvalidInput(name + " has a loop: its axis at " + fixed_text(step * static_cast<double>(j), 2) +
                           " mm comes back to where it was at " +
                           fixed_text(step * static_cast<double>(i), 2) + " mm, " + fixed_text(gap, 2) +
                           " mm away; take the loop out of the axis");
      j += std::max<std::size_t>(1, static_cast<std::size_t>((gap - least) / step));
    }
  }
}

}  // namespace

std::string vessel_label(const geometry::Vessel& vessel) {
  return "vessel " + std::to_string(vessel.id) + " (" + vessel.name + ")";
}

EvenTable own_radius(const geometry::VesselTree& tree, const geometry::Vessel& vessel, const AxisCurve& axis,
                     double own_from_mm) {
  const geometry::Centerline own = own_part(tree, vessel);
  const double length = axis.length() - own_from_mm;
  const double share = length / own.abscissa.back();
  const auto radius = [&](double along) {
    const auto upper = std::upper_bound(own.abscissa.begin() + 1, own.abscissa.end() - 1, along / share);
    const auto i = static_cast<std::size_t>(upper - own.abscissa.begin());
    const double t = (along / share - own.abscissa[i - 1]) / (own.abscissa[i] - own.abscissa[i - 1]);
    return own.radius[i - 1] + std::clamp(t, 0.0, 1.0) * (own.radius[i] - own.radius[i - 1]);
  };
  const auto cells = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(length / table_step_mm)));
  const double step = length / static_cast<double>(cells);
  std::vector<double> values;
  for (std::size_t i = 0; i <= cells; ++i) {
    const double at = step * static_cast<double>(i);
    const double width = std::min({evened_mm, at, length - at});  // symmetric: straight tapers stay
    double sum = radius(at), weights = 1.0;
    for (int k = 1; k < 8; ++k) {
      const double weight = 1.0 - k / 8.0, aside = width * k / 8.0;
      sum += weight * (radius(at - aside) + radius(at + aside));
      weights += 2.0 * weight;
    }
    values.push_back(sum / weights);
  }
  return {own_from_mm, step, std::move(values)};
}

std::shared_ptr<const AxisCurve> checked_axis(const geometry::VesselTree& tree,
                                              const geometry::Vessel& vessel) {
  const std::string name = vessel_label(vessel);
  check_points(tree, vessel);
  const geometry::Centerline own = own_part(tree, vessel);
  auto axis = std::make_shared<const AxisCurve>(geometry::vessel_axis(tree, vessel));
  const double least = *std::min_element(own.radius.begin(), own.radius.end());
  if (own.abscissa.back() < least)
    throw InvalidInput(name + " is " + fixed_text(own.abscissa.back(), 2) + " mm long from " +
                       fixed_text(axis->length() - own.abscissa.back(), 2) +
                       " mm on, shorter than its radius of " + fixed_text(least, 2) +
                       " mm; leave it out or extend its axis");
  check_kink(*axis, joints_of(tree, vessel), name);
  check_loop(*axis, name);
  return axis;
}

}  // namespace ostia::lumen
