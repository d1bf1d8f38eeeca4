#pragma once
/// \file The rigid motion between paired points.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::geometry {

/// x -> rotation x + shift.
struct RigidFit {
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  ///< mm
  Vec3 operator()(const Vec3& point) const { return rotation * point + shift; }
};

/// The motion of least mean square distance between `from` as it is carried and `to` (Kabsch, Acta Cryst.
/// A32:922-923, 1976; proper rotations as Umeyama, IEEE Trans. Pattern Anal. Mach. Intell. 13:376-380, 1991,
/// has them). Where the points leave a rotation open (fewer than three, or on a line) it is one of those.
/// Throws InvalidInput for no points, other lengths or points that are not finite.
RigidFit rigid_fit(const std::vector<Vec3>& from, const std::vector<Vec3>& to);

}  // namespace ostia::geometry
