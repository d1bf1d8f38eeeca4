#pragma once
/// \file Volume meshes of tetrahedra and prisms, linear or quadratic: what a solver is given.

#include "ostia/geometry/tri_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::geometry {

/// Two triangles and the edges between them, 0-3, 1-4, 2-5. Positive volume: (p1-p0) x (p2-p0) . (p3-p0) > 0
/// (VTK's wedge has the opposite sense).
using Prism = std::array<std::int32_t, 6>;
using Quad = std::array<std::int32_t, 4>;  ///< counter-clockwise seen from outside

/// A mesh of tetrahedra and prisms with its whole boundary, which refers to the same points, outward. Faces
/// of neighbouring elements are the same triangles and quadrilaterals. A quadratic mesh has nodes in the
/// middle of every edge and of every prism's quadrilaterals; a linear one has those lists empty.
struct MixedMesh {
  std::vector<Vec3> points;  ///< corners first, then the nodes of the second order
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Prism> prisms;

  std::vector<Triangle> triangles;  ///< of the boundary
  std::vector<std::int32_t> triangle_face_ids;
  std::vector<Quad> quads;  ///< of the boundary: the layers' sides at the caps
  std::vector<std::int32_t> quad_face_ids;
  std::vector<Face> faces;

  /// Nodes of the second order, one entry an element, in VTK's orders: on the edges 01 12 20 03 13 23;
  std::vector<std::array<std::int32_t, 6>> tetrahedron_nodes;
  /// on 01 12 20, 34 45 53, 03 14 25 and in the middle of 0143, 1254, 2035;
  std::vector<std::array<std::int32_t, 12>> prism_nodes;
  std::vector<std::array<std::int32_t, 3>> triangle_nodes;  ///< on 01 12 20
  std::vector<std::array<std::int32_t, 5>> quad_nodes;      ///< on 01 12 23 30 and in the middle

  bool quadratic() const { return !tetrahedron_nodes.empty() || !prism_nodes.empty(); }
};

/// Tetrahedra alone.
MixedMesh mixed(const VolumeMesh& mesh);

}  // namespace ostia::geometry
