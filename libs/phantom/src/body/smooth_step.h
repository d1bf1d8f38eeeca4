#pragma once
/// \file A step from 0 to 1 that is twice continuously differentiable.

namespace ostia::phantom {

struct ValueSlope {
  double value = 0.0, slope = 0.0;
};

/// 0 for x <= from, 1 for x >= to. Its slope rises over the first third, stays, and falls over the last: the
/// greatest is 1.5 / (to - from).
inline ValueSlope smooth_step(double x, double from, double to) {
  constexpr double ramp = 1.0 / 3.0, steepest = 1.0 / (1.0 - ramp);
  const double t = (x - from) / (to - from);
  if (t <= 0.0) return {0.0, 0.0};
  if (t >= 1.0) return {1.0, 0.0};
  if (t > ramp && t < 1.0 - ramp) return {steepest * (t - 0.5 * ramp), steepest / (to - from)};
  const double u = (t <= ramp ? t : 1.0 - t) / ramp;
  const double value = steepest * ramp * u * u * u * (1.0 - 0.5 * u);
  return {t <= ramp ? value : 1.0 - value, steepest * u * u * (3.0 - 2.0 * u) / (to - from)};
}

}  // namespace ostia::phantom
