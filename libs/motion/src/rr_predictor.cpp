#include "ostia/core/error.h"
#include "ostia/motion/heart_phase.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ostia::motion {
namespace {

constexpr double strange_share = 0.12;  // chosen on record 100: 33 premature beats, sinus rhythm within
constexpr double forgetting = 0.995;    // of recursive least squares; about 200 beats
constexpr double first_covariance = 10.0, most_covariance = 1e4;
constexpr int new_rate_after = 3;

}  // namespace

RrPredictor::RrPredictor() : weights_(order, 0.0), covariance_(order * order, 0.0) {
  for (std::size_t i = 0; i < order; ++i) covariance_[i * order + i] = first_covariance;
}

double RrPredictor::median() const {
  std::vector<double> sorted = last_;
  std::sort(sorted.begin(), sorted.end());
  return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2.0;
}

double RrPredictor::mean() const {
  return std::accumulate(last_.begin(), last_.end(), 0.0) / static_cast<double>(last_.size());
}

double RrPredictor::guess() const {
  const double centre = mean();
  double value = centre;
  if (last_.size() >= order)
    for (std::size_t i = 0; i < order; ++i) value += weights_[i] * (last_[last_.size() - 1 - i] - centre);
  const double middle = median();
  return std::clamp(value, middle * (1.0 - strange_share), middle * (1.0 + strange_share));
}

std::optional<double> RrPredictor::next() const {
  if (last_.empty()) return std::nullopt;
  return guess();
}

/// One step of recursive least squares towards an interval.
void RrPredictor::fit(double interval) {
  if (last_.size() < kept) return;
  const double centre = mean();
  std::vector<double> x(order), gain(order, 0.0);
  double largest = 0.0;
  for (std::size_t i = 0; i < order; ++i) largest = std::max(largest, covariance_[i * order + i]);
  // where nothing new is learned the covariance would grow without bound: then nothing is forgotten either
  const double keep = largest >= most_covariance ? 1.0 : forgetting;
  double error = interval - centre, scale = keep;
  for (std::size_t i = 0; i < order; ++i) {
    x[i] = last_[last_.size() - 1 - i] - centre;
    error -= weights_[i] * x[i];
  }
  for (std::size_t i = 0; i < order; ++i)
    for (std::size_t k = 0; k < order; ++k) gain[i] += covariance_[i * order + k] * x[k];
  for (std::size_t i = 0; i < order; ++i) scale += x[i] * gain[i];
  for (std::size_t i = 0; i < order; ++i) weights_[i] += gain[i] / scale * error;
  for (std::size_t i = 0; i < order; ++i)
    for (std::size_t k = 0; k < order; ++k) {
      double& c = covariance_[i * order + k];
      c = (c - gain[i] * gain[k] / scale) / keep;
    }
}

void RrPredictor::add(double interval) {
  if (!(interval > 0.0) || !std::isfinite(interval))
    throw InvalidInput("an interval between heartbeats of " + std::to_string(interval) + " s cannot be");
  if (!last_.empty() && std::abs(interval / median() - 1.0) > strange_share) {
    strange_.push_back(interval);
    if (++strange_in_a_row_ < new_rate_after) {
      last_.push_back(guess());
    } else {
      last_ = strange_;
    }
  } else {
    fit(interval);
    last_.push_back(interval);
    strange_.clear();
    strange_in_a_row_ = 0;
  }
  if (last_.size() > kept) last_.erase(last_.begin());
  if (strange_.size() > static_cast<std::size_t>(new_rate_after)) strange_.erase(strange_.begin());
}

}  // namespace ostia::motion
