#pragma once
/// \file The lines in which a plane cuts a surface, and what a polygon measures about a point.

#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::analysis {

/// A connected line; a closed one joins its last point to its first.
struct PlaneOutline {
  std::vector<geometry::Vec3> points;
  bool closed = false;
};
/// All of them. Points on the plane count as in front of it, so a line never ends in one.
std::vector<PlaneOutline> plane_outlines(const geometry::TriMesh& mesh, const geometry::Vec3& origin,
                                         const geometry::Vec3& normal);

/// The distance of a place from a line, from its sides.
double distance_to(const PlaneOutline& outline, const geometry::Vec3& place);

struct PolygonMeasures {
  double area_mm2 = 0.0, perimeter_mm = 0.0, min_mm = 0.0, max_mm = 0.0;
};
/// Of the polygon that the outline is once it is closed. Diameters go through `centre`: from the nearest and
/// from the farthest place of the outline on to the last crossing beyond the centre.
PolygonMeasures polygon_measures(const PlaneOutline& outline, const geometry::Vec3& centre,
                                 const geometry::Vec3& normal);

}  // namespace ostia::analysis
