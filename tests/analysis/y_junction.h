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

}  // namespace ostia::analysis::testing
