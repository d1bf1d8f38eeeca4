#pragma once
// The marching-cubes engine behind the isosurfaces: slabs of a grid from any source, vertices placed by any
// rule.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <array>
#include <cstdint>
#include <functional>

namespace ostia::geometry {

/// A grid edge that the surface crosses: from node (i, j, k) one step along `axis`; `from` and `to` are the
/// values at its ends.
struct CrossedEdge {
  std::array<std::int64_t, 3> node;
  int axis;
  float from, to;
};

struct MarchingCubes {
  std::array<std::int64_t, 3> size{0, 0, 0};  ///< nodes
  float level = 0.0f;
  std::int64_t numbered_from = 0;  ///< what messages call the first node along each axis
  bool left_handed = false;        ///< of the map that `place` applies: triangles are turned over
  /// Fills the slices [first, first + count) with values, x fastest. Called from several threads at once.
  std::function<void(std::int64_t first, std::int64_t count, float* values)> fill;
  /// The world point of a crossing. Called from several threads at once.
  std::function<Vec3(const CrossedEdge&)> place;
};

/// Inside is value < level. Triangles are counter-clockwise seen from larger values (right-handed map). The
/// surface is a 2-manifold whose border, if any, lies in the faces of the grid. The same for any number of
/// threads.
TriMesh march(const MarchingCubes& job, const core::TaskContext& task);

/// Where the values cross the level, as a fraction of the edge, kept off its ends.
double crossing_fraction(float from, float to, float level);

}  // namespace ostia::geometry
