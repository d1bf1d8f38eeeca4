#pragma once
/// \file Places in the heart's own directions: depth towards the apex and angle about the long axis.

#include "ostia/geometry/vec.h"

#include <optional>
#include <vector>

namespace ostia::coronary {

using geometry::Vec3;

/// A place seen from the heart.
struct HeartPlace {
  double depth_mm = 0.0;   ///< from the base towards the apex
  double angle_deg = 0.0;  ///< about the long axis: 0 up, 90 to the left ventricle's side wall, 180 down
  double away_mm = 0.0;    ///< from the long axis
};

struct HeartFrame {
  Vec3 base = Vec3::Zero();        ///< about the middle of the base
  Vec3 long_axis = Vec3::UnitY();  ///< unit, base to apex
  Vec3 up = Vec3::UnitZ();         ///< unit, across: as much to the head as can be
  Vec3 side = Vec3::UnitX();       ///< unit, across: up x long axis, towards the left side wall

  HeartPlace place(const Vec3& point) const;
  /// The places of a path; angles run on without jumps.
  std::vector<HeartPlace> places(const std::vector<Vec3>& path) const;
};

/// From the ostia alone, or with a known axis.
HeartFrame usual_frame(const std::vector<Vec3>& ostia, const std::optional<Vec3>& long_axis);

/// With the base's plane and middle through what runs in the atrioventricular groove; nothing where that is
/// too short, too far from a plane, or lies otherwise than any heart's base.
std::optional<HeartFrame> frame_of_ring(const HeartFrame& usual, const std::vector<Vec3>& groove);

}  // namespace ostia::coronary
