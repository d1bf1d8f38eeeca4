#pragma once
/// \file How well a figure tells who has something: ROC curves.

#include "ostia/evaluation/agreement.h"

#include <cstddef>
#include <vector>

namespace ostia::evaluation {

struct RocPoint {
  double threshold = 0.0;  ///< a score of at least this much is called positive
  double sensitivity = 0.0, specificity = 0.0;
};

struct Roc {
  std::size_t positive = 0, negative = 0;
  double area = 0.0;        ///< under the curve: the chance that who has it scores higher, ties counting half
  double area_error = 0.0;  ///< standard error (DeLong et al., Biometrics 1988;44:837-845); NaN for fewer
                            ///< than two of either
  Interval area_interval{};     ///< 95 %, area -+ 1.96 errors within [0, 1]
  std::vector<RocPoint> curve;  ///< from the strictest threshold to the laxest; none at (0, 0)
  RocPoint best;                ///< greatest sensitivity + specificity (Youden 1950), the strictest of them
  Interval sensitivity_interval{}, specificity_interval{};  ///< of it, 95 % (Wilson 1927)
};

/// `has[i]` is the truth of `score[i]`; who has it is expected to score higher. Throws InvalidInput for other
/// lengths, scores that are not finite, and where nobody or everybody has it.
Roc roc(const std::vector<double>& score, const std::vector<bool>& has);

/// Wilson's 95 % interval of a share (Journal of the American Statistical Association 1927;22:209-212).
/// Throws InvalidInput for none of none, or more than all.
Interval wilson_interval(std::size_t count, std::size_t all);

}  // namespace ostia::evaluation
