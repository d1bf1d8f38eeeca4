#pragma once
/// \file Places along a centerline, what is known there, and steps of one inscribed sphere.

#include "ostia/geometry/centerline.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace ostia::geometry {

/// Between the points `piece` and `piece + 1` of a line, at `t` in [0, 1); the last point is {size - 1, 0}.
struct LinePlace {
  std::size_t piece = 0;
  double t = 0.0;
  bool operator==(const LinePlace&) const = default;
  auto operator<=>(const LinePlace&) const = default;
};

/// What is known at a line's points, linear between them.
template <class Value>
Value value_at(const std::vector<Value>& values, const LinePlace& place) {
  if (place.t == 0.0) return values[place.piece];
  return Value((1.0 - place.t) * values[place.piece] + place.t * values[place.piece + 1]);
}

/// The unit direction of the line's piece at a place; at the last point that of the last piece. Two points at
/// least.
Vec3 direction_at(const Centerline& line, const LinePlace& place);

/// The place at an abscissa (of `line.abscissa`), clamped to the ends.
LinePlace place_on_line(const Centerline& line, double abscissa_mm);

enum class LineWay { upstream, downstream };

/// One inscribed sphere away: from `from` on, the first place whose sphere holds the point at `from` no
/// longer, so that the sphere there touches it (L. Antiga, D. A. Steinman: Robust and objective decomposition
/// and mapping of bifurcating vessels. IEEE Trans. Med. Imaging 23:704-713, 2004). None where the line ends
/// before.
std::optional<LinePlace> touching_place(const Centerline& line, const LinePlace& from, LineWay way);

/// From each place to the next one sphere away, downstream: `from`, and on as far as the line goes.
std::vector<LinePlace> sphere_steps(const Centerline& line, const LinePlace& from);

}  // namespace ostia::geometry
