#pragma once
/// \file The centerline's side of flow extensions: which way it runs at an end, and its going on.

#include "ostia/geometry/vessel_tree.h"
#include "ostia/meshing/clip.h"

#include <optional>
#include <vector>

namespace ostia::meshing {

/// `plane` with the node of this tree whose axis ends there: its own node, or, in a tree that was made of the
/// cut lumen anew, the nearest root or end. Throws InvalidInput where no axis passes within two radii.
EndPlane at_node_of(const geometry::VesselTree& tree, const EndPlane& plane);

/// The centerline at an end. In all that follows `plane.node` is the tree's own.
struct AxisEnd {
  geometry::Vec3 direction = geometry::Vec3::UnitZ();  ///< over the last diameter before the section, outward
  geometry::Vec3 turning = geometry::Vec3::Zero();  ///< unit, to where the axis bends there; zero: straight
};
/// Looks back over `diameter` from the section, into the parent where the segment is shorter. Throws
/// InvalidInput where the tree has no axis at the end.
AxisEnd axis_end(const geometry::VesselTree& tree, const EndPlane& plane, double diameter);

/// The axis of an end cut at its section and led on through `points` with the radii given; its node moves to
/// the last of them. Frames of the segment anew. False where the node has several segments (a root that
/// splits), whose axes stay as they are.
bool extend_axis(geometry::VesselTree& tree, const EndPlane& plane, const std::vector<geometry::Vec3>& points,
                 const std::vector<double>& radii);

/// Where the axis of an end meets its section, and its radius there.
struct AxisPoint {
  geometry::Vec3 point = geometry::Vec3::Zero();
  double radius = 0.0;
};
AxisPoint axis_at_section(const geometry::VesselTree& tree, const EndPlane& plane);

}  // namespace ostia::meshing
