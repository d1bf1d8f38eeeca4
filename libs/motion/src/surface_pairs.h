#pragma once
/// \file Which place of a surface belongs to which of another, by distance and normals ([Yi] equation 13).

#include "ostia/geometry/cage.h"
#include "ostia/geometry/kd_tree.h"
#include "ostia/geometry/moving_surface.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::motion {

struct SurfacePair {
  geometry::CagePoint source;                                                       ///< by the cage at rest
  geometry::Vec3 target = geometry::Vec3::Zero(), normal = geometry::Vec3::Zero();  ///< on the target
  double distance = 0.0;
  double weight = 0.0;  ///< mm2 of surface, less for what stands out; 0: no pair
};

/// Normals and surface of a mesh's parts.
struct SurfaceFrames {
  explicit SurfaceFrames(const geometry::TriMesh& mesh);
  std::vector<geometry::Vec3> triangle_normals;  ///< unit, or zero where there is none
  std::vector<geometry::Vec3> point_normals;     ///< by the triangles' areas; unit, or zero
  std::vector<double> point_areas;               ///< a third of the triangles about each point, mm2
};

/// One of two surfaces that are paired round by round.
struct PairedSurface {
  explicit PairedSurface(const geometry::TriMesh& at_rest);
  void move(const std::vector<geometry::Vec3>& points);

  const geometry::TriMesh& at_rest;
  geometry::TriMesh now;
  geometry::MovingSurface tree;  ///< as all that follows, of `now`
  SurfaceFrames frames;
  std::vector<std::int32_t> meet;  ///< each point's triangle on the other surface in the last round
};

struct PairingRules {
  double max_angle_deg = 30.0;  ///< between normals
  double looseness = 1.0;       ///< multiplies the distance from which pairs have no weight
  /// One point of so many has a pair, and stands for the others, as long as 2000 of a surface have.
  std::size_t every = 1;
};

/// Pairs of each of the source's points, then of each of the target's. `grid` is the source's at rest.
std::vector<SurfacePair> surface_pairs(PairedSurface& source, PairedSurface& target,
                                       const geometry::CageGrid& grid, const PairingRules& rules);

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
