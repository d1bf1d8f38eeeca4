#pragma once
/// \file A finite plane of pixels in world space: where a picture of the patient lies.

#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/centerline.h"
#include "ostia/geometry/vec.h"
#include "ostia/imaging/volume.h"

#include <string>

namespace ostia::reformat {

using geometry::Vec2;
using geometry::Vec3;

/// `width` x `height` square pixels. `origin` is the outer corner of the first pixel, so that pixel (i, j)'s
/// centre lies at origin + pixel_mm * ((i + 0.5) u + (j + 0.5) v). u runs to the right of the picture and v
/// down; both are unit vectors, normal to each other. u x v points away from the viewer.
struct Plane {
  Vec3 origin = Vec3::Zero();
  Vec3 u = Vec3::UnitX();
  Vec3 v = Vec3::UnitY();
  double pixel_mm = 1.0;  ///< > 0
  int width = 0;          ///< pixels, 1 to 32,767
  int height = 0;

  Vec3 normal() const { return u.cross(v); }
};

/// Throws InvalidInput where the plane has no pixels, a pixel has no size, or u and v are not orthonormal to
/// 1e-6.
void validate(const Plane& plane);

/// The world point at picture coordinates in pixels: (0, 0) is the first pixel's outer corner, (0.5, 0.5) its
/// centre.
Vec3 world(const Plane& plane, const Vec2& picture_px);
Vec3 centre(const Plane& plane);  ///< world(plane, (width / 2, height / 2))

/// Picture coordinates in pixels of a world point projected onto the plane, and how far in front of it the
/// point lies.
struct PlanePoint {
  Vec2 picture_px = Vec2::Zero();
  double distance_mm = 0.0;  ///< along u x v: positive away from the viewer
};
PlanePoint project(const Plane& plane, const Vec3& world_mm);

/// Planes through `position` that cover the whole image, seen as radiologists hang them. `pixel_mm` 0 takes
/// the image's finest spacing. Throws InvalidInput for an empty image, a position that is not finite or a
/// picture that is too large.
Plane axial_plane(const imaging::Geometry& image, const Vec3& position,
                  double pixel_mm = 0.0);  ///< right L, down P
Plane coronal_plane(const imaging::Geometry& image, const Vec3& position,
                    double pixel_mm = 0.0);  ///< right L, down I
Plane sagittal_plane(const imaging::Geometry& image, const Vec3& position,
                     double pixel_mm = 0.0);  ///< right P, down I

/// The square plane normal to a vessel's axis at an abscissa (clamped to the ends), centred on the axis, seen
/// looking distally: u is the frame's normal, v its binormal, both interpolated between the axis' points and
/// made orthonormal. Throws InvalidInput for an axis of fewer than two points or without abscissas and
/// frames.
Plane cross_section_plane(const geometry::Centerline& axis, double abscissa_mm, double side_mm,
                          double pixel_mm);
/// The same on an axis' curve: u is radial_direction(frame, 0) and v is radial_direction(frame, -90 degrees),
/// so that theta = 0 points to the right of the picture, theta = 90 degrees up, and angles grow
/// counter-clockwise. Throws InvalidInput for an abscissa that is not finite or a size that cannot be
/// pictured.
Plane cross_section_plane(const geometry::AxisCurve& axis, double abscissa_mm, double side_mm,
                          double pixel_mm);

/// Which way a direction points in the patient: the letters of its components above sin(`tolerance_deg`), the
/// largest first: "L", "R", "A", "P", "S", "I", or "LP" and the like for an oblique one.
std::string patient_letters(const Vec3& direction, double tolerance_deg = 20.0);

}  // namespace ostia::reformat
