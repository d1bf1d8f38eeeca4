#pragma once
/// \file Polygons of surface files as triangles.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ostia::geometry {

/// The triangulation of least area (Barequet and Sharir 1995) of a polygon of three corners or more, wound as
/// it is: no triangles lie over each other where it has straight or hollow corners, as those of a fan do.
/// Where none is found (corners that are no points, coincide or are not finite) it is the fan about the first
/// corner; more than 500 corners are halved first.
std::vector<Triangle> triangles_of_polygon(const std::vector<Vec3>& points,
                                           std::span<const std::int32_t> corners);

}  // namespace ostia::geometry
