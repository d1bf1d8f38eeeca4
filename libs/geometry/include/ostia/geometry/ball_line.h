#pragma once
/// \file The tube of a line of balls, as a function of space.

#include "ostia/geometry/line_place.h"

#include <limits>
#include <vector>

namespace ostia::geometry {

/// The balls whose centres and radii run evenly from each point of a line to the next. Built once, asked
/// often, from many threads.
class BallLine {
 public:
  /// Takes points and radii. Throws InvalidInput for fewer than two points or not a radius for each.
  explicit BallLine(const Centerline& line);

  struct Nearest {
    double value = std::numeric_limits<double>::infinity();  ///< |x - c|^2 - r^2, mm2; negative inside
    LinePlace place;                                         ///< of that ball's centre
  };
  /// The ball in which a place lies deepest (Antiga & Steinman 2004, eq. 1). The first of equals.
  Nearest nearest(const Vec3& x) const;
  double value(const Vec3& x) const { return nearest(x).value; }

 private:
  struct Block {  // a ball about the centres of consecutive pieces, and their largest radius
    Vec3 centre;
    double reach = 0.0, radius = 0.0;
  };
  void look_at(std::size_t piece, const Vec3& x, Nearest& best) const;
  std::vector<Vec3> points_;
  std::vector<double> radius_;
  std::vector<Block> blocks_;
};

}  // namespace ostia::geometry
