#pragma once
/// \file A straight main vessel that a side branch leaves at 45 degrees, with walls of known narrowing.

#include "walls.h"

#include <optional>

namespace ostia::analysis::testing {

/// A smooth narrowing of the radius by `share` at `centre_mm`.
struct Narrowing {
  double centre_mm = 0.0, length_mm = 5.0, share = 0.0;
  double factor(double s) const { return 1.0 - share * bump(s, centre_mm, length_mm); }
};

struct YJunction : lumen::testing::YTree {
  std::optional<Narrowing> main, distal, side;  ///< abscissas from the main vessel's root

  double ostium_mm() const { return joint_mm + main_radius_mm * std::numbers::sqrt2; }
  Solved solved() const {
    const auto wall = [](double radius, std::optional<Narrowing> a, std::optional<Narrowing> b = {}) {
      return [=](double s, double) { return radius * (a ? a->factor(s) : 1.0) * (b ? b->factor(s) : 1.0); };
    };
    return Solved(lumen::model_of_walls(
        tree(), {wall(main_radius_mm, main, distal), wall(side_radius_mm, side)}, {.spacing_mm = 0.6}));
  }
};

/// The Y with a branch of the side branch (LAD, LCX, OM2): it leaves `second_mm` behind the first joint at 45
/// degrees, out of the first two's plane.
struct TwiceBranched : lumen::testing::YTree {
  double second_mm = 16.0, second_length_mm = 20.0, second_radius_mm = 0.9;
  std::int32_t second_id = 9;

  TwiceBranched() {
    side_name = "LCX";
    side_radius_mm = 1.5;
    side_length_mm = 40.0;
  }
  double second_joint_mm() const { return joint_mm + second_mm; }
  geometry::VesselTree tree() const {
    geometry::VesselTree made = YTree::tree();
    const geometry::Centerline whole = made.segments[2].axis;
    const auto at = static_cast<std::size_t>(
        std::lround(second_mm / side_length_mm * static_cast<double>(whole.points.size() - 1)));
    const Vec3 from = whole.points[at];
    const Vec3 way = (Vec3(1, 0, 1).normalized() + Vec3::UnitY()).normalized();
    geometry::Centerline line;
    for (double s = 0.0; s <= second_length_mm + 1e-9; s += 0.5) {
      line.points.push_back(from + s * way);
      line.radius.push_back(second_radius_mm);
    }
    geometry::complete(line);
    made.nodes.push_back({5, from});
    made.nodes.push_back({6, line.points.back()});
    made.segments[2] = {12, 2, 5, lumen::testing::part(whole, 0, at)};
    made.segments.push_back({13, 5, 4, lumen::testing::part(whole, at, whole.points.size() - 1)});
    made.segments.push_back({14, 5, 6, line});
    made.vessels = {
        {main_id, main_name, {10, 11}}, {side_id, side_name, {10, 12, 13}}, {second_id, "OM2", {10, 12, 14}}};
    return made;
  }
  Solved solved() const {
    const auto wall = [](double radius) { return [=](double, double) { return radius; }; };
    return Solved(lumen::model_of_walls(
        tree(), {wall(main_radius_mm), wall(side_radius_mm), wall(second_radius_mm)}, {.spacing_mm = 0.6}));
  }
};

}  // namespace ostia::analysis::testing
