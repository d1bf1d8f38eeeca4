#pragma once
/// \file What is known of a lumen's surface already, for functions that would find it again.

#include "ostia/centerline/delaunay.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::centerline {

/// Of a surface that is sound: one part, manifold and outward, without equal or unused points, triangles
/// without area or twice the same, self-intersections and holes in its wall. It changes no result, and what
/// belongs to another surface is passed over.
struct KnownSurface {
  std::vector<std::vector<std::int32_t>> loops;    ///< geometry::boundary_loops: its open ends
  geometry::TriMesh closed;                        ///< geometry::fill_holes; begins with the surface
  std::shared_ptr<const geometry::AabbTree> tree;  ///< of `closed`, or null
  std::shared_ptr<DelaunayAhead> tetrahedra;       ///< of its points, or null
};

/// Whether that is what is known of this surface.
bool is_of(const KnownSurface& known, const geometry::TriMesh& surface);

}  // namespace ostia::centerline
