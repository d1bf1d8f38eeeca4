#pragma once
/// \file Where the nodes of the wall belong on the reference surface.

#include "quadratic/nodes.h"

#include "ostia/geometry/aabb_tree.h"

namespace ostia::meshing {

/// A way from the straight edge.
struct Projection {
  geometry::Vec3 displacement = geometry::Vec3::Zero();
  bool found = false;
};

/// The nearest point of the reference, on rings within the cap's plane. Not found where it is farther than
/// `max_displacement` edges or on a wall that looks elsewhere.
std::vector<Projection> projections(const std::vector<WallNode>& nodes, const geometry::TriMesh& reference,
                                    const geometry::AabbTree& tree, double max_displacement,
                                    const core::TaskContext& task);

}  // namespace ostia::meshing
