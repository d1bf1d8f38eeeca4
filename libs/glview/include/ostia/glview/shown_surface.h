#pragma once
/// \file A surface as the graphics card takes it: each vertex with its cell of the cage.

#include "ostia/core/task_context.h"
#include "ostia/geometry/cage.h"
#include "ostia/geometry/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::glview {

using geometry::Vec3;

/// As it lies in a vertex buffer.
struct ShownVertex {
  std::int32_t corner = 0;        ///< the least control point of its cell
  std::array<float, 3> local{};   ///< within the cell, in [0, 1]: its trilinear weights
  std::array<float, 3> rest{};    ///< at the template's phase, mm
  std::array<float, 3> normal{};  ///< there, unit, outward
};

/// At a vertex in the template, unit, along the vessel; either way.
using Direction = std::array<float, 3>;

struct ShownSurface {
  geometry::CageGrid grid;
  std::vector<ShownVertex> vertices;  ///< one a point of the mesh, in its order, then centres of large holes
  std::vector<geometry::Triangle> triangles;
  std::size_t open_triangles = 0;  ///< so many first; those after them close the surface's open ends
  bool closed = false;             ///< with them; then it is turned outward, too
  std::vector<Direction> along;    ///< one a vertex, or none yet: `find_directions`
};

/// Prepares a template, without directions. Holes are closed where that is possible (a manifold), those of
/// more than 500 vertices by a fan about one vertex more. Throws InvalidInput for a surface without
/// triangles, with indices out of range or points that are not finite; Cancelled.
ShownSurface shown_surface(const geometry::TriMesh& mesh, const geometry::CageGrid& grid,
                           const core::TaskContext& task = core::no_task());

/// The directions in which normals change least within `reach_mm` of a vertex: the axis of a tube. They take
/// longer than all else of a surface, and only stretch and curvature ask for them. Throws Cancelled.
std::vector<Direction> find_directions(const ShownSurface& surface, double reach_mm = 3.0,
                                       const core::TaskContext& task = core::no_task());

/// How the cage deforms space at each vertex: dx/dX of the trilinear map of its cell.
std::vector<Eigen::Matrix3d> gradients(const ShownSurface& surface, const std::vector<Vec3>& control_points);

}  // namespace ostia::glview
