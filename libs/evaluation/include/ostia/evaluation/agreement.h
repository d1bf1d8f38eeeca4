#pragma once
/// \file Agreement of two methods: Bland-Altman statistics, detection and grading of stenoses.

#include <array>
#include <cstddef>
#include <vector>

namespace ostia::evaluation {

/// Of paired values, difference = result - reference (Bland and Altman, The Lancet 1986;327:307-310).
struct BlandAltman {
  std::size_t count = 0;
  double bias = 0.0;                        ///< mean difference
  double sd = 0.0;                          ///< standard deviation of the differences (n - 1)
  double lower_limit = 0.0, upper_limit = 0.0;  ///< bias -+ 1.96 sd: limits of agreement
  double bias_error = 0.0;                  ///< standard error of the bias, sd / sqrt(n)
  double limit_error = 0.0;                 ///< standard error of a limit, about sqrt(3 / n) sd
  double correlation = 0.0;                 ///< Pearson's; NaN where one side does not vary
};
/// Throws InvalidInput for fewer than two pairs, other lengths or values that are not finite.
BlandAltman bland_altman(const std::vector<double>& reference, const std::vector<double>& result);

/// A place graded by reference and result, diameter stenosis in [0, 1].
struct GradedPlace {
  double reference = 0.0, result = 0.0;
};
struct StenosisDetection {
  std::size_t true_positive = 0, false_positive = 0, false_negative = 0, true_negative = 0;
  double sensitivity = 0.0, ppv = 0.0;  ///< NaN where there is nothing to find, or nothing was found
  double mean_grade_difference = 0.0;   ///< mean of |result - reference|, of all places
  double weighted_kappa = 0.0;          ///< linear weights, over the CAD-RADS categories; NaN without variation
};
/// A stenosis is there where the grade is not below `threshold`. Throws InvalidInput without places.
StenosisDetection detect_stenoses(const std::vector<GradedPlace>& places, double threshold = 0.5);
/// 0 none, 1 below 25 %, 2 below 50 %, 3 below 70 %, 4 below 100 %, 5 closed (Cury et al. 2016). What is below
/// 5 % is taken as none.
int grade_category(double diameter_stenosis);
/// Cohen's kappa with linear weights (Cohen 1968) of two raters' categories 0 ... categories - 1.
double weighted_kappa(const std::vector<std::array<int, 2>>& ratings, int categories);

}  // namespace ostia::evaluation
