#pragma once
/// \file Which input a result's variance comes from.

#include <span>

namespace ostia::hemodynamics {

struct SobolIndex {
  double first = 0.0;  ///< share of the variance by this input alone
  double total = 0.0;  ///< with all that it does together with others
};

/// Of a function's values on rows A and B, drawn independently, and on A with one input's (or group's)
/// columns of B (Saltelli et al. 2010, Comput Phys Commun 181:259). Total: Jansen 1999. First: Saltelli's
/// estimator, sure where the index is small, and Janon et al.'s (2014, ESAIM P&S 18:342), sure where it is
/// large, weighted by the total one. Rows with a value that is no number are left out; both are 0 where the
/// values do not vary. Throws InvalidInput for different numbers of rows.
SobolIndex sobol_index(std::span<const double> a, std::span<const double> b, std::span<const double> mixed);

}  // namespace ostia::hemodynamics
