#pragma once
/// \file How sharply a cut's plane meets the wall.

#include "ostia/meshing/clip.h"

namespace ostia::meshing {

/// The sharpest wedge of the lumen between a cap and the wall.
struct RimWedge {
  double angle_deg =
      180.0;  ///< inside the lumen: 90 for a tube cut across, small where it flares into the plane
  geometry::Vec3 at = geometry::Vec3::Zero();  ///< on the rim, mm
};

/// Of the border points on the plane of an end, each with the wall's mean normal within 0.3 radii of it along
/// the surface, so that single triangles of a grid do not count.
RimWedge sharpest_rim(const geometry::TriMesh& cut, const EndPlane& plane);

}  // namespace ostia::meshing
