#pragma once
/// \file How a line bends: curvature, torsion, Frenet's frames, tortuosity.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::geometry {

/// One of each a point.
struct LineGeometry {
  std::vector<double> curvature;                ///< 1/mm; 0 at the ends
  std::vector<double> torsion;                  ///< 1/mm; 0 at two points of either end
  std::vector<Vec3> tangent, normal, binormal;  ///< Frenet's, unit, right-handed; ends as their neighbours
};

/// By differences of neighbours, as vmtkcenterlinegeometry has them: with x' and x'' over the pieces before
/// and after a point, curvature is |x' x x''| / |x'|^3, torsion (x' x x'') . x''' / |x' x x''|^2. A piece
/// that is straight (curvature below 1e-4 / mm) has no torsion, and no normal of its own: it takes the one
/// before it (at the beginning the first one after it), made normal to its tangent; a straight line takes
/// `straight_normals`, one a point. Coincident neighbours count as straight. Throws InvalidInput for fewer
/// than two points or another number of normals.
LineGeometry line_geometry(const std::vector<Vec3>& points, const std::vector<Vec3>& straight_normals);

/// Length over the distance of the ends, less 1; 0 where the ends meet.
double tortuosity(const std::vector<Vec3>& points);

}  // namespace ostia::geometry
