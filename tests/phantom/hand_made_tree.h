#pragma once
/// \file A small coronary tree of known shape: a straight main vessel with a branch, both tubes with an oval
/// lumen.

#include "ostia/phantom/coronary_tree.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::testing {

inline phantom::RadialProfile profile_of(double length_mm,
                                         const std::function<double(double s, double theta)>& radius) {
  constexpr double step_mm = 0.25;
  constexpr int around = 32;
  std::vector<double> radii;
  for (int row = 0; row <= static_cast<int>(length_mm / step_mm) + 1; ++row) {
    for (int k = 0; k < around; ++k)
      radii.push_back(radius(row * step_mm, 2.0 * std::numbers::pi * k / around));
  }
  return {step_mm, around, std::move(radii)};
}

inline phantom::CoronaryVessel tube(std::int32_t id, const std::string& name, const geometry::Vec3& from,
                                    const geometry::Vec3& to,
                                    const std::function<double(double s, double theta)>& radius) {
  phantom::CoronaryVessel vessel;
  vessel.id = id;
  vessel.name = name;
  const double length = (to - from).norm();
  const auto steps = static_cast<int>(std::round(length / 0.1));
  for (int i = 0; i <= steps; ++i) {
    vessel.axis.points.push_back(from + (to - from) * (static_cast<double>(i) / steps));
    vessel.axis.radius.push_back(radius(length * i / steps, 0.7));
  }
  geometry::complete(vessel.axis);
  vessel.lumen = profile_of(length, radius);
  vessel.wall = profile_of(length, [&](double s, double theta) { return 0.6 + radius(s, theta); });
  return vessel;
}

/// RCA of 120 mm along x from the origin, an acute marginal branch of 60 mm that leaves it at 50 mm across
/// the way, and a lesion on the RCA from 80 to 100 mm.
inline phantom::CoronaryTree hand_made_tree() {
  const auto oval = [](double s, double theta) {
    return 1.8 - 0.005 * s + 0.1 * std::cos(2.0 * theta) - 0.8 * std::exp(-std::pow((s - 90.0) / 5.0, 2.0));
  };
  const auto round = [](double, double) { return 1.0; };
  phantom::CoronaryTree tree;
  tree.vessels.push_back(tube(0, "RCA", {0, 0, 0}, {120, 0, 0}, oval));
  tree.vessels.push_back(tube(1, "AM", {50, 0, 0}, {80, 52, 0}, round));
  tree.vessels[1].parent = 0;
  tree.vessels[1].parent_s_mm = 50.0;
  tree.vessels[1].s_free_mm = 2.0;
  phantom::Stenosis stenosis;
  stenosis.s_from_mm = 80.0;
  stenosis.s_to_mm = 100.0;
  stenosis.s_throat_mm = 90.0;
  stenosis.diameter_stenosis = 0.5;
  tree.vessels[0].stenoses.push_back(stenosis);
  return tree;
}

}  // namespace ostia::testing
