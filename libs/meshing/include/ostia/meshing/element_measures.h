#pragma once
/// \file How good each element of a mesh is, for pictures. See docs/methods/mesh-quality.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ostia::meshing {

/// As `mixed_quality` has them, of one element.
enum class ElementMeasure {
  least_dihedral_deg,
  scaled_jacobian,
  non_orthogonality_deg,  ///< OpenFOAM's, the worst of its sides; 0 where all are the boundary's
  skewness,               ///< OpenFOAM's, the worst of its sides
  mean_edge_mm,           ///< of its edges, corner to corner
};
inline constexpr std::size_t element_measure_count = 5;
/// Of non-orthogonality and skewness; of the others the smallest are the worst.
bool larger_is_worse(ElementMeasure measure);

/// By measure, of each element, tetrahedra first.
using ElementMeasures = std::array<std::vector<double>, element_measure_count>;
/// All of them. Throws InvalidInput as mixed_quality does. Cancelled.
ElementMeasures element_measures(const geometry::MixedMesh& mesh,
                                 const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
