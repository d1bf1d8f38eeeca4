#pragma once
/// \file The columns of prisms over the wall's triangles, and how they are made valid.

#include "boundary_layer/march.h"
#include "boundary_layer/wall.h"

#include "ostia/meshing/boundary_layer.h"

#include <vector>

namespace ostia::meshing {

/// Layers as directions and thicknesses at the wall's points.
struct Columns {
  Columns(const LayerWall& wall, std::vector<SightCone> cones, const BoundaryLayerOptions& options);

  geometry::Vec3 at(std::int32_t v, std::size_t layer) const;  ///< layer 0 is the wall, bit for bit
  PrismCorners prism(std::size_t triangle, std::size_t layer) const;
  /// Least scaled Jacobian of the column's prisms; negative as soon as a Bernstein coefficient is.
  double quality(std::size_t triangle) const;
  /// What the column must have: min_scaled_jacobian, or a little less than the best that it can have when
  /// infinitely thin.
  double required(std::size_t triangle) const;
  double inner_angle_deg(std::size_t triangle) const;
  double required_angle_deg(std::size_t triangle) const;
  /// The inner wall closed by caps. Points inside caps follow the n wall points.
  geometry::FacedSurface inner() const;

  const LayerWall& wall;
  const std::vector<SightCone> cones;
  const BoundaryLayerOptions options;
  std::vector<double> heights;           ///< of the layers' limits over the whole thickness: 0 ... 1
  const std::vector<double> visibility;  ///< largest least product at each wall point
  std::vector<geometry::Vec3> directions;
  std::vector<double> wanted_mm, shares;
};

/// Turns and thins columns until all are as required, the caps can be filled and the inner surface crosses
/// neither itself nor the wall. Returns the rounds. Throws GeometryError when `max_rounds` do not do.
int make_valid(Columns& columns, const core::TaskContext& task);

}  // namespace ostia::meshing
