#include "motion/lbfgs.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace ostia::experiments {
namespace {

using Eigen::VectorXd;

constexpr std::size_t kept_steps = 8;
constexpr double enough_descent = 1e-4, enough_bend = 0.9;  // of the Wolfe conditions
constexpr int most_trials = 40;

struct LineStep {
  VectorXd way, change;  // of place and gradient
  double inverse = 0.0;  // of their product
};

/// The two loops of Nocedal 1980: minus the approximate inverse of the second derivatives times the gradient.
VectorXd direction(const std::deque<LineStep>& steps, const VectorXd& gradient) {
  if (steps.empty()) return -gradient / gradient.norm();
  VectorXd d = -gradient;
  std::vector<double> shares(steps.size());
  for (std::size_t i = steps.size(); i-- > 0;) {
    shares[i] = steps[i].inverse * steps[i].way.dot(d);
    d -= shares[i] * steps[i].change;
  }
  d *= 1.0 / (steps.back().inverse * steps.back().change.squaredNorm());
  for (std::size_t i = 0; i < steps.size(); ++i)
    d += (shares[i] - steps[i].inverse * steps[i].change.dot(d)) * steps[i].way;
  return d;
}

/// A place on the line that the Wolfe conditions allow, by doubling and halving (Lewis and Overton 2013).
/// False where there is none to be found.
bool search(const SmoothFunction& function, const VectorXd& from, const VectorXd& along, Minimum& at,
            VectorXd& gradient) {
  const double before = at.value, slope = gradient.dot(along);
  if (!(slope < 0.0)) return false;
  double low = 0.0, high = std::numeric_limits<double>::infinity(), length = 1.0;
  VectorXd now(gradient.size());
  for (int k = 0; k < most_trials; ++k) {
    const VectorXd place = from + length * along;
    const double value = function(place, now);
    ++at.evaluations;
    if (!(value <= before + enough_descent * length * slope)) {
      high = length;
    } else if (now.dot(along) < enough_bend * slope) {
      low = length;
    } else {
      at.place = place;
      at.value = value;
      gradient = now;
      return true;
    }
    length = std::isfinite(high) ? 0.5 * (low + high) : 2.0 * length;
  }
  return false;
}

}  // namespace

Minimum minimise(const SmoothFunction& function, VectorXd start, int most_iterations, double tolerance,
                 const core::TaskContext& task) {
  Minimum at;
  at.place = std::move(start);
  VectorXd gradient(at.place.size());
  at.value = function(at.place, gradient);
  ++at.evaluations;
  std::deque<LineStep> steps;
  while (at.iterations < most_iterations) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(at.iterations) / most_iterations);
    at.converged = !(gradient.squaredNorm() > 0.0);
    if (at.converged) break;
    const VectorXd place = at.place, slope = gradient;
    const double before = at.value;
    if (!search(function, place, direction(steps, gradient), at, gradient)) {
      // What is known of the second derivatives misleads: once more without, then it is as low as it gets.
      at.converged = steps.empty();
      if (at.converged) break;
      steps.clear();
      continue;
    }
    ++at.iterations;
    LineStep step{at.place - place, gradient - slope};
    const double product = step.way.dot(step.change);
    if (product > 0.0) {
      step.inverse = 1.0 / product;
      steps.push_back(std::move(step));
      if (steps.size() > kept_steps) steps.pop_front();
    }
    at.converged = before - at.value <= tolerance * std::max({std::abs(before), std::abs(at.value), 1.0});
    if (at.converged) break;
  }
  return at;
}

}  // namespace ostia::experiments
