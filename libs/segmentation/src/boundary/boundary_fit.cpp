#include "boundary/boundary_fit.h"

#include "ostia/core/parallel.h"
#include "ostia/core/simd.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::segmentation {
namespace {

/// Numbers one at a time, and as many as the processor takes at once; each result has the same bits.
struct OneNumber {
  static double get(const double* p) { return *p; }
  static double all(double v) { return v; }
  static void put(double* p, double v) { *p = v; }
};
struct PackOfNumbers {
  static core::simd::DoublePack get(const double* p) { return core::simd::load(p); }
  static core::simd::DoublePack all(double v) { return core::simd::all(v); }
  static void put(double* p, core::simd::DoublePack v) { core::simd::store(p, v); }
};

/// `work(how, i)` for numbers [first, last), packs as far as they fit.
template <class Work>
void over_packs(std::size_t first, std::size_t last, const Work& work) {
  constexpr std::size_t size = core::simd::double_pack_size;
  for (; first + size <= last; first += size) work(PackOfNumbers(), first);
  for (; first < last; ++first) work(OneNumber(), first);
}

/// The smooth surface's equations.
struct Smoother {
  int rows = 0, around = 0;
  std::vector<double> along, across;  ///< weights of bends along and around, one a row
  std::vector<double> expected;       ///< bend along the vessel, one a row, mm
  double pull = 0.0;
  std::size_t at(int row, int a) const {
    return static_cast<std::size_t>(row) * around + static_cast<std::size_t>((a + around) % around);
  }
  /// y = (pull + D2s' along D2s + D2t' across D2t) x
  void apply(const std::vector<double>& x, std::vector<double>& y) const;
  void bend(const std::vector<double>& x) const;  ///< fills across_ and along_
  /// pull (target - x) + D2s' along (expected - D2s x) - D2t' across D2t x: zero at the solution.
  std::vector<double> residual(const std::vector<double>& target, const std::vector<double>& x) const;
  void solve(const std::vector<double>& target, std::vector<double>& x) const;
  void expect_bends(const std::vector<double>& x, double usual_bend_mm, int reach);
  mutable std::vector<double> across_, along_;  ///< bends of what was last applied to, kept for their room
};

/// Rings bend by `usual_bend_mm` from row to row on most of a vessel and by ten times that in a short
/// stenosis. Where the rings of x within `reach` rows bend much more than usual, their mean bend is expected
/// and larger deviations from it are usual; elsewhere none is expected.
void Smoother::expect_bends(const std::vector<double>& x, double usual_bend_mm, int reach) {
  std::vector<double> bend(static_cast<std::size_t>(rows), 0.0);
  for (int r = 1; r + 1 < rows; ++r)
    for (int a = 0; a < around; ++a)
      bend[r] += (x[at(r - 1, a)] - 2.0 * x[at(r, a)] + x[at(r + 1, a)]) / around;
  along.assign(bend.size(), 0.0);
  expected.assign(bend.size(), 0.0);
  const double usual2 = usual_bend_mm * usual_bend_mm;
  for (int r = 1; r + 1 < rows; ++r) {
    const int first = std::max(1, r - reach), last = std::min(rows - 2, r + reach);
    double mean2 = 0.0;
    for (int i = first; i <= last; ++i) mean2 += bend[i] * bend[i] / (last - first + 1);
    along[r] = 1.0 / (usual2 + mean2);
    expected[r] = bend[r] * mean2 / (mean2 + 4.0 * usual2);
  }
}

void Smoother::bend(const std::vector<double>& x) const {
  const auto ring = static_cast<std::size_t>(around);
  across_.resize(x.size());
  along_.assign(x.size(), 0.0);
  for (int r = 0; r < rows; ++r) {
    const double* row = x.data() + static_cast<std::size_t>(r) * ring;
    double* out = across_.data() + static_cast<std::size_t>(r) * ring;
    over_packs(1, ring - 1, [&](auto at, std::size_t a) {
      at.put(out + a, at.get(row + a - 1) - at.all(2.0) * at.get(row + a) + at.get(row + a + 1));
    });
    out[0] = row[ring - 1] - 2.0 * row[0] + row[1];
    out[ring - 1] = row[ring - 2] - 2.0 * row[ring - 1] + row[0];
    if (r == 0 || r + 1 == rows) continue;
    double* down = along_.data() + static_cast<std::size_t>(r) * ring;
    over_packs(0, ring, [&](auto at, std::size_t a) {
      at.put(down + a, at.get(row + a - ring) - at.all(2.0) * at.get(row + a) + at.get(row + a + ring));
    });
  }
}

/// Each value's terms are added in one order, that in which the bends' own sums would meet them.
void Smoother::apply(const std::vector<double>& x, std::vector<double>& y) const {
  bend(x);
  const auto ring = static_cast<std::size_t>(around);
  const std::vector<double> none(ring, 0.0);
  for (int r = 0; r < rows; ++r) {
    const std::size_t first = static_cast<std::size_t>(r) * ring, end = ring - 1;
    const double *row = x.data() + first, *b = across_.data() + first, *here = along_.data() + first;
    const double* before = r > 0 ? here - ring : none.data();
    const double* after = r + 1 < rows ? here + ring : none.data();
    const double c = across[r], c2 = 2.0 * c, s2 = 2.0 * along[r];
    const double s_before = r > 0 ? along[r - 1] : 0.0, s_after = r + 1 < rows ? along[r + 1] : 0.0;
    double* out = y.data() + first;
    over_packs(1, end, [&](auto at, std::size_t a) {
      at.put(out + a, at.all(pull) * at.get(row + a) + at.all(s_before) * at.get(before + a) +
                          at.all(c) * at.get(b + a - 1) - at.all(c2) * at.get(b + a) -
                          at.all(s2) * at.get(here + a) + at.all(c) * at.get(b + a + 1) +
                          at.all(s_after) * at.get(after + a));
    });
    out[0] = pull * row[0] + s_before * before[0] - c2 * b[0] - s2 * here[0] + c * b[1] + c * b[end] +
             s_after * after[0];
    out[end] = pull * row[end] + s_before * before[end] + c * b[0] + c * b[end - 1] - c2 * b[end] -
               s2 * here[end] + s_after * after[end];
  }
}

std::vector<double> Smoother::residual(const std::vector<double>& target,
                                       const std::vector<double>& x) const {
  std::vector<double> out(x.size()), image(x.size());
  apply(x, image);
  for (std::size_t i = 0; i < x.size(); ++i) out[i] = pull * target[i] - image[i];
  for (int r = 1; r + 1 < rows; ++r) {
    const double push = along[r] * expected[r];
    for (int a = 0; a < around; ++a) {
      out[at(r - 1, a)] += push;
      out[at(r, a)] -= 2.0 * push;
      out[at(r + 1, a)] += push;
    }
  }
  return out;
}

/// Conjugate gradients from x; sums in one order, so the same for any number of threads.
void Smoother::solve(const std::vector<double>& target, std::vector<double>& x) const {
  const std::size_t n = x.size();
  std::vector<double> left = residual(target, x), direction = left, image(n);
  double norm = 0.0;
  for (const double value : left) norm += value * value;
  const double enough = 1e-6 * norm;
  for (int round = 0; round < 120 && norm > enough; ++round) {
    apply(direction, image);
    double curvature = 0.0;
    for (std::size_t i = 0; i < n; ++i) curvature += direction[i] * image[i];
    const double step = norm / curvature;
    double next = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += step * direction[i];
      left[i] -= step * image[i];
      next += left[i] * left[i];
    }
    for (std::size_t i = 0; i < n; ++i) direction[i] = left[i] + next / norm * direction[i];
    norm = next;
  }
}

