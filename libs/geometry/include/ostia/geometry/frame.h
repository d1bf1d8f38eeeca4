#pragma once
/// \file Rotation-minimising frames along curves.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::geometry {

/// A right-handed orthonormal frame: binormal = tangent x normal. Looking distally (along the tangent) the
/// angle theta runs from the normal towards the binormal.
struct Frame {
  Vec3 tangent = Vec3::UnitZ();
  Vec3 normal = Vec3::UnitX();
  Vec3 binormal = Vec3::UnitY();
};

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
