#pragma once
/// \file The camera before a vessel tree of any size.

#include "ostia/geometry/segment_blocks.h"
#include "ostia/geometry/vec.h"

#include <optional>

namespace ostia::glview {

struct CameraRay {
  geometry::Vec3 origin = geometry::Vec3::Zero(), direction = geometry::Vec3::UnitX();
  double pixel = 0.0;  ///< height of a pixel for each mm along `direction`
};

/// In perspective, 30 degrees high, turning about a target. mm; places in the picture are px from its upper
/// left corner. No limits but those of floating point: a tree may be 10 um or a metre wide.
struct TreeCamera {
  static constexpr double half_height = 0.2679491924311227;    ///< tan(15 degrees)
  geometry::Vec3 right{1, 0, 0}, up{0, 0, 1}, back{0, -1, 0};  ///< unit; `back` from the target to the eye
  geometry::Vec3 target = geometry::Vec3::Zero();
  double distance_mm = 1.0;
  int width_px = 1, height_px = 1;

  geometry::Vec3 eye() const { return target + distance_mm * back; }
  double pixel_mm() const;  ///< at the target
  /// None behind the eye.
  std::optional<geometry::Vec2> place_of(const geometry::Vec3& point) const;
  CameraRay ray(const geometry::Vec2& place) const;
  /// For a picture of `pixel_ratio` device pixels a pixel.
  geometry::BlockView view(double pixel_ratio = 1.0) const;
};

/// Looks at a box's middle so that all of it is seen, from where it looks now.
TreeCamera fitted(const TreeCamera& eye, const geometry::Vec3& low, const geometry::Vec3& high);
// What a drag of the mouse does, px to the right and down.
inline constexpr double whole_turn_px = 785.0;
TreeCamera turned(const TreeCamera& eye, const geometry::Vec2& by);  ///< once about over whole_turn_px
TreeCamera moved(const TreeCamera& eye, const geometry::Vec2& by);
/// The distance times `factor`; what lies at `at`, as deep as the target, stays there.
TreeCamera nearer(const TreeCamera& eye, double factor, const std::optional<geometry::Vec2>& at = {});

}  // namespace ostia::glview
