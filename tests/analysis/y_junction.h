#pragma once
/// \file A straight main vessel that a side branch leaves at 45 degrees, with walls of known narrowing.

#include "walls.h"

#include <cstdint>
#include <optional>

namespace ostia::analysis::testing {

/// A smooth narrowing of the radius by `share` at `centre_mm`.
struct Narrowing {
  double centre_mm = 0.0, length_mm = 5.0, share = 0.0;
  double factor(double s) const { return 1.0 - share * bump(s, centre_mm, length_mm); }
};

struct YJunction {
  double joint_mm = 20.0, main_length_mm = 50.0, side_length_mm = 30.0;
  double main_radius_mm = 2.0, side_radius_mm = 1.2;
  std::optional<Narrowing> main, distal, side;  ///< abscissas from the main vessel's root
  std::int32_t main_id = 7, side_id = 8;

  double ostium_mm() const { return joint_mm + main_radius_mm * std::numbers::sqrt2; }

  geometry::VesselTree tree() const {
    const Vec3 joint(0, 0, joint_mm), out = Vec3(1, 0, 1).normalized();
    const auto line = [](const Vec3& from, const Vec3& to, double radius) {
      geometry::Centerline axis;
      const int pieces = static_cast<int>(std::lround((to - from).norm() / 0.5));
      for (int i = 0; i <= pieces; ++i) {
        axis.points.push_back(from + (to - from) * i / pieces);
        axis.radius.push_back(radius);
      }
      geometry::complete(axis);
      return axis;
    };
    geometry::VesselTree made;
    const Vec3 end(0, 0, main_length_mm), tip = joint + side_length_mm * out;
    made.nodes = {{1, Vec3::Zero()}, {2, joint}, {3, end}, {4, tip}};
    made.segments = {{10, 1, 2, line(Vec3::Zero(), joint, main_radius_mm)},
                     {11, 2, 3, line(joint, end, main_radius_mm)},
                     {12, 2, 4, line(joint, tip, side_radius_mm)}};
    made.vessels = {{main_id, "LAD", {10, 11}}, {side_id, "D1", {10, 12}}};
    return made;
  }
  Solved solved() const {
    const auto wall = [](double radius, std::optional<Narrowing> a, std::optional<Narrowing> b = {}) {
      return [=](double s, double) { return radius * (a ? a->factor(s) : 1.0) * (b ? b->factor(s) : 1.0); };
    };
    return Solved(lumen::model_of_walls(
        tree(), {wall(main_radius_mm, main, distal), wall(side_radius_mm, side)}, {.spacing_mm = 0.6}));
  }
};

}  // namespace ostia::analysis::testing
