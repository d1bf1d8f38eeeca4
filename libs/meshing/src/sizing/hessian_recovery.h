#pragma once
/// \file Second derivatives of what is known at the nodes or elements of a mesh.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/meshing/field_sizing.h"

#include <array>
#include <vector>

namespace ostia::meshing {

/// Which nodes an edge of an element joins with each node, and which elements have it as a corner
/// (tetrahedra are counted first, then prisms). Rows one after another, ascending.
struct MeshRing {
  std::vector<std::size_t> first_node, first_element;  ///< where a node's row begins; one more than nodes
  std::vector<std::int32_t> nodes, elements;
};
MeshRing ring_of(const geometry::MixedMesh& mesh);

/// xx yy zz yz zx xy
using Symmetric3 = std::array<double, 6>;

/// At each node, components together, by a least-squares fit of a quadratic polynomial to the values around
/// (two rings of neighbours as a rule): exact for quadratic fields wherever the values are.
std::vector<Symmetric3> recovered_hessians(const geometry::MixedMesh& mesh, const MeshRing& ring,
                                           const MeshField& field, const core::TaskContext& task);

/// The largest absolute eigenvalue.
double largest_curvature(const Symmetric3& h);

}  // namespace ostia::meshing
