#pragma once
/// \file Agreement of two methods: Bland-Altman statistics, coefficients of agreement, grades of stenoses.

#include <array>
#include <cstddef>
#include <vector>

namespace ostia::evaluation {

using Interval = std::array<double, 2>;

/// Of paired values, difference = result - reference (Bland and Altman, The Lancet 1986;327:307-310, and
/// Statistical Methods in Medical Research 1999;8:135-160). The pairs are taken as independent.
struct BlandAltman {
  std::size_t count = 0;
  double bias = 0.0;                            ///< mean difference
  double sd = 0.0;                              ///< standard deviation of the differences (n - 1)
  double lower_limit = 0.0, upper_limit = 0.0;  ///< bias -+ 1.96 sd: limits of agreement
  double bias_error = 0.0;                      ///< standard error of the bias, sd / sqrt(n)
  double limit_error = 0.0;                     ///< standard error of a limit, about sqrt(3 / n) sd
  Interval bias_interval{};                     ///< 95 % confidence, Student's t with n - 1
  Interval lower_limit_interval{}, upper_limit_interval{};  ///< likewise
  double correlation = 0.0;                                 ///< Pearson's; NaN where one side does not vary
  /// difference = intercept + slope * mean of both, least squares; NaN where the means do not vary. A slope
  /// more than about two of its errors from 0 says that the bias depends on the size.
  double slope = 0.0, intercept = 0.0;
  double slope_error = 0.0;  ///< standard error of the slope; NaN for fewer than three pairs too
};
/// Throws InvalidInput for fewer than two pairs, other lengths or values that are not finite.
BlandAltman bland_altman(const std::vector<double>& reference, const std::vector<double>& result);

/// Student's t that a variable with that many degrees of freedom stays within, on both sides, with the given
/// probability: 2.120 for 95 % and 16. Throws InvalidInput for no degree of freedom or a probability outside
/// (0, 1).
double student_t(double probability, std::size_t degrees_of_freedom);

/// Lin's concordance correlation, 2 s_ab / (s_a^2 + s_b^2 + (mean_a - mean_b)^2), variances over n
/// (Biometrics 1989;45:255-268). NaN where nothing varies. Throws as bland_altman does.
double concordance_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// ICC(2,1): two-way random effects, absolute agreement, one rater (Shrout and Fleiss, Psychological Bulletin
/// 1979;86:420-428). One row for each thing rated, one value for each rater. NaN where nothing varies. Throws
/// InvalidInput for fewer than two rows or raters, rows of other lengths, values that are not finite.
double intraclass_correlation(const std::vector<std::vector<double>>& ratings);

/// A place graded by reference and result, diameter stenosis in [0, 1].
struct GradedPlace {
  double reference = 0.0, result = 0.0;
};
struct StenosisDetection {
  std::size_t true_positive = 0, false_positive = 0, false_negative = 0, true_negative = 0;
  double sensitivity = 0.0, ppv = 0.0;  ///< NaN where there is nothing to find, or nothing was found
  double mean_grade_difference = 0.0;   ///< mean of |result - reference|, of all places
  double rms_grade_difference = 0.0;    ///< root mean square of result - reference, of all places
  double weighted_kappa = 0.0;  ///< linear weights, over the CAD-RADS categories; NaN without variation
};
/// A stenosis is there where the grade is not below `threshold`. Throws InvalidInput without places, and for
/// a grade that is not finite.
StenosisDetection detect_stenoses(const std::vector<GradedPlace>& places, double threshold = 0.5);

constexpr int grade_categories = 6;
/// 0 none, 1 below 25 %, 2 below 50 %, 3 below 70 %, 4 below 100 %, 5 closed (Cury et al. 2016). What is
/// below 5 % is taken as none.
int grade_category(double diameter_stenosis);

enum class KappaWeights { none, linear, quadratic };  ///< of a disagreement: 1, |a - b|, (a - b)^2
/// Cohen's kappa (Cohen 1960; weighted: 1968) of two raters' categories 0 ... categories - 1. NaN where both
/// raters use one and the same category throughout. Throws InvalidInput for no ratings or unknown categories.
double weighted_kappa(const std::vector<std::array<int, 2>>& ratings, int categories,
                      KappaWeights weights = KappaWeights::linear);

}  // namespace ostia::evaluation
