#include "scan/plane_kernel.h"

#include "scan/slice_blur.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::phantom {
namespace {

constexpr double wider = 2.0;  // deviation of the negative lobe over that of the positive one

/// How far the edge-spread function of (1 + a) G(1) - a G(wider) falls below 0.
double undershoot_of(double a) {
  if (a <= 0.0) return 0.0;
  // Where its derivative, the line-spread function, is 0.
  const double x = -std::sqrt(2.0 * std::log((1.0 + a) * wider / a) / (1.0 - 1.0 / (wider * wider)));
  const auto rise = [](double t) { return 0.5 * std::erfc(-t / std::numbers::sqrt2); };
  return a * rise(x / wider) - (1.0 + a) * rise(x);
}

/// Where a function that rises passes a value.
template <class Function>
double solved(const Function& rising, double value, double low, double high) {
  for (int step = 0; step < 80; ++step) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Line-spread function of the three Gaussians and its width.
struct LineSpread {
  double sigma, negative, tail, tail_sigma;
  double at(double x) const {
    const auto lobe = [x](double weight, double s) {
      return s > 0.0 ? weight / s * std::exp(-0.5 * x * x / (s * s)) : 0.0;
    };
    return lobe(1.0 + negative - tail, sigma) - lobe(negative, wider * sigma) + lobe(tail, tail_sigma);
  }
  double fwhm() const {
    const double half = 0.5 * at(0.0);
    return 2.0 * solved([&](double x) { return half - at(x); }, 0.0, 0.0, 3.0 * sigma);
  }
};

}  // namespace

PlaneKernel::PlaneKernel(const ScanOptions& options)
    : base_fwhm_mm_(options.psf_fwhm_mm), spacing_(options.grid.spacing) {
  const ScanRealism& r = options.realism;
  if (r.undershoot <= 0.0 && r.tail <= 0.0) return;
  if (options.psf_fwhm_mm <= 0.0) throw InvalidInput("scan: undershoot and tail need a psf_fwhm_mm above 0");
  if (r.tail > 0.0 && r.tail_fwhm_mm < 1.5 * options.psf_fwhm_mm)
    throw InvalidInput("scan: tail_fwhm_mm is " + std::to_string(r.tail_fwhm_mm) +
                       "; tails must be at least 1.5 times as wide as psf_fwhm_mm, " +
                       std::to_string(options.psf_fwhm_mm));
  LineSpread line{};
  line.negative = solved(undershoot_of, r.undershoot, 0.0, 10.0);
  if (r.undershoot <= 0.0) line.negative = 0.0;
  line.tail = r.tail;
  line.tail_sigma = r.tail_fwhm_mm / fwhm_per_sigma;
  const double asked = options.psf_fwhm_mm / fwhm_per_sigma;
  const double sigma = solved(
      [&](double s) {
        line.sigma = s;
        return line.fwhm();
      },
      options.psf_fwhm_mm, 0.3 * asked, 3.0 * asked);
  base_fwhm_mm_ = sigma * fwhm_per_sigma;
  base_weight_ = 1.0 + line.negative - line.tail;
  const auto add = [&](double weight, double whole_sigma) {
    lobes_.push_back({weight, std::sqrt(whole_sigma * whole_sigma - sigma * sigma)});
  };
  if (line.negative > 0.0) add(-line.negative, wider * sigma);
  if (line.tail > 0.0) add(line.tail, line.tail_sigma);
}

std::int64_t PlaneKernel::reach(int axis) const {
  std::size_t most = 1;
  for (const Lobe& lobe : lobes_)
    most = std::max(most, gaussian_weights(lobe.sigma_mm / spacing_[axis]).size());
  return static_cast<std::int64_t>(most) - 1;
}

void PlaneKernel::apply(const SliceView& slice) const {
  if (none()) return;
  std::vector<float> sum(static_cast<std::size_t>(slice.width * slice.height), 0.0f);
  for (const Lobe& lobe : lobes_) {
    const std::vector<float> wide =
        blurred(slice, {lobe.sigma_mm / spacing_.x(), lobe.sigma_mm / spacing_.y()});
    const auto weight = static_cast<float>(lobe.weight);
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += weight * wide[v];
  }
  const auto weight = static_cast<float>(base_weight_);
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    float* row = slice.row(j);
    for (std::ptrdiff_t i = 0; i < slice.width; ++i)
      row[i] = weight * row[i] + sum[static_cast<std::size_t>(j * slice.width + i)];
  }
}

}  // namespace ostia::phantom
