#pragma once
/// \file [Yi] 3's registration by gradient descent, as it stands there: what register_cage is compared with.

#include "ostia/motion/cage_registration.h"

namespace ostia::motion {

struct DescentOptions {
  int depth = 4;        ///< 2^depth cells a side in the end, in [1, 5]
  double margin = 0.1;  ///< of the cage around the source, of its longest side
  /// Pairs whose normals differ more are none ([Yi] equation 13); in (0, 180].
  double max_angle_deg = 30.0;
  HyperelasticWeights energy;
  /// Without it ([Yi] figure 10) nothing keeps cells from being inverted: the report's least Jacobian tells.
  bool with_energy = true;
  int iterations = 300;  ///< of all depths, the same number at each ([Yi] 5.1); in [depth, 100000]
};
void validate(const DescentOptions& options);

/// At each depth from 1 on, in each iteration: every vertex of the source, as carried, with the closest
/// vertex of the target unless their normals differ too much; the gradient of the sum of squared distances
/// (equations 6 to 14, 19) plus the hyperelastic energy (21 to 25); one step against it. Displacements of all
/// depths add up (20).
///
/// Where the paper is silent: the energy is integrated with the cell as unit of volume; the step's length is
/// Barzilai and Borwein's (1988), halved until the sum falls and, with the energy, all cells' Jacobians stay
/// positive everywhere; only cells that the source may pass and their neighbours have energy, the other
/// control points follow harmonically. Nothing is done against triangles that intersect: the report counts
/// them. Deterministic. Throws InvalidInput (options, a surface without triangles), Cancelled.
Registration register_cage_by_descent(const geometry::TriMesh& source, const geometry::TriMesh& target,
                                      const DescentOptions& options = {},
                                      const core::TaskContext& task = core::no_task());

}  // namespace ostia::motion
