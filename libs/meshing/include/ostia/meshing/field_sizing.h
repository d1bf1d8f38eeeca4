#pragma once
/// \file Edge lengths from a field that a solver has computed, so that each element has its share of the
/// error and no more ([Antiga] 7; equidistribution of the interpolation error, Zienkiewicz and Zhu 1987;
/// Alauzet and Loseille 2016). See docs/methods/flow-refinement.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/meshing/size_field.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ostia::meshing {

/// What is known at the nodes or in the elements (tetrahedra, then prisms) of a mesh.
struct MeshField {
  int components = 1;          ///< 1 to 9
  bool at_elements = false;    ///< else at nodes
  std::vector<double> values;  ///< components together, in any unit
};

struct FieldSizingOptions {
  /// Interpolation error that an element may have, over the field's range. In (0, 1].
  double error_share = 0.02;
  /// How many elements are wanted in place of that: the error follows. >= 100.
  std::optional<double> elements;
  double most_refinement = 0.5;  ///< least new length over the old; in [0.05, 1]
  double most_coarsening = 1.0;  ///< largest new length over the old; in [1, 20]
  double gradation = 0.3;        ///< growth of the length in the volume, mm per mm; in [0.01, 2]
  double min_edge_mm = 0.0;      ///< >= 0
  double max_edge_mm = std::numeric_limits<double>::infinity();  ///< > min_edge_mm
};
void validate(const FieldSizingOptions& options);

struct FieldSizing {
  SizeField sizes;                  ///< at the mesh's nodes
  std::vector<double> old_edge_mm;  ///< local edge length of the mesh there
  double range = 0.0;               ///< of the field, in its unit: norm of the components' ranges
  double largest_error = 0.0;       ///< of interpolation on the mesh given
  double target_error = 0.0;        ///< what was aimed at
  double reached_error = 0.0;       ///< largest with the new lengths
  double refined_share = 0.0;       ///< of the volume where edges become shorter by 5 % or more
  double held_share = 0.0;          ///< of the volume where most_refinement or min_edge_mm kept them longer
  double elements_before = 0.0;
  double elements = 0.0;  ///< foretold
  std::vector<std::string> warnings;
};

/// The linear interpolation of a field with Hessian H on a regular tetrahedron of edge h errs by at most
/// 3/16 h^2 |lambda_max(H)| (Waldron 1998: half the squared radius of the sphere around it times that). The
/// length at a node is the one that makes this the error asked for, no shorter and longer than the options
/// allow, with bounded gradation. For vectors |lambda_max| is the root of the sum of the components' squares.
/// Deterministic. Throws InvalidInput: options, a quadratic mesh, no elements, another number of values,
/// values that are not finite (with the node's place).
FieldSizing sizes_from_field(const geometry::MixedMesh& mesh, const MeshField& field,
                             const FieldSizingOptions& options = {},
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
