#pragma once
/// \file Smooth subdivision of surfaces, for features that are only a triangle wide.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstddef>

namespace ostia::geometry {

struct SubdivisionOptions {
  int levels = 1;                          ///< each makes four triangles of one; in [0, 8]
  bool to_limit = false;                   ///< points go where endless subdivision would bring them
  std::size_t max_triangles = 20'000'000;  ///< a result with more is refused before any work
};
void validate(const SubdivisionOptions& options);

/// Loop's scheme (1987; [Antiga] 6.1): C2 in the limit, C1 at points without six neighbours. Borders are
/// uniform cubic B-splines of their own points alone, so that surfaces with the same border keep it the same.
/// Triangle i becomes triangles 4 i to 4 i + 3 (three corners, then the middle); points keep their indices.
/// Throws InvalidInput (options, size, points that are not finite) and GeometryError for a surface that is
/// not manifold, with the place.
TriMesh loop_subdivided(const TriMesh& mesh, const SubdivisionOptions& options = {},
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::geometry
