#include "ostia/evaluation/agreement.h"

#include "ostia/core/error.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace ostia::evaluation {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
  const double ma = mean_of(a), mb = mean_of(b);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    ab += (a[i] - ma) * (b[i] - mb);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : none;
}

double share(std::size_t part, std::size_t rest) {
  return part + rest > 0 ? static_cast<double>(part) / static_cast<double>(part + rest) : none;
}

}  // namespace

BlandAltman bland_altman(const std::vector<double>& reference, const std::vector<double>& result) {
  if (reference.size() != result.size() || reference.size() < 2)
    throw InvalidInput("agreement needs at least two pairs of values; there are " +
                       std::to_string(reference.size()) + " and " + std::to_string(result.size()) + " values");
  std::vector<double> differences;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (!std::isfinite(reference[i]) || !std::isfinite(result[i]))
      throw InvalidInput("agreement: pair " + std::to_string(i) + " is not finite");
    differences.push_back(result[i] - reference[i]);
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
  out.correlation = correlation_of(reference, result);
  return out;
}

int grade_category(double stenosis) {
  if (stenosis < 0.05) return 0;
  if (stenosis < 0.25) return 1;
  if (stenosis < 0.50) return 2;
  if (stenosis < 0.70) return 3;
  return stenosis < 1.0 ? 4 : 5;
}

double weighted_kappa(const std::vector<std::array<int, 2>>& ratings, int categories) {
  if (ratings.empty() || categories < 2) throw InvalidInput("kappa needs ratings and at least two categories");
  const auto k = static_cast<std::size_t>(categories);
  std::vector<double> first(k, 0.0), second(k, 0.0);
  double observed = 0.0;
  for (const auto& [a, b] : ratings) {
    if (a < 0 || b < 0 || a >= categories || b >= categories)
      throw InvalidInput("kappa: a rating is none of the " + std::to_string(categories) + " categories");
    first[static_cast<std::size_t>(a)] += 1.0;
    second[static_cast<std::size_t>(b)] += 1.0;
    observed += std::abs(a - b);
  }
  const auto n = static_cast<double>(ratings.size());
  double expected = 0.0;
  for (int a = 0; a < categories; ++a)
    for (int b = 0; b < categories; ++b)
      expected += std::abs(a - b) * first[static_cast<std::size_t>(a)] * second[static_cast<std::size_t>(b)] / n;
  return expected > 0.0 ? 1.0 - observed / expected : none;
}

StenosisDetection detect_stenoses(const std::vector<GradedPlace>& places, double threshold) {
  if (places.empty()) throw InvalidInput("there is no place to look for stenoses");
  StenosisDetection out;
  std::vector<std::array<int, 2>> ratings;
  double sum = 0.0;
  for (const GradedPlace& p : places) {
    const bool there = p.reference >= threshold, seen = p.result >= threshold;
    ++(there ? (seen ? out.true_positive : out.false_negative)
             : (seen ? out.false_positive : out.true_negative));
    sum += std::abs(p.result - p.reference);
    ratings.push_back({grade_category(p.reference), grade_category(p.result)});
  }
  out.sensitivity = share(out.true_positive, out.false_negative);
  out.ppv = share(out.true_positive, out.false_positive);
  out.mean_grade_difference = sum / static_cast<double>(places.size());
  out.weighted_kappa = weighted_kappa(ratings, 6);
  return out;
}

}  // namespace ostia::evaluation
