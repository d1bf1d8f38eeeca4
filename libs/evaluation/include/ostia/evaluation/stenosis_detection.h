#pragma once
/// \file Lesions that were found against those that are there.

#include "ostia/evaluation/agreement.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace ostia::evaluation {

/// A narrowed stretch of a vessel.
struct Lesion {
  std::string vessel;                     ///< or segment; the same names in reference and result
  double s_from_mm = 0.0, s_to_mm = 0.0;  ///< along the vessel, from < to
  double s_throat_mm = 0.0;               ///< narrowest place, within the stretch
  double grade = 0.0;                     ///< diameter stenosis in [0, 1]
};

struct LesionPair {
  std::size_t reference = 0, found = 0;  ///< indices
  double overlap_mm = 0.0;
};

struct LesionCounts {
  std::size_t true_positive = 0, false_negative = 0, false_positive = 0;
  double sensitivity() const;  ///< NaN where there is nothing to find
  double ppv() const;          ///< NaN where nothing was found
};

struct LesionDetection {
  LesionCounts all;
  std::map<std::string, LesionCounts> by_vessel;
  std::vector<LesionPair> pairs;         ///< in the order of the reference
  std::vector<std::size_t> missed;       ///< reference lesions without a partner, of any grade
  std::vector<std::size_t> unexplained;  ///< found lesions without a partner, of any grade
  double mean_grade_difference = 0.0;    ///< mean of |found - reference| over the pairs; NaN without
  double rms_grade_difference = 0.0;     ///< likewise, root mean square
  double mean_throat_distance_mm = 0.0;  ///< likewise, of the narrowest places
  double weighted_kappa = 0.0;  ///< linear, of the CAD-RADS categories; a lesion without a partner meets
                                ///< category 0; NaN without lesions or variation
};

/// Lesions of the same vessel whose stretches overlap are paired one to one, those of the largest share of
/// overlap (shared length over joint length) first, then by index. A pair is a true positive where both
/// grades reach `threshold`. Every other lesion that reaches it is a false negative (reference) or a false
/// positive (found): a 48 % lesion graded 52 % is one (Kirisli et al., Medical Image Analysis 17:859-876,
/// 2013 judge by segment with 50 %; give segments' names as `vessel` for that). Throws InvalidInput for
/// lesions without a vessel, with stretches that are empty or not finite, a throat outside them, a grade
/// outside [0, 1].
LesionDetection detect_lesions(const std::vector<Lesion>& reference, const std::vector<Lesion>& found,
                               double threshold = 0.5);

}  // namespace ostia::evaluation