/// Minimum of weight * energy + pull / 2 (r - x)^2 over the candidates, between them by a parabola.
double best_candidate(const RayEnergy& energy, const RadiusGrid& grid, double weight, double pull, double x) {
  const auto cost = [&](int i) {
    const double d = grid.at(energy.first + i) - x;
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
  return grid.at(energy.first + best) + shift * grid.step_mm;
}

/// How much worse a boundary 0.3 mm to either side would be.
float clearness(const RayEnergy& energy, const RadiusGrid& grid, double radius) {
  const int n = static_cast<int>(energy.value.size());
  if (n < 2) return 0.0F;
  const auto at = [&](double r) {
    const double x = std::clamp((r - grid.at(energy.first)) / grid.step_mm, 0.0, n - 1.0);
    const int i = std::min(static_cast<int>(x), n - 2);
    return energy.value[i] + (x - i) * (energy.value[i + 1] - energy.value[i]);
  };
  const double gain = std::min(at(radius - 0.3), at(radius + 0.3)) - at(radius);
  return static_cast<float>(1.0 - std::exp(-0.25 * std::max(0.0, gain)));
}

std::vector<RayEnergy> energies(const RayFan& fan, const std::vector<double>& lumen_hu,
                                const std::vector<double>& radius_mm, const std::vector<float>& calcium_odds,
                                EdgeProfile& profile, const core::TaskContext& task) {
  profile.prepare(radius_mm);
  std::vector<RayEnergy> out(radius_mm.size());
  core::parallel_for(static_cast<std::size_t>(fan.rows), 4, [&](std::size_t r) {
    task.throw_if_cancelled();
    for (int a = 0; a < fan.around; ++a) {
      const std::size_t n = r * fan.around + a;
      const float* ray = fan.ray(static_cast<int>(r), a);
      const int start = profile.window(radius_mm[n]);
      int last = 0;
      profile.candidates(radius_mm[n], out[n].first, last);
      for (int k = out[n].first; k <= last; ++k)
        out[n].value.push_back(profile.energy(ray, start, k, lumen_hu[r], calcium_odds[n]));
    }
  });
  return out;
}

Smoother smoother_about(int rows, int around, const std::vector<double>& radius_mm,
                        const BoundaryFitOptions& options) {
  Smoother out;
  out.rows = rows;
  out.around = around;
  const double turn = 2.0 * std::numbers::pi / around;
  for (int r = 0; r < rows; ++r) {
    double mean = 0.0;
    for (int a = 0; a < around; ++a) mean += radius_mm[out.at(r, a)] / around;
    const double bend = options.bend_around * std::max(mean, 0.4) * turn * turn;
    out.across.push_back(1.0 / (bend * bend));
  }
  const double h = options.row_step_mm;
  const int reach = std::max(1, static_cast<int>(std::lround(options.bend_reach_mm / h)));
  out.expect_bends(radius_mm, options.bend_along_per_mm * h * h, reach);
  return out;
}

}  // namespace

