#pragma once
/// \file What a triangle surface is like: borders, components, orientation, faults, areas and volumes.
///
/// A triangle that names a point which is not there throws InvalidInput everywhere here. Triangles that
/// repeat a corner have no edges.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::geometry {

double area(const TriMesh& mesh);
/// By the divergence theorem; positive for a closed outward surface.
double volume(const TriMesh& mesh);
double volume(const VolumeMesh& mesh);
Box3 bounds(const std::vector<Vec3>& points);
/// Normalised sums of triangle normals, weighted by angle (Baerentzen and Aanaes 2005). Zero at unused
/// points.
std::vector<Vec3> vertex_normals(const TriMesh& mesh);
std::vector<std::vector<std::int32_t>> vertex_neighbours(const TriMesh& mesh);  ///< ascending

/// Closed chains of border half-edges, each a list of vertices in the order of their triangles' winding (the
/// hole lies to the right), from its lowest vertex on. Those with most vertices first; ties by lowest vertex.
/// Throws GeometryError where a border vertex joins more than one chain (non-manifold, or triangles turned
/// against each other).
std::vector<std::vector<std::int32_t>> boundary_loops(const TriMesh& mesh);

/// Component of each triangle (connected by edges), numbered by lowest triangle.
std::vector<std::int32_t> components(const TriMesh& mesh);

/// Counts of everything that a mesher chokes on.
struct SurfaceFaults {
  std::size_t non_finite_points = 0;
  std::size_t duplicate_points = 0;  ///< points equal to an earlier one, bit for bit
  std::size_t unused_points = 0;
  std::size_t degenerate_triangles = 0;  ///< repeated corner, or height below 1e-12 of the longest edge
  std::size_t duplicate_triangles = 0;   ///< the same three corners, any order
  std::size_t open_edges = 0;
  std::size_t non_manifold_edges = 0;     ///< more than two triangles
  std::size_t non_manifold_vertices = 0;  ///< triangles around it form more than one fan
  std::size_t inconsistent_edges = 0;     ///< two triangles that run along it the same way
  std::size_t components = 0;
  std::size_t self_intersections = 0;  ///< pairs; counted when asked for
  std::vector<Vec3> examples;          ///< where: up to ten places, shared out over the kinds of fault
  bool closed_manifold() const;        ///< no fault but unused points, and no open edge
  std::string summary() const;         ///< "2 open edges, 1 self-intersection"; "none"
};
SurfaceFaults find_faults(const TriMesh& mesh, bool with_self_intersections);

/// Each point merged into the first one kept within `tolerance_mm` (0: equal coordinates only); degenerate
/// and duplicate triangles, triangles with points that are not finite, and unused points dropped. Where a
/// triangle without area is dropped, its neighbour along the longest side is split, so that no crack opens.
/// Throws InvalidInput for a negative tolerance.
TriMesh welded(const TriMesh& mesh, double tolerance_mm = 0.0);
/// Triangles that meet along edges of two turned the same way; each such patch outward when closed, else the
/// way of its lowest triangle. Throws GeometryError for a surface with one side only (Moebius strip).
TriMesh oriented(const TriMesh& mesh);
/// Only the triangles with keep[i]; unused points dropped. `old_triangles` receives their former indices when
/// given.
TriMesh subset(const TriMesh& mesh, const std::vector<bool>& keep,
               std::vector<std::int32_t>* old_triangles = nullptr);
TriMesh merged(const TriMesh& a, const TriMesh& b);  ///< side by side, nothing welded

/// A surface whose holes are closed.
struct FilledHoles {
  TriMesh mesh;
  std::vector<std::int32_t>
      hole_of_triangle;  ///< -1 for triangles of the input, else the loop's index in boundary_loops
};
/// Closes each loop of boundary_loops by the triangulation of least area (Barequet and Sharir 1995) that adds
/// no point and no second use of an edge, turned as the surface around it. A loop of more than 500 vertices,
/// or one without such a triangulation, gets a fan to a new point at its mean. Throws what boundary_loops
/// throws.
FilledHoles fill_holes(const TriMesh& mesh);

}  // namespace ostia::geometry
