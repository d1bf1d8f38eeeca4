#pragma once
/// \file Which place of a surface belongs to which of another, by distance and normals ([Yi] equation 13).

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/cage.h"
#include "ostia/geometry/kd_tree.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::motion {

struct SurfacePair {
  geometry::CagePoint source;                                                       ///< by the cage at rest
  geometry::Vec3 target = geometry::Vec3::Zero(), normal = geometry::Vec3::Zero();  ///< on the target
  double distance = 0.0;
  double weight = 0.0;  ///< mm2 of surface, less for what stands out; 0: no pair
};

/// What of the target is needed in every round.
struct PairingTarget {
  explicit PairingTarget(const geometry::TriMesh& mesh);
  const geometry::TriMesh& mesh;
  geometry::AabbTree tree;
  std::vector<geometry::Vec3> triangle_normals, point_normals;
  std::vector<double> point_areas;
};

std::vector<geometry::Vec3> unit_triangle_normals(const geometry::TriMesh& mesh);
/// By the triangles' areas; unit, or zero where there is none.
std::vector<geometry::Vec3> unit_point_normals(const geometry::TriMesh& mesh);
/// A third of the triangles about each point, mm2.
std::vector<double> point_areas(const geometry::TriMesh& mesh);

/// Pairs of each of the source's points, then of each of the target's. `carried` is the source as it is now;
/// `at_rest` and `grid` say where a place of it is in the cage. `looseness` multiplies the distance from
/// which pairs have no weight.
std::vector<SurfacePair> surface_pairs(const geometry::TriMesh& carried, const geometry::TriMesh& at_rest,
                                       const geometry::CageGrid& grid, const PairingTarget& target,
                                       double max_angle_deg, double looseness);

/// The target's vertices and their normals.
struct PairingVertices {
  explicit PairingVertices(const geometry::TriMesh& mesh);
  geometry::KdTree tree;
  std::vector<geometry::Vec3> normals;
};

/// Each of the source's points, as carried, with the closest of the target's vertices; weight 1, or 0 where
/// the vertices' normals differ by more. `places`: the points in the cage at rest.
std::vector<SurfacePair> vertex_pairs(const geometry::TriMesh& carried,
                                      const std::vector<geometry::CagePoint>& places,
                                      const PairingVertices& target, double max_angle_deg);

}  // namespace ostia::motion
