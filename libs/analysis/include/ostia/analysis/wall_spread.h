#pragma once
/// \file How far a section's wall may be from the true one, by what its image shows
/// (docs/methods/pressure-uncertainty.md).

#include "ostia/analysis/wall_evidence.h"

#include <vector>

namespace ostia::analysis {

/// Standard deviation of a section's mean radius r, with r' and r'' its slope and bend along the axis:
///
///     sd^2 = scale^2 ((noise e)^2 blur / r + (size blur^2 / r)^2 + (slope blur r')^2 + (bend blur^2 r'')^2)
///            + (unseen h blur)^2,                                          e = sqrt(2 pi) N blur / contrast
///
/// e is how far the image's noise N moves the steepest place of a blurred edge on one ray; a wide section has
/// more rays that see noise of their own. The other terms are there whatever the noise: a lumen not much
/// wider than the blur, and one that changes within it, is seen with what lies beside it. h is the share of
/// the ring behind which the wall is not seen: calcium, or no clear edge. Factors were chosen on one set of
/// phantoms and judged on another (docs/experiments/wall-spread.md); `unseen` is a choice.
struct WallSpreadModel {
  double scale = 0.56;  ///< so that 95 % of the true radii lie within 1.96 sd; all factors are in [0, 10]
  double noise = 0.22, size = 0.2, slope = 1.5, bend = 2.5;
  double unseen = 0.5;
  double most_mm = 0.5;    ///< where hardly anything is seen, [0.05, 1]
  double reach_mm = 10.0;  ///< to either side: where contrast and blur are looked for, [0, 50]
};
void validate(const WallSpreadModel& model);  ///< throws InvalidInput

/// One a section of `evidence` (in the order of s), mm. A narrow lumen is dim and has no edge of its own that
/// could be told from its width; so contrast is the upper quartile, and blur the median, of the sections
/// about it. `most_mm` where the image shows nothing (outside of it, shut, no edge within reach).
std::vector<double> radius_spreads_mm(const std::vector<WallEvidence>& evidence, double noise_hu,
                                      const WallSpreadModel& model = {});

}  // namespace ostia::analysis
