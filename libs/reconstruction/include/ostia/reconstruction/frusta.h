#pragma once
/// \file Networks of vessels as truncated cones that share the circles at their joints, for quick drawing.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_graph.h"

#include <cstdint>
#include <vector>

namespace ostia::reconstruction {

struct FrustaOptions {
  int sides = 12;      ///< of every cone; in [3, 256]
  int pieces = 1;      ///< cones for each segment, along the smooth axis; in [1, 64]
  bool smooth = true;  ///< axes are cubic B-splines; false: the segments themselves
};
void validate(const FrustaOptions& options);

/// Arrays for drawing: one point for each corner of each shared circle.
struct FrustaMesh {
  geometry::TriMesh mesh;
  std::vector<geometry::Vec3> normals;  ///< unit, outward, one a point
  /// One a point: along the vessel in mm from the branch's proximal end, and around it in [0, 1].
  std::vector<geometry::Vec2> texture;
  std::vector<std::int32_t> edge_of_triangle;  ///< the segment, index into the graph's edges
};

/// The axis of a branch as a uniform cubic B-spline with its points as control points and both ends fixed
/// ([Wischgoll] 3): bifurcations stay where they are. `pieces` steps for each span, so that the result has
/// pieces * (points - 1) + 1 points; the first and the last are those given.
std::vector<geometry::Vec3> b_spline_axis(const std::vector<geometry::Vec3>& points, int pieces);

/// Cones along each branch; two that follow each other share the ellipse in which both meet the plane that
/// bisects them, limited where a joint turns back so sharply that it would reach beyond its cones. Branches
/// overlap at forks. Throws InvalidInput for options and for a graph that is not sound; Cancelled.
FrustaMesh frusta(const geometry::VesselGraph& graph, const FrustaOptions& options = {},
                  const core::TaskContext& task = core::no_task());

}  // namespace ostia::reconstruction
