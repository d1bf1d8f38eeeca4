#include "ostia/evaluation/agreement.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

namespace ostia::evaluation {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

/// Sums of squares and products about the means.
struct Moments {
  double mean_a = 0.0, mean_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
};

Moments moments_of(const std::vector<double>& a, const std::vector<double>& b) {
  Moments m{mean_of(a), mean_of(b)};
  for (std::size_t i = 0; i < a.size(); ++i) {
    m.aa += (a[i] - m.mean_a) * (a[i] - m.mean_a);
    m.bb += (b[i] - m.mean_b) * (b[i] - m.mean_b);
    m.ab += (a[i] - m.mean_a) * (b[i] - m.mean_b);
  }
  return m;
}

void require_pairs(const std::vector<double>& reference, const std::vector<double>& result) {
  if (reference.size() != result.size() || reference.size() < 2)
    throw InvalidInput("agreement needs at least two pairs of values; there are " +
                       std::to_string(reference.size()) + " and " + std::to_string(result.size()) +
                       " values");
  for (std::size_t i = 0; i < reference.size(); ++i)
    if (!std::isfinite(reference[i]) || !std::isfinite(result[i]))
      throw InvalidInput("agreement: pair " + std::to_string(i) + " is not finite");
}

void add_regression(const std::vector<double>& means, const std::vector<double>& differences,
                    BlandAltman& out) {
  const Moments m = moments_of(means, differences);
  out.slope = out.intercept = out.slope_error = not_known;
  if (!(m.aa > 0.0)) return;
  out.slope = m.ab / m.aa;
  out.intercept = m.mean_b - out.slope * m.mean_a;
  if (out.count < 3) return;
  const double rest = std::max(0.0, m.bb - out.slope * m.ab);
  out.slope_error = std::sqrt(rest / static_cast<double>(out.count - 2) / m.aa);
}

/// Probability of |T| < t, T of Student's distribution (Abramowitz and Stegun 26.7.3 and 26.7.4).
double central_probability(double t, std::size_t degrees) {
  const double angle = std::atan(t / std::sqrt(static_cast<double>(degrees)));
  const double c = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double sum = 0.0, term = odd ? c : 1.0;
  for (std::size_t k = odd ? 1 : 0; k + 2 <= degrees; k += 2) {
    sum += term;
    const auto n = static_cast<double>(k);
    term *= (n + 1.0) / (n + 2.0) * c * c;
  }
  if (!odd) return std::sin(angle) * sum;
  return 2.0 / std::numbers::pi * (angle + std::sin(angle) * sum);
}

double share(std::size_t part, std::size_t rest) {
  return part + rest > 0 ? static_cast<double>(part) / static_cast<double>(part + rest) : not_known;
}

}  // namespace

double student_t(double probability, std::size_t degrees_of_freedom) {
  if (degrees_of_freedom == 0) throw InvalidInput("Student's t needs at least one degree of freedom");
  if (!(probability > 0.0 && probability < 1.0))
    throw InvalidInput("a probability of Student's t must lie in (0, 1)");
  // More degrees than these change the fifth digit of t no more.
  const std::size_t degrees = std::min<std::size_t>(degrees_of_freedom, 100000);
  double low = 0.0, high = 1.0;
  while (high < 1e12 && central_probability(high, degrees) < probability) high *= 2.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (central_probability(middle, degrees) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

BlandAltman bland_altman(const std::vector<double>& reference, const std::vector<double>& result) {
  require_pairs(reference, result);
  std::vector<double> differences, means;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    differences.push_back(result[i] - reference[i]);
    means.push_back(0.5 * (result[i] + reference[i]));
  }
  BlandAltman out;
  out.count = differences.size();
  const auto n = static_cast<double>(out.count);
  out.bias = mean_of(differences);
  double sum = 0.0;
  for (const double d : differences) sum += (d - out.bias) * (d - out.bias);
  out.sd = std::sqrt(sum / (n - 1.0));
  out.lower_limit = out.bias - 1.96 * out.sd;
  out.upper_limit = out.bias + 1.96 * out.sd;
  out.bias_error = out.sd / std::sqrt(n);
  out.limit_error = std::sqrt(3.0 / n) * out.sd;
  const double t = student_t(0.95, out.count - 1);
  const auto around = [t](double value, double error) {
    return Interval{value - t * error, value + t * error};
  };
  out.bias_interval = around(out.bias, out.bias_error);
  out.lower_limit_interval = around(out.lower_limit, out.limit_error);
  out.upper_limit_interval = around(out.upper_limit, out.limit_error);
  const Moments m = moments_of(reference, result);
  out.correlation = m.aa > 0.0 && m.bb > 0.0 ? m.ab / std::sqrt(m.aa * m.bb) : not_known;
  add_regression(means, differences, out);
  return out;
}

double concordance_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  require_pairs(a, b);
  const Moments m = moments_of(a, b);
  const double shift = m.mean_a - m.mean_b;
  const double all = m.aa + m.bb + static_cast<double>(a.size()) * shift * shift;
  return all > 0.0 ? 2.0 * m.ab / all : not_known;
}

