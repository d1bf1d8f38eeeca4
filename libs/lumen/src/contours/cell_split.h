#pragma once
/// \file How the zeros around a cell are joined by lines inside it.

#include "ostia/lumen/contour_lines.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace ostia::lumen {

/// A zero of f in the picture. Where a view jumps there is a change of sign without a zero: not exact.
struct ContourPoint {
  Vec2 px = Vec2::Zero();
  Vec3 place = Vec3::Zero();
  bool exact = true;
};

/// Corners and edges go around clockwise as seen in the picture (y down), from the upper left corner.
struct CellOutline {
  std::array<Vec2, 4> corner;
  std::array<double, 4> value{};
  std::array<std::vector<int>, 4> zeros;  ///< of the edge from each corner to the next, in this direction
};

struct CellLine {
  std::vector<int> zeros;  ///< begins and ends on the outline; closed lines end with their first zero
};

/// What the splitting of a cell asks for.
struct CellField {
  std::function<double(const Vec2& px)> value;
  /// Appends the zeros between two places, in this direction, to `points` and tells their numbers.
  std::function<std::vector<int>(const Vec2& p, double fp, const Vec2& q, double fq)> zeros_between;
  std::function<Vec2(int)> zero_px;
};

/// Joins the zeros around a cell so that the lumen is to the left of each line. Two zeros are joined; where
/// there are more, or where `seed` (with its value) says that a lumen or gap is hidden inside, the cell is
/// split into four until there are not.
std::vector<CellLine> lines_in_cell(const CellOutline& cell, const CellField& field,
                                    const std::optional<std::pair<Vec2, double>>& seed);

}  // namespace ostia::lumen
