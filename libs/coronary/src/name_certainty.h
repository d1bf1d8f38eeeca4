#pragma once
/// \file What the rules' own measure of fit is worth as a probability.

namespace ostia::coronary {

/// Of all names that the rules give with this measure, [0, 1], how many are right: fitted to synthetic hearts
/// that were turned, cut and thinned out (docs/methods/coronary-labels.md). Grows with the measure.
double as_probability(double measure);

}  // namespace ostia::coronary