BoundaryFit fit_boundary(const std::vector<RayEnergy>& energy, const RadiusGrid& grid, int rows, int around,
                         const std::vector<double>& radius_mm, const BoundaryFitOptions& options,
                         const core::TaskContext& task) {
  const std::size_t rays = radius_mm.size();
  Smoother smoother = smoother_about(rows, around, radius_mm, options);
  // Splitting: the rays' own best places and the smooth surface, drawn to each other more and more.
  std::vector<double> smooth = radius_mm, own(rays);
  for (int round = 0; round < 16; ++round) {
    task.throw_if_cancelled();
    smoother.pull = 5.0 * std::pow(1.35, round);
    for (std::size_t n = 0; n < rays; ++n)
      own[n] = best_candidate(energy[n], grid, options.data_weight, smoother.pull, smooth[n]);
    smoother.solve(own, smooth);
  }
  BoundaryFit out{std::move(smooth), std::vector<float>(rays)};
  for (std::size_t n = 0; n < rays; ++n) {
    out.radius_mm[n] = std::max(out.radius_mm[n], grid.at(0));
    out.confidence[n] = clearness(energy[n], grid, out.radius_mm[n]);
  }
  return out;
}

BoundaryFit fit_boundary(const RayFan& fan, const std::vector<double>& lumen_hu,
                         const std::vector<double>& radius_mm, const std::vector<float>& calcium_odds,
                         EdgeProfile& profile, const BoundaryFitOptions& options,
                         const core::TaskContext& task) {
  const RadiusGrid grid{profile.radius(0), profile.radius(1) - profile.radius(0), 0};
  return fit_boundary(energies(fan, lumen_hu, radius_mm, calcium_odds, profile, task), grid, fan.rows,
                      fan.around, radius_mm, options, task);
}

}  // namespace ostia::segmentation
