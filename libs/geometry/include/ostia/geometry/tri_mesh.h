#pragma once
/// \file Triangle surfaces and tetrahedral meshes: plain values.

#include "ostia/geometry/vec.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ostia::geometry {

using Triangle = std::array<std::int32_t, 3>;     ///< counter-clockwise seen from outside
using Tetrahedron = std::array<std::int32_t, 4>;  ///< positive volume: (p1-p0) x (p2-p0) . (p3-p0) > 0

/// A triangle surface. Immutable once shared.
struct TriMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

enum class FaceKind { wall, inlet, outlet };

/// A named part of a model's boundary. Ids are CellEntityIds: 1 is the wall, 2 and up are the caps.
struct Face {
  std::int32_t id = 1;
  std::string name = "wall";  ///< `wall`, `inlet_<vessel>`, `outlet_<vessel>`
  FaceKind kind = FaceKind::wall;
};

/// A surface whose triangles belong to faces.
struct FacedSurface {
  TriMesh mesh;
  std::vector<std::int32_t> face_ids;  ///< one a triangle
  std::vector<Face> faces;
};

/// A tetrahedral mesh with its boundary. Boundary triangles refer to the same points, outward.
struct VolumeMesh {
  std::vector<Vec3> points;
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Triangle> boundary;
  std::vector<std::int32_t> boundary_face_ids;  ///< one a boundary triangle
  std::vector<Face> faces;
};

}  // namespace ostia::geometry
