#pragma once
/// \file The wall of the aortic root and ascending aorta, and what lies just beyond it.

#include "ostia/coronary/aorta.h"
#include "ostia/geometry/frame.h"

#include <cstddef>
#include <vector>

namespace ostia::coronary {

/// The wall as a distance from the axis, by place along it and angle about it (geometry::radial_direction).
struct AorticWall {
  double step_mm = 1.0;  ///< along the axis
  std::size_t angles = 0;
  std::vector<Vec3> centres;
  std::vector<geometry::Frame> frames;
  std::vector<double> radius_mm;  ///< station by station

  double angle(std::size_t a) const;
  double radius(std::size_t station, std::size_t a) const { return radius_mm[station * angles + a]; }
  Vec3 place(std::size_t station, std::size_t a, double beyond_mm) const;
};

struct AorticWallOptions {
  double upwards_mm = 60.0;  ///< of aorta from its lower end
  double wall_hu = 60.0;     ///< what the contrast is counted from
  std::size_t angles = 72;
  double window_mm = 5.0;   ///< half width of the median along the axis
  double window_rad = 0.5;  ///< and about it
};

/// Half-way falls of intensity on rays across the axis. The median over a window takes away what leaves the
/// wall: arteries, the contact with a chamber.
AorticWall aortic_wall(const imaging::ImageVolume& image, const Aorta& aorta,
                       const AorticWallOptions& options);

}  // namespace ostia::coronary
