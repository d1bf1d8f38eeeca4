#include "scan/iterative_noise.h"

#include "scan/scan_noise.h"
#include "scan/slice_blur.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

constexpr double blotch_per_wave = 0.25;   // deviation of the blur, in wavelengths of the noise's peak
constexpr double edge_hu_per_mm = 60.0;    // a slope half on the way to an edge
constexpr double edge_share = 0.5;         // at edges so much less of the noise is taken out
constexpr double smallest_sigma_mm = 0.3;  // of the blur, for low-pass noise

double blotch_sigma_mm(const ScanOptions& options) {
  if (options.noise_peak_per_mm > 0.0) return blotch_per_wave / options.noise_peak_per_mm;
  return std::max(smallest_sigma_mm, options.psf_fwhm_mm / fwhm_per_sigma);
}

/// What is left of the deviation where the image is flat.
double kept_deviation(const ScanOptions& options, double share) {
  const double sigma = blotch_sigma_mm(options);
  double before = 0.0, after = 0.0;
  for (double q = 0.005; q < 4.0; q += 0.01) {
    // Low-pass noise of the point-spread function's width is blurred by the same once more.
    const double amplitude = options.noise_peak_per_mm > 0.0 ? noise_amplitude(q) : std::exp(-0.5 * q * q);
    const double cycles = options.noise_peak_per_mm > 0.0 ? q * options.noise_peak_per_mm
                                                          : q / (2.0 * std::numbers::pi * sigma);
    const double blur = std::exp(-2.0 * std::pow(std::numbers::pi * sigma * cycles, 2.0));
    const double power = q * amplitude * amplitude;
    before += power;
    after += power * std::pow(1.0 - share * (1.0 - blur), 2.0);
  }
  return std::sqrt(after / before);
}

}  // namespace

IterativeNoise::IterativeNoise(const ScanOptions& options)
    : spacing_(options.grid.spacing), share_(static_cast<float>(options.realism.iterative)) {
  if (none()) return;
  scale_ = static_cast<float>(1.0 / kept_deviation(options, options.realism.iterative));
  const double sigma = blotch_sigma_mm(options);
  sigma_voxels_ = {sigma / spacing_.x(), sigma / spacing_.y()};
}

void IterativeNoise::add(const SliceView& slice, std::vector<float> noise) const {
  const std::ptrdiff_t w = slice.width, h = slice.height;
  const std::vector<float> blotches = blurred({noise.data(), w, h, w}, sigma_voxels_);
  const auto slope = [&](std::ptrdiff_t i0, std::ptrdiff_t j0, std::ptrdiff_t i1, std::ptrdiff_t j1,
                         double step_mm) {
    const auto steps = static_cast<double>(i1 - i0 + j1 - j0);
    return steps > 0.0 ? (slice.row(j1)[i1] - slice.row(j0)[i0]) / (steps * step_mm) : 0.0;
  };
  for (std::ptrdiff_t j = 0; j < h; ++j) {
    for (std::ptrdiff_t i = 0; i < w; ++i) {
      const double x = slope(std::max<std::ptrdiff_t>(i - 1, 0), j, std::min(i + 1, w - 1), j, spacing_.x());
      const double y = slope(i, std::max<std::ptrdiff_t>(j - 1, 0), i, std::min(j + 1, h - 1), spacing_.y());
      const double steep = (x * x + y * y) / (edge_hu_per_mm * edge_hu_per_mm);
      const auto flat = static_cast<float>(share_ * (1.0 - edge_share * steep / (1.0 + steep)));
      const auto v = static_cast<std::size_t>(j * w + i);
      noise[v] = scale_ * (noise[v] - flat * (noise[v] - blotches[v]));
    }
  }
  for (std::ptrdiff_t j = 0; j < h; ++j)
    for (std::ptrdiff_t i = 0; i < w; ++i) slice.row(j)[i] += noise[static_cast<std::size_t>(j * w + i)];
}

}  // namespace ostia::phantom
