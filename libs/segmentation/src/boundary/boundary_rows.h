#pragma once
/// \file Closed lines r(theta) about a moved centre, and surfaces held within slope limits.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::segmentation {

using geometry::Vec2;

/// The centroid of what r(theta_j), j evenly around, encloses.
Vec2 centroid_of(const double* radius_mm, int around);

/// The same line seen from another centre: its distance along each direction and which of the old rays
/// (fractional index) points there. Where the new centre lies outside the line, `outside_mm`.
struct SeenLine {
  std::vector<double> radius_mm, index;
  bool inside = true;
};
SeenLine seen_from(const double* radius_mm, int around, const Vec2& centre, double outside_mm);

/// The largest surface below the given one that keeps |dr| <= along_mm between rows and
/// |dr| <= around * (the smaller r) between neighbours of a row.
void hold_limits(std::vector<double>& radius_mm, int rows, int around_count, double along_mm, double around);

}  // namespace ostia::segmentation
