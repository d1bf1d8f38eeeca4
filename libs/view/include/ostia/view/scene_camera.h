#pragma once
/// \file Where one looks at the tree from: poses of a camera with parallel rays, as plain values.

#include "ostia/geometry/carm_angles.h"
#include "ostia/geometry/vec.h"

#include <span>

namespace ostia::view {

using geometry::Vec3;

/// A camera with parallel rays. LPS, mm.
struct CameraPose {
  Vec3 target = Vec3::Zero();     ///< what stands in the middle of the picture
  Vec3 towards = -Vec3::UnitY();  ///< unit, from the target to the viewer
  Vec3 up = Vec3::UnitZ();        ///< unit, normal to `towards`
  double half_height_mm = 50.0;   ///< of the picture; > 0

  Vec3 right() const { return up.cross(towards); }  ///< unit, to the right of the picture
};
/// Throws InvalidInput where a member is not finite, `towards` and `up` are not orthonormal to 1e-6, or the
/// half height is not within [1e-3, 1e5] mm.
void validate(const CameraPose& pose);

enum class ViewFrom { anterior, posterior, left, right, cranial, caudal };

using geometry::CarmAngles;

// Poses that look at a target with the half height given; the head is up (in cranial and caudal views the
// chest, anterior, is up).
CameraPose pose_from(ViewFrom from, const Vec3& target, double half_height_mm);
CameraPose pose_of_carm(const CarmAngles& angles, const Vec3& target, double half_height_mm);
CarmAngles carm_angles(const CameraPose& pose);  ///< of any pose, whichever way is up

/// Looks at a curve from the side that shows the most of its course: along the direction of its least spread,
/// from the patient's front where there is a choice, the head up where that is across the view. All of it is
/// in the picture. Throws InvalidInput for fewer than two points or points that are not finite.
CameraPose pose_broadside(std::span<const Vec3> curve, double aspect);

/// The same direction, with all points in the picture of `aspect` = width / height, and 8 % to spare. Throws
/// InvalidInput for no points.
CameraPose fitted(const CameraPose& pose, std::span<const Vec3> points, double aspect);

// What a drag of the mouse does, in pixels to the right and up, in a picture so many pixels high.
/// Turns the patient about the target as a ball under the pointer: a drag over the picture's height is 180
/// degrees.
CameraPose rotated(const CameraPose& pose, double right_px, double up_px, int height_px);
/// What was under the pointer stays under it.
CameraPose panned(const CameraPose& pose, double right_px, double up_px, int height_px);
/// A factor above 1 makes things larger; the world point `fixed` stays where it is in the picture.
CameraPose zoomed(const CameraPose& pose, double factor, const Vec3& fixed);
CameraPose rolled(const CameraPose& pose, double degrees);  ///< the picture, counter-clockwise

/// Between two poses, for a smooth change: `t` in [0, 1], clamped. The shortest turn, the half height in
/// equal ratios.
CameraPose blended(const CameraPose& from, const CameraPose& to, double t);

}  // namespace ostia::view
