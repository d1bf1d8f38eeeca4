#pragma once
/// \file Two motions of the same material points.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::evaluation {

/// Positions of points phase by phase; the same number of points in every phase, mm.
struct PointMotion {
  std::vector<double> percent;  ///< of the cycle, ascending, one a phase
  std::vector<std::vector<geometry::Vec3>> phases;
};

struct PhaseError {
  double percent = 0.0;
  double mean_mm = 0.0, rms_mm = 0.0, max_mm = 0.0;
};
struct MotionError {
  std::vector<PhaseError> phases;
  double mean_mm = 0.0, rms_mm = 0.0, max_mm = 0.0;
  double amplitude_mm = 0.0;  ///< of the reference: largest distance of a point from its first place
  double relative = 0.0;      ///< rms over that amplitude; NaN for a reference that does not move
};
/// Point by point, phase by phase. Throws InvalidInput for motions of other phases or numbers of points, or
/// places that are not finite.
MotionError compare_motion(const PointMotion& reference, const PointMotion& result);

}  // namespace ostia::evaluation
