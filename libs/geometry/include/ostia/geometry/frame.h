#pragma once
/// \file Rotation-minimising frames along curves.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::geometry {

/// A right-handed orthonormal frame: binormal = tangent x normal.
struct Frame {
  Vec3 tangent = Vec3::UnitZ();
  Vec3 normal = Vec3::UnitX();
  Vec3 binormal = Vec3::UnitY();
};

/// The unit direction across the vessel at an angle: theta = 0 is the frame's normal, and theta grows
/// counter-clockwise as seen by one who looks distally (along the tangent), so that 90 degrees is
/// normal x tangent. Contours, radial profiles and the planes of reformations all mean this angle.
Vec3 radial_direction(const Frame& frame, double theta);
/// The angle of a vector's part across the vessel, in (-pi, pi]; 0 for a vector along the tangent.
double angle_of(const Frame& frame, const Vec3& direction);
/// The frame between two neighbours of a rotation-minimising sequence, at `t` in [0, 1]; orthonormal.
Frame interpolated(const Frame& a, const Frame& b, double t);

/// The first normal of a root: the projection of +z on the normal plane, of +x where the axis runs along z
/// (|tangent . z| > 0.999).
Vec3 initial_normal(const Vec3& tangent);

/// Unit tangents of a polyline by second-order differences in arc length; one-sided at the ends.
std::vector<Vec3> tangents(const std::vector<Vec3>& points);

/// Rotation-minimising frames by double reflection (Wang, Juettler, Zheng, Liu 2008), fourth order in the
/// step. `tangents` are unit vectors, one a point; `first_normal` is made normal to the first tangent. Throws
/// InvalidInput for fewer than two points or coincident neighbours.
std::vector<Frame> rotation_minimising_frames(const std::vector<Vec3>& points,
                                              const std::vector<Vec3>& tangents, const Vec3& first_normal);
/// The same with tangents by differences and the root's first normal.
std::vector<Frame> rotation_minimising_frames(const std::vector<Vec3>& points);

}  // namespace ostia::geometry
