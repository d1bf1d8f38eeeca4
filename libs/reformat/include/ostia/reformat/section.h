#pragma once
/// \file Where a surface meets a plane.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/reformat/plane.h"

#include <vector>

namespace ostia::reformat {

/// The lines along which a surface crosses the (infinite) plane. A closed line ends with its first point; a
/// line that begins and ends at the surface's border is open. In the picture (seen along u x v) an outward
/// surface's inside lies to the left. Vertices in the plane count as in front of it, so each crossing is one
/// proper line; a surface within the plane has none. Order: by lowest triangle. Throws InvalidInput for an
/// invalid plane, triangles that name no point, or points not finite.
std::vector<std::vector<Vec3>> section(const geometry::TriMesh& surface, const Plane& plane);
/// The same for a plane given by a point and a normal of any length but zero.
std::vector<std::vector<Vec3>> section(const geometry::TriMesh& surface, const Vec3& point,
                                       const Vec3& normal);

/// The length of a line, and the area that a closed flat line encloses (always positive).
double length(const std::vector<Vec3>& line);
double enclosed_area(const std::vector<Vec3>& closed_line);

}  // namespace ostia::reformat
