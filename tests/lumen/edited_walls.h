#pragma once
/// \file Models of analytic tubes, and lines drawn on other analytic walls about the same axes, for tests.

#include "ostia/lumen/edit.h"
#include "ostia/lumen/start_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

namespace ostia::lumen::testing {

using geometry::AxisCurve;

using std::numbers::pi;
inline constexpr std::int32_t main_vessel = 4, side_vessel = 7;

using WallRadius = std::function<double(double s, double theta)>;

inline geometry::Centerline line_of(const std::function<Vec3(double)>& curve, double to, double step,
                                    double radius_mm) {
  geometry::Centerline line;
  const int count = static_cast<int>(std::lround(to / step));
  for (int i = 0; i <= count; ++i) {
    line.points.push_back(curve(to * i / count));
    line.radius.push_back(radius_mm);
  }
  geometry::complete(line);
  return line;
}

inline LumenModel model_of_line(const geometry::Centerline& line) {
  geometry::VesselTree tree;
  tree.nodes = {{1, line.points.front()}, {2, line.points.back()}};
  tree.segments = {{3, 1, 2, line}};
  tree.vessels = {{main_vessel, "LAD", {3}}};
  return model_of_tubes(tree);
}

inline LumenModel straight_model(double length_mm, double radius_mm) {
  return model_of_line(line_of([](double s) { return Vec3(0.0, 0.0, s); }, length_mm, 0.5, radius_mm));
}

/// A helix, curvature radius some 22 mm.
inline LumenModel bent_model(double length_mm, double radius_mm) {
  const double speed = std::hypot(20.0, 6.0);
  const auto helix = [=](double s) {
    const double a = s / speed;
    return Vec3(20.0 * std::cos(a), 20.0 * std::sin(a), 6.0 * a);
  };
  return model_of_line(line_of(helix, length_mm, 0.5, radius_mm));
}

/// A straight piece, half a ring of `ring_mm`, and a straight piece back, like a hairpin in the xz plane.
inline LumenModel hairpin_model(double straight_mm, double ring_mm, double radius_mm) {
  const double bend = pi * ring_mm;
  const auto curve = [=](double s) {
    if (s < straight_mm) return Vec3(0.0, 0.0, s);
    if (s > straight_mm + bend) return Vec3(2.0 * ring_mm, 0.0, 2.0 * straight_mm + bend - s);
    const double a = (s - straight_mm) / ring_mm;
    return Vec3(ring_mm * (1.0 - std::cos(a)), 0.0, straight_mm + ring_mm * std::sin(a));
  };
  return model_of_line(line_of(curve, 2.0 * straight_mm + bend, 0.25, radius_mm));
}

/// A main vessel along +z of 30 mm and a side branch that leaves it at 12 mm towards +x.
inline LumenModel forked_model() {
  const auto main = [](double z) { return Vec3(0.0, 0.0, z); };
  geometry::Centerline first = line_of(main, 12.0, 0.5, 1.8);
  geometry::Centerline second = line_of([&](double s) { return main(12.0 + s); }, 18.0, 0.5, 1.6);
  // Leaves along the main vessel and bends away to 60 degrees on an arc of 8 mm.
  const auto branch = [](double s) {
    const double most = pi / 3.0, a = std::min(s / 8.0, most), rest = std::max(0.0, s - 8.0 * most);
    return Vec3(8.0 * (1.0 - std::cos(a)) + rest * std::sin(most), 0.0,
                12.0 + 8.0 * std::sin(a) + rest * std::cos(most));
  };
  geometry::Centerline third = line_of(branch, 18.0, 0.25, 1.2);
  geometry::VesselTree tree;
  tree.nodes = {{1, first.points.front()},
                {2, first.points.back()},
                {3, second.points.back()},
                {4, third.points.back()}};
  tree.segments = {{1, 1, 2, first}, {2, 2, 3, second}, {3, 2, 4, third}};
  tree.vessels = {{main_vessel, "LAD", {1, 2}}, {side_vessel, "D1", {1, 3}}};
  return model_of_tubes(tree);
}

inline const geometry::AxisCurve& axis_of(const LumenModel& model, std::int32_t id = main_vessel) {
  return *vessel(model, id).axis;
}

/// A stroke at one angle along a wall given about the axis.
inline CprStroke stroke_along(const geometry::AxisCurve& axis, const WallRadius& wall, double theta,
                              double from_mm, double to_mm, int count) {
  CprStroke stroke;
  stroke.vessel = main_vessel;
  stroke.theta_deg = theta * 180.0 / pi;
  for (int i = 0; i < count; ++i) {
    const double s = from_mm + (to_mm - from_mm) * i / (count - 1);
    stroke.points.push_back(axis.place(s, theta, wall(s, theta)));
  }
  return stroke;
}

inline SectionContour contour_around(const geometry::AxisCurve& axis, const WallRadius& wall, double s_mm,
                                     int count) {
  SectionContour contour;
  contour.vessel = main_vessel;
  contour.s_mm = s_mm;
  for (int i = 0; i < count; ++i) {
    const double theta = 2.0 * pi * i / count;
    contour.points.push_back(axis.place(s_mm, theta, wall(s_mm, theta)));
  }
  return contour;
}

/// Where a ray from the axis first leaves the lumen; 0 where the axis is outside, 20 where it never does.
inline double radius_on_ray(const ScalarField& field, const geometry::AxisCurve& axis, double s,
                            double theta) {
  const auto at = [&](double rho) { return field.value(axis.place(s, theta, rho)); };
  if (at(0.0) >= 0.0) return 0.0;
  for (double rho = 0.1; rho < 20.0; rho += 0.1) {
    if (at(rho) < 0.0) continue;
    double low = rho - 0.1, high = rho;
    for (int i = 0; i < 40; ++i) (at(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }
  return 20.0;
}

inline std::set<std::int64_t> ids_of(const std::vector<SurfaceSample>& samples) {
  std::set<std::int64_t> ids;
  for (const SurfaceSample& sample : samples) ids.insert(sample.id);
  return ids;
}

/// Positions and normals without ids, in an order of their own.
inline std::vector<std::array<double, 6>> geometry_of(const VesselLumen& vessel) {
  std::vector<std::array<double, 6>> all;
  for (const SurfaceSample& s : vessel.samples)
    all.push_back({s.position.x(), s.position.y(), s.position.z(), s.normal.x(), s.normal.y(), s.normal.z()});
  std::sort(all.begin(), all.end());
  return all;
}

/// The largest difference between two such lists; infinite where they differ in length.
inline double difference(const std::vector<std::array<double, 6>>& a,
                         const std::vector<std::array<double, 6>>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < 6; ++k) most = std::max(most, std::abs(a[i][k] - b[i][k]));
  return most;
}

/// What an InvalidInput says; empty where nothing is thrown.
inline std::string refusal(const LumenModel& model, const Edit& edit) {
  try {
    apply(model, edit);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace ostia::lumen::testing