double intraclass_correlation(const std::vector<std::vector<double>>& ratings) {
  const std::size_t rows = ratings.size(), raters = rows > 0 ? ratings[0].size() : 0;
  if (rows < 2 || raters < 2) throw InvalidInput("an intraclass correlation needs two rows and two raters");
  std::vector<double> by_row, by_rater(raters, 0.0);
  for (const std::vector<double>& row : ratings) {
    if (row.size() != raters) throw InvalidInput("intraclass correlation: rows of other lengths");
    for (std::size_t j = 0; j < raters; ++j) {
      if (!std::isfinite(row[j])) throw InvalidInput("intraclass correlation: a rating is not finite");
      by_rater[j] += row[j] / static_cast<double>(rows);
    }
    by_row.push_back(mean_of(row));
  }
  const double mean = mean_of(by_row);
  const auto n = static_cast<double>(rows), k = static_cast<double>(raters);
  double between_rows = 0.0, between_raters = 0.0, rest = 0.0;
  for (const double m : by_row) between_rows += k * (m - mean) * (m - mean) / (n - 1.0);
  for (const double m : by_rater) between_raters += n * (m - mean) * (m - mean) / (k - 1.0);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < raters; ++j) {
      const double e = ratings[i][j] - by_row[i] - by_rater[j] + mean;
      rest += e * e / ((n - 1.0) * (k - 1.0));
    }
  const double all = between_rows + (k - 1.0) * rest + k / n * (between_raters - rest);
  return all > 0.0 ? (between_rows - rest) / all : not_known;
}

int grade_category(double stenosis) {
  if (stenosis < 0.05) return 0;
  if (stenosis < 0.25) return 1;
  if (stenosis < 0.50) return 2;
  if (stenosis < 0.70) return 3;
  return stenosis < 1.0 ? 4 : 5;
}

double weighted_kappa(const std::vector<std::array<int, 2>>& ratings, int categories, KappaWeights weights) {
  if (ratings.empty() || categories < 2)
    throw InvalidInput("kappa needs ratings and at least two categories");
  const auto weight = [weights](int a, int b) {
    const double d = std::abs(a - b);
    if (weights == KappaWeights::none) return d > 0.0 ? 1.0 : 0.0;
    return weights == KappaWeights::linear ? d : d * d;
  };
  const auto k = static_cast<std::size_t>(categories);
  std::vector<double> first(k, 0.0), second(k, 0.0);
  double observed = 0.0;
  for (const auto& [a, b] : ratings) {
    if (a < 0 || b < 0 || a >= categories || b >= categories)
      throw InvalidInput("kappa: a rating is none of the " + std::to_string(categories) + " categories");
    first[static_cast<std::size_t>(a)] += 1.0;
    second[static_cast<std::size_t>(b)] += 1.0;
    observed += weight(a, b);
  }
  const auto n = static_cast<double>(ratings.size());
  double expected = 0.0;
  for (int a = 0; a < categories; ++a)
    for (int b = 0; b < categories; ++b)
      expected += weight(a, b) * first[static_cast<std::size_t>(a)] * second[static_cast<std::size_t>(b)] / n;
  return expected > 0.0 ? 1.0 - observed / expected : not_known;
}

StenosisDetection detect_stenoses(const std::vector<GradedPlace>& places, double threshold) {
  if (places.empty()) throw InvalidInput("there is no place to look for stenoses");
  StenosisDetection out;
  std::vector<std::array<int, 2>> ratings;
  double sum = 0.0, squares = 0.0;
  for (const GradedPlace& p : places) {
    if (!std::isfinite(p.reference) || !std::isfinite(p.result))
      throw InvalidInput("the grade of place " + std::to_string(ratings.size()) + " is not finite");
    const bool there = p.reference >= threshold, seen = p.result >= threshold;
    ++(there ? (seen ? out.true_positive : out.false_negative)
             : (seen ? out.false_positive : out.true_negative));
    sum += std::abs(p.result - p.reference);
    squares += (p.result - p.reference) * (p.result - p.reference);
    ratings.push_back({grade_category(p.reference), grade_category(p.result)});
  }
  out.sensitivity = share(out.true_positive, out.false_negative);
  out.ppv = share(out.true_positive, out.false_positive);
  out.mean_grade_difference = sum / static_cast<double>(places.size());
  out.rms_grade_difference = std::sqrt(squares / static_cast<double>(places.size()));
  out.weighted_kappa = weighted_kappa(ratings, grade_categories);
  return out;
}

}  // namespace ostia::evaluation
