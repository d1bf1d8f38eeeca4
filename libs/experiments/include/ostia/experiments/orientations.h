#pragma once
/// \file The experiment of [Luboz] 3.1: one phantom scanned in twelve orientations; how much lengths and
/// radii of its tubes differ from scan to scan, and from the truth.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/agreement.h"
#include "ostia/experiments/orientation_phantom.h"
#include "ostia/pipeline/skeleton.h"

#include <string>
#include <vector>

namespace ostia::experiments {

struct OrientationsOptions {
  TubeScanOptions scan;
  double vessel_sigma_hu = 750.0;  ///< sigma of the balloon; m is the scan's lumen_hu ([Luboz] 3.1)
  double tau = 0.2;                ///< of the balloon
  double inflation = 0.1;          ///< weight of the balloon
  double curvature = 0.1;          ///< weight of the minimal curvature
  int iterations = 1000;           ///< of the level set, at most
  int diffusion_iterations = 5;    ///< flux-based, before all else; 0: none
  double prune_mm = 5.0, gap_mm = 2.0, sigma_mm = 0.4;
  double knots_mm = 8.0;  ///< of the smooth lines
  bool settle = true;     ///< junctions and ends, as `ostia skeleton` does; false: as thinning leaves them
};
void validate(const OrientationsOptions& options);  ///< throws InvalidInput

/// One tube as found in one scan.
struct TubeMeasure {
  std::string tube, orientation;
  double true_length_mm = 0.0, true_radius_mm = 0.0;
  int lines = 0;  ///< of the skeleton that are this tube; 1 where all is well, 0 where it was not found
  double length_mm = 0.0;
  double radius_mm = 0.0;       ///< of the segmented image, as the paper has it
  double grey_radius_mm = 0.0;  ///< of the grey image
};

/// One scan.
struct OrientationRun {
  std::string name;
  std::vector<TubeMeasure> tubes;  ///< in the phantom's order
  int other_lines = 0;             ///< of the skeleton that are none of the tubes
  std::int64_t components = 0, loops = 0;
  int iterations = 0;  ///< of the level set
};

/// Scans, segments, thins and measures. Deterministic. Throws what the steps throw.
OrientationRun measure_orientation(const std::vector<PhantomTube>& tubes, const Orientation& orientation,
                                   const OrientationsOptions& options = {},
                                   const core::TaskContext& task = core::no_task());
std::vector<OrientationRun> measure_orientations(const std::vector<PhantomTube>& tubes,
                                                 const std::vector<Orientation>& orientations,
                                                 const OrientationsOptions& options = {},
                                                 const core::TaskContext& task = core::no_task());

/// What of a tube is compared.
enum class TubeQuantity { length, radius, grey_radius };
double value_of(const TubeMeasure& measure, TubeQuantity quantity);

/// Pairs for agreement, found tubes only: each value against the tube's mean over the orientations (what the
/// paper plots) or against the truth.
struct QuantityPairs {
  std::vector<double> reference, result;
};
QuantityPairs against_mean(const std::vector<OrientationRun>& runs, TubeQuantity quantity);
QuantityPairs against_truth(const std::vector<OrientationRun>& runs, TubeQuantity quantity);

struct OrientationsSummary {
  std::size_t pairs = 0, missing = 0, split = 0;  ///< tubes found; not found; found as several lines
  /// Twice the standard deviation of a tube's values about their mean over the orientations: the squares of
  /// all tubes over pairs less tubes, since each has a mean of its own.
  double two_sd_mm = 0.0;
  double farthest_mm = 0.0;                     ///< of a value from its mean
  std::size_t beyond = 0;                       ///< values farther from their mean than two_sd_mm
  double bias_mm = 0.0, two_sd_truth_mm = 0.0;  ///< against the truth
};
/// Throws InvalidInput for fewer than two orientations or where fewer than two tubes were found.
OrientationsSummary summarize(const std::vector<OrientationRun>& runs, TubeQuantity quantity);

}  // namespace ostia::experiments
