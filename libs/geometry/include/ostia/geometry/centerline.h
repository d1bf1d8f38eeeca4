#pragma once
/// \file The axis of a vessel with what is known along it.

#include "ostia/geometry/frame.h"
#include "ostia/geometry/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::geometry {

/// Points from the proximal to the distal end; all arrays have the same length.
struct Centerline {
  std::vector<Vec3> points;      ///< mm, LPS
  std::vector<double> radius;    ///< maximal inscribed sphere, mm
  std::vector<double> abscissa;  ///< arc length from the first point, mm
  std::vector<Frame> frames;     ///< rotation-minimising
  std::size_t size() const { return points.size(); }
};

/// Fills abscissa and frames (from `first_normal`, or the root's convention when it is zero) from points.
void complete(Centerline& line, const Vec3& first_normal = Vec3::Zero());
/// Points, radius at equal steps no longer than `step_mm`, linear between points, ends kept; frames anew.
Centerline resample(const Centerline& line, double step_mm);

}  // namespace ostia::geometry
