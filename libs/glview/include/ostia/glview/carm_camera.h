#pragma once
/// \file Cameras that are told as a C-arm's angles. See docs/reference/live.md.

#include "ostia/geometry/carm_words.h"

#include <Eigen/Core>

#include <vector>

namespace ostia::glview {

using geometry::carm_angles;
using geometry::CarmAngles;
using geometry::text_of;
using geometry::Vec2;
using geometry::Vec3;

enum class Projection {
  lit,    ///< seen from the receptor's side, in perspective
  x_ray,  ///< projected from the X-ray source on the other side, as on the monitor: what is nearer to the
          ///< source is larger; the patient's left is on the picture's right, as in `lit`
};

/// mm. The isocentre is in the middle of the picture, where both projections have the same scale.
struct Camera {
  CarmAngles angles{};
  Vec3 isocentre = Vec3::Zero();
  double half_height_mm = 60.0;  ///< of the picture, at the isocentre
  double eye_mm = 350.0;         ///< from the isocentre to the eye, in `lit`
  double source_mm = 750.0;      ///< from the isocentre to the source, in `x_ray`
  Projection projection = Projection::lit;

  Vec3 towards() const;  ///< unit, from the isocentre to the receptor
  Vec3 up() const;       ///< unit; the head is up, as far as it is across the view
  Vec3 right() const;    ///< unit, to the right of the picture
  Vec3 centre_of_projection() const;
  /// World to clip space, for a picture of `aspect` = width / height. In `x_ray` it mirrors: what is
  /// counter-clockwise from outside is clockwise seen from the source, and the other way round in the
  /// picture.
  Eigen::Matrix4f clip_of_world(double aspect) const;
  /// Where a point is in a picture, px from its upper left corner.
  Vec2 project(const Vec3& point, double width_px, double height_px) const;
};

/// Looks at the middle of all points from these angles, with 8 % to spare.
Camera camera_on(const std::vector<Vec3>& points, const CarmAngles& angles, double aspect);

// What a drag of the mouse does, in pixels to the right and up, in a picture so many pixels high.
/// As if the patient were turned by hand: half a turn over the picture's height. Cranial angles end at 90.
Camera turned(const Camera& camera, double right_px, double up_px, double height_px);
Camera shifted(const Camera& camera, double right_px, double up_px, double height_px);
Camera enlarged(const Camera& camera, double factor);  ///< half heights from 1 to 1000 mm

}  // namespace ostia::glview
