#include "ostia/evaluation/roc.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ostia::evaluation {
namespace {

constexpr double z_of_95_percent = 1.959963984540054;

void check_scores(const std::vector<double>& score, const std::vector<bool>& has) {
  if (score.size() != has.size())
    throw InvalidInput("cannot make a ROC curve: " + std::to_string(score.size()) + " scores and " +
                       std::to_string(has.size()) + " truths; give one for each");
  if (!std::ranges::all_of(score, [](double value) { return std::isfinite(value); }))
    throw InvalidInput("cannot make a ROC curve: a score is not finite; leave it out");
  const auto positive = std::ranges::count(has, true);
  if (positive == 0 || static_cast<std::size_t>(positive) == has.size())
    throw InvalidInput("cannot make a ROC curve: of " + std::to_string(has.size()) + ", " +
                       (positive == 0 ? "nobody" : "everybody") + " has it; both are needed");
}

/// Of each value the share of `others`, sorted, that lie below it, ties counting half.
std::vector<double> placements(const std::vector<double>& values, const std::vector<double>& others) {
  std::vector<double> out;
  for (const double value : values) {
    const auto [from, to] = std::ranges::equal_range(others, value);
    const double below = static_cast<double>(from - others.begin()), same = static_cast<double>(to - from);
    out.push_back((below + 0.5 * same) / static_cast<double>(others.size()));
  }
  return out;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Of the mean.
double variance_of_mean(const std::vector<double>& values) {
  if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double mean = mean_of(values), count = static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / (count - 1.0) / count;
}

std::vector<RocPoint> curve_of(std::vector<double> with, std::vector<double> without) {
  std::ranges::sort(with, std::greater{});
  std::ranges::sort(without, std::greater{});
  std::vector<RocPoint> out;
  std::size_t found = 0, wrong = 0;
  while (found < with.size() || wrong < without.size()) {
    const double threshold = found == with.size()      ? without[wrong]
                             : wrong == without.size() ? with[found]
                                                       : std::max(with[found], without[wrong]);
    while (found < with.size() && with[found] >= threshold) ++found;
    while (wrong < without.size() && without[wrong] >= threshold) ++wrong;
    out.push_back({threshold, static_cast<double>(found) / static_cast<double>(with.size()),
                   1.0 - static_cast<double>(wrong) / static_cast<double>(without.size())});
  }
  return out;
}

}  // namespace

Interval wilson_interval(std::size_t count, std::size_t all) {
  if (all == 0 || count > all)
    throw InvalidInput("there is no share of " + std::to_string(count) + " in " + std::to_string(all));
  const double n = static_cast<double>(all), share = static_cast<double>(count) / n;
  const double z = z_of_95_percent, scale = 1.0 + z * z / n;
  const double middle = (share + z * z / (2.0 * n)) / scale;
  const double half = z * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n)) / scale;
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Roc roc(const std::vector<double>& score, const std::vector<bool>& has) {
  check_scores(score, has);
  std::vector<double> with, without;
  for (std::size_t i = 0; i < score.size(); ++i) (has[i] ? with : without).push_back(score[i]);
  std::ranges::sort(with);
  std::ranges::sort(without);
  Roc out;
  out.positive = with.size();
  out.negative = without.size();
  const std::vector<double> of_with = placements(with, without), of_without = placements(without, with);
  out.area = mean_of(of_with);
  out.area_error = std::sqrt(variance_of_mean(of_with) + variance_of_mean(of_without));
  out.area_interval = {std::max(0.0, out.area - z_of_95_percent * out.area_error),
                       std::min(1.0, out.area + z_of_95_percent * out.area_error)};
  if (std::isnan(out.area_error)) out.area_interval = {out.area_error, out.area_error};
  out.curve = curve_of(with, without);
  const auto youden = [](const RocPoint& point) { return point.sensitivity + point.specificity; };
  out.best = out.curve.front();
  for (const RocPoint& point : out.curve)
    if (youden(point) > youden(out.best) + 1e-12) out.best = point;  // as much is not more
  const auto count_of = [](double share, std::size_t all) {
    return static_cast<std::size_t>(std::lround(share * static_cast<double>(all)));
  };
  out.sensitivity_interval = wilson_interval(count_of(out.best.sensitivity, out.positive), out.positive);
  out.specificity_interval = wilson_interval(count_of(out.best.specificity, out.negative), out.negative);
  return out;
}

}  // namespace ostia::evaluation
