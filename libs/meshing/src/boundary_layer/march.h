#pragma once
/// \file Where the points of boundary layers march to, and how far there is room.

#include "boundary_layer/wall.h"

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace ostia::meshing {

/// What a wall point's direction must see: for each triangle around it the inward unit normal times
/// 2 / sqrt(3) sin(angle of its corner there), so that the product with a direction is the scaled Jacobian of
/// an infinitely thin prism's corner. On rings within the cap's plane, and with the normals of the ring's
/// edges besides.
using SightCone = std::vector<geometry::Vec3>;

std::vector<SightCone> sight_cones(const LayerWall& wall);
/// The normals of the rings' edges that are part of their points' cones; empty for all other points.
std::vector<SightCone> ring_edges(const LayerWall& wall);
/// One point's cone, with its `ring_edges`.
SightCone sight_cone(const LayerWall& wall, const std::vector<SightCone>& edges, std::int32_t v);
double least_product(const SightCone& cone, const geometry::Vec3& direction);
/// The unit direction with the largest least product. Throws nothing: the product tells whether it is of use.
geometry::Vec3 most_visible(const SightCone& cone);

/// Directions that vary smoothly along the wall and keep most of the largest possible least product. Throws
/// GeometryError with the place where no direction sees all triangles.
std::vector<geometry::Vec3> march_directions(const LayerWall& wall, const std::vector<SightCone>& cones);

/// At each wall point the radius of the largest ball inside that touches the wall there, with its centre in
/// the direction; at most `most`, mm. It is small where the wall is concave, in crevices, and where the
/// opposite wall is near.
std::vector<double> room(const LayerWall& wall, const std::vector<geometry::Vec3>& directions,
                         const std::vector<double>& most, const core::TaskContext& task);

/// Lowers the shares of the thickness where they times `wanted` grow faster than `gradation` along the edges.
void limit_shares(const LayerWall& wall, const std::vector<double>& wanted, double gradation,
                  std::vector<double>& shares);

}  // namespace ostia::meshing
