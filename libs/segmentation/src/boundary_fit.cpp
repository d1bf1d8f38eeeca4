#include "boundary_fit.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::segmentation {
namespace {

/// Energies of one ray's candidates.
struct RayEnergy {
  int first = 0;
  std::vector<double> value;
};

/// Weights of the smooth surface's equations, one a ray.
struct Smoother {
  int rows = 0, around = 0;
  double along = 0.0;
  std::vector<double> across;  ///< one a row
  double pull = 0.0;
  std::size_t at(int row, int a) const {
    return static_cast<std::size_t>(row) * around + static_cast<std::size_t>((a + around) % around);
  }
  /// y = (pull + along D2s' D2s + across D2t' D2t) x
  void apply(const std::vector<double>& x, std::vector<double>& y) const;
  void solve(const std::vector<double>& target, std::vector<double>& x) const;
};

void Smoother::apply(const std::vector<double>& x, std::vector<double>& y) const {
  for (std::size_t n = 0; n < x.size(); ++n) y[n] = pull * x[n];
  for (int r = 0; r < rows; ++r) {
    for (int a = 0; a < around; ++a) {
      const double bend = x[at(r, a - 1)] - 2.0 * x[at(r, a)] + x[at(r, a + 1)];
      y[at(r, a - 1)] += across[r] * bend;
      y[at(r, a)] -= 2.0 * across[r] * bend;
      y[at(r, a + 1)] += across[r] * bend;
      if (r == 0 || r + 1 == rows) continue;
      const double bend_s = x[at(r - 1, a)] - 2.0 * x[at(r, a)] + x[at(r + 1, a)];
      y[at(r - 1, a)] += along * bend_s;
      y[at(r, a)] -= 2.0 * along * bend_s;
      y[at(r + 1, a)] += along * bend_s;
    }
  }
}

/// Conjugate gradients from x; sums in one order, so the same for any number of threads.
void Smoother::solve(const std::vector<double>& target, std::vector<double>& x) const {
  const std::size_t n = x.size();
  std::vector<double> residual(n), direction(n), image(n);
  apply(x, image);
  double norm = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    residual[i] = pull * target[i] - image[i];
    direction[i] = residual[i];
    norm += residual[i] * residual[i];
  }
  const double enough = 1e-6 * norm;
  for (int round = 0; round < 120 && norm > enough; ++round) {
    apply(direction, image);
    double curvature = 0.0;
    for (std::size_t i = 0; i < n; ++i) curvature += direction[i] * image[i];
    const double step = norm / curvature;
    double next = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += step * direction[i];
      residual[i] -= step * image[i];
      next += residual[i] * residual[i];
    }
    for (std::size_t i = 0; i < n; ++i) direction[i] = residual[i] + next / norm * direction[i];
    norm = next;
  }
}

/// Minimum of weight * energy + pull / 2 (r - x)^2 over the candidates, between them by a parabola.
double best_candidate(const RayEnergy& energy, const EdgeProfile& profile, double weight, double pull,
                      double x) {
  const auto cost = [&](int i) {
    const double d = profile.radius(energy.first + i) - x;
    return weight * energy.value[i] + 0.5 * pull * d * d;
  };
  const int n = static_cast<int>(energy.value.size());
  int best = 0;
  double least = cost(0);
  for (int i = 1; i < n; ++i) {
    const double c = cost(i);
    if (c < least) least = c, best = i;
  }
  double shift = 0.0;
  if (best > 0 && best + 1 < n) {
    const double before = cost(best - 1), after = cost(best + 1);
    const double bend = before - 2.0 * least + after;
    if (bend > 1e-12) shift = std::clamp(0.5 * (before - after) / bend, -0.5, 0.5);
  }
  return profile.radius(energy.first + best) + shift * (profile.radius(1) - profile.radius(0));
}

/// How much worse a boundary 0.3 mm to either side would be.
float clearness(const RayEnergy& energy, const EdgeProfile& profile, double radius) {
  const double step = profile.radius(1) - profile.radius(0);
  const auto at = [&](double r) {
    const double x = std::clamp((r - profile.radius(energy.first)) / step, 0.0,
                                static_cast<double>(energy.value.size()) - 1.0);
    const auto i = static_cast<std::size_t>(std::min(x, std::max(0.0, energy.value.size() - 2.0)));
    if (energy.value.size() < 2) return energy.value[0];
    return energy.value[i] + (x - static_cast<double>(i)) * (energy.value[i + 1] - energy.value[i]);
  };
  const double gain = std::min(at(radius - 0.3), at(radius + 0.3)) - at(radius);
  return static_cast<float>(1.0 - std::exp(-0.25 * std::max(0.0, gain)));
}

}  // namespace

BoundaryFit fit_boundary(const RayFan& fan, const std::vector<double>& lumen_hu,
                         const std::vector<double>& radius_mm, const std::vector<float>& calcium_odds,
                         const EdgeProfile& profile, const BoundaryFitOptions& options,
                         const core::TaskContext& task) {
  const std::size_t rays = radius_mm.size();
  std::vector<RayEnergy> energy(rays);
  core::parallel_for(static_cast<std::size_t>(fan.rows), 4, [&](std::size_t r) {
    task.throw_if_cancelled();
    for (int a = 0; a < fan.around; ++a) {
      const std::size_t n = r * fan.around + a;
      int first = 0, last = 0;
      profile.candidates(radius_mm[n], first, last);
      const int start = profile.window(radius_mm[n]);
      energy[n].first = first;
      for (int k = first; k <= last; ++k) {
        energy[n].value.push_back(
            profile.energy(fan.ray(static_cast<int>(r), a), start, k, lumen_hu[r], calcium_odds[n]));
      }
    }
  });

  Smoother smoother;
  smoother.rows = fan.rows;
  smoother.around = fan.around;
  const double bend_s = options.bend_along_per_mm * options.row_step_mm * options.row_step_mm;
  const double turn = 2.0 * std::numbers::pi / fan.around;
  smoother.along = 1.0 / (bend_s * bend_s);
  for (int r = 0; r < fan.rows; ++r) {
    double mean = 0.0;
    for (int a = 0; a < fan.around; ++a) mean += radius_mm[smoother.at(r, a)] / fan.around;
    const double bend = options.bend_around * std::max(mean, 0.4) * turn * turn;
    smoother.across.push_back(1.0 / (bend * bend));
  }
  // Splitting: the rays' own best places and the smooth surface, drawn to each other more and more.
  std::vector<double> smooth = radius_mm, own(rays);
  for (int round = 0; round < 16; ++round) {
    task.throw_if_cancelled();
    smoother.pull = 5.0 * std::pow(1.35, round);
    for (std::size_t n = 0; n < rays; ++n) {
      own[n] = best_candidate(energy[n], profile, options.data_weight, smoother.pull, smooth[n]);
    }
    smoother.solve(own, smooth);
  }
  BoundaryFit out{std::move(smooth), std::vector<float>(rays)};
  for (std::size_t n = 0; n < rays; ++n) {
    out.radius_mm[n] = std::max(out.radius_mm[n], profile.radius(0));
    out.confidence[n] = clearness(energy[n], profile, out.radius_mm[n]);
  }
  return out;
}

}  // namespace ostia::segmentation
