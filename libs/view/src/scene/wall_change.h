#pragma once
/// \file Where a wall differs from the one before, and that part of it as a mesh of its own.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace ostia::view {

/// Unit normals at the points: the triangles' own, weighted by area. Zero where a point has no triangle.
std::vector<Eigen::Vector3f> smooth_normals(const geometry::TriMesh& mesh);

/// Points [0, first) are those of the former wall, to the last bit, and so are those from `last` on, which
/// had an index less by `shift`. An edit changes blocks of the wall that follow each other nearly in the
/// mesh.
struct WallChange {
  std::size_t first = 0, last = 0;
  std::ptrdiff_t shift = 0;
  geometry::Box3 box;  ///< about the points that differ, of both walls; empty where none does
};
WallChange change_between(const geometry::TriMesh& before, const geometry::TriMesh& after);

/// The triangles with a corner in a box.
struct WallPiece {
  geometry::TriMesh mesh;
  std::vector<Eigen::Vector3f> normals;  ///< as on the whole wall
  std::vector<std::int32_t> points;      ///< of the whole wall, one for each of the mesh
};
WallPiece piece_within(const geometry::TriMesh& wall, const geometry::Box3& box);
/// Of each triangle, whether the piece has it.
std::vector<char> triangles_within(const geometry::TriMesh& wall, const geometry::Box3& box);
/// Of each point, whether it is in the box.
std::vector<char> points_within(const geometry::TriMesh& wall, const geometry::Box3& box);

}  // namespace ostia::view
