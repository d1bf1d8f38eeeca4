#pragma once
/// \file Hexahedra that are flat or folded are mended by moving the nodes within.

#include "ostia/core/task_context.h"
#include "ostia/geometry/hex_mesh.h"

#include <cstdint>
#include <vector>

namespace ostia::reconstruction {

/// Straight lines of nodes from the wall to the end of its layers, which keep their proportions.
struct LayerLines {
  std::vector<std::vector<std::int32_t>> lines;  ///< each from the wall inwards
  std::vector<double> depths;                    ///< of a line's nodes, from 0 to 1
};

/// Moves nodes that are not on the boundary, one after another, where the least scaled Jacobian about them is
/// below `wanted` and can be made greater: to the middle of their neighbours, or by ever smaller steps. A
/// line of layers moves by its end, as one. At most `rounds` times through all. Deterministic. Throws
/// Cancelled.
void relax(geometry::HexMesh& mesh, const LayerLines& layers, double wanted, int rounds,
           const core::TaskContext& task);

}  // namespace ostia::reconstruction
