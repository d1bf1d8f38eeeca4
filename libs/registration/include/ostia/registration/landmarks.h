#pragma once
/// \file Two scans laid onto each other by points known in both.

#include "ostia/registration/transform.h"

#include <string>
#include <vector>

namespace ostia::registration {

/// One place in both scans: an ostium, a fork.
struct LandmarkPair {
  std::string name;
  Vec3 fixed_mm = Vec3::Zero(), moving_mm = Vec3::Zero();
};

struct LandmarkOptions {
  /// The worst pairs are left out as long as one of them is farther off than this and at least
  /// `least_share` of the pairs stay.
  double outlier_mm = 8.0;   ///< > 0
  double least_share = 0.6;  ///< (0, 1]
};
void validate(const LandmarkOptions& options);

struct LandmarkFit {
  Transform transform;               ///< rigid
  std::vector<double> residuals_mm;  ///< of each pair, those left out too
  std::vector<bool> used;
  double mean_mm = 0.0, max_mm = 0.0;  ///< over those used
};

/// The rotation and shift with the least sum of squared distances (Kabsch, Acta Cryst. A32:922-923, 1976),
/// with the worst pairs left out one by one. Throws InvalidInput for fewer than three pairs, points that are
/// not finite or lie on a line, and for pairs that a reflection brings together and a rotation does not: one
/// of the scans is mirrored.
LandmarkFit rigid_from_landmarks(const std::vector<LandmarkPair>& pairs, const LandmarkOptions& options = {});

}  // namespace ostia::registration
