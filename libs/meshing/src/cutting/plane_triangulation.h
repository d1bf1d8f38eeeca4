#pragma once
/// \file Good triangles inside a flat loop.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::meshing {

struct FlatPatch {
  std::vector<geometry::Vec3> inner_points;   ///< numbered after the loop's points
  std::vector<geometry::Triangle> triangles;  ///< wound as the loop is
};

/// Constrained Delaunay triangulation of the inside of a simple flat loop, with points at about `edge_mm`
/// (0: the loop's mean edge; never below a hundredth of the root of its area), relaxed. Where an angle is
/// below `good_angle_deg`, the points move to open the smallest angles around them, and along loops of up to
/// 160 points other lattices are tried; the best is taken. Throws GeometryError naming `name` when the loop
/// crosses itself.
FlatPatch triangulate_flat(const std::vector<geometry::Vec3>& loop, double edge_mm, const std::string& name,
                           double good_angle_deg = 0.0);

/// Whether a loop crosses itself when it is laid into its plane, where triangulate_flat refuses it.
bool crosses_itself(const std::vector<geometry::Vec3>& loop);

/// Normal of a loop by Newell's formula, as long as twice its area.
geometry::Vec3 loop_normal(const std::vector<geometry::Vec3>& loop);
double mean_edge(const std::vector<geometry::Vec3>& loop);
/// Where a loop of a mesh's points lies.
std::vector<geometry::Vec3> loop_points(const geometry::TriMesh& mesh, const std::vector<std::int32_t>& loop);

}  // namespace ostia::meshing
