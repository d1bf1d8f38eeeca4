#pragma once
/// \file The methods that [Yi] 5.1.2 compares its cage with: clouds of points as mixtures of Gaussians,
/// brought onto each other by thin-plate splines or Gaussian radial basis functions (Jian and Vemuri 2011).

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::experiments {

enum class DeformationKind {
  thin_plate_spline,  ///< an affine map plus the kernel -r at each control point (TPS)
  gaussian_basis,     ///< the kernel exp(-r^2 / 2 b^2) at each control point (GRBF)
};
enum class MixtureCost {
  l2,                  ///< squared L2 distance of the two mixtures, over that of the target from nothing
  kernel_correlation,  ///< KC (Tsin and Kanade 2004): less the squared cosine between the two mixtures
};

/// What [Yi] says: the four combinations, 4,913 control points, L-BFGS-B. Where it is silent: the control
/// points are those of the cage of that depth; the Gaussians' width goes from wide to narrow as in Jian and
/// Vemuri; for the other values see docs/experiments/motion-methods.md. Nothing bounds the unknowns, so that
/// L-BFGS-B takes the steps of L-BFGS.
struct MixtureOptions {
  DeformationKind kind = DeformationKind::thin_plate_spline;
  MixtureCost cost = MixtureCost::l2;
  int depth = 4;        ///< (2^depth + 1)^3 control points; in [1, 4]
  double margin = 0.1;  ///< of the control points' box around the source, of its longest side
  /// Standard deviations of the Gaussians, one optimisation after the other. Falling, positive.
  std::vector<double> widths_mm = {8.0, 4.0, 2.0, 1.0, 0.5};
  double stiffness = 1e-5;         ///< weight of the bending energy (lengths in half the longest side); >= 0
  double basis_width_cells = 1.5;  ///< b in distances of control points, for gaussian_basis; in [0.1, 10]
  int most_iterations = 500;       ///< at each width; in [1, 100000]
  /// A width is done when an iteration lowers the cost by less than this share of it (or of 1); in (0, 1).
  double tolerance = 1e-6;
};
void validate(const MixtureOptions& options);

struct MixtureReport {
  int iterations = 0, evaluations = 0;  ///< of all widths
  double cost = 0.0;                    ///< at the last width, bending included
  bool converged = true;                ///< at every width before the iterations were used up
};

struct MixtureDeformation {
  geometry::TriMesh surface;  ///< the source's triangles, carried
  MixtureReport report;
};

/// Deforms the source's points towards the target's. Where Gaussians are wide, points nearer to each other
/// than a quarter of the width are one of that many times the weight. Deterministic. Throws InvalidInput
/// (options, a surface without points), Cancelled.
MixtureDeformation deform_by_mixtures(const geometry::TriMesh& source, const geometry::TriMesh& target,
                                      const MixtureOptions& options = {},
                                      const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
