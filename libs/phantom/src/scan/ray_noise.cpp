#include "scan/ray_noise.h"

#include "scan/scan_noise.h"

#include "ostia/core/parallel.h"
#include "ostia/phantom/noise.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Vec3;

constexpr std::uint64_t ray_stream = 0x72617973ULL;
constexpr int parts = 8;               // of a bin: views are looked up at the nearest
constexpr double bin_per_wave = 0.16;  // the spectrum ends below half a cycle a bin
constexpr double taps_per_wave = 4.0;
constexpr double arc_per_wave = 0.35;           // between views, at the border
constexpr double smooth_cycles_a_voxel = 0.09;  // up to here every second voxel is enough
constexpr std::int64_t half_taps = 4;           // of the interpolation between these
constexpr std::int64_t slice_offset = 4096;     // slices below the grid have noise, too

/// The filter of a detector whose back-projected noise has the spectrum A(q)^2: a line holds f times of it.
double detector_filter(double t_mm, double peak_per_mm) {
  constexpr int steps = 400;
  constexpr double last = 4.0;
  double sum = 0.0;
  for (int n = 0; n < steps; ++n) {
    const double q = last * (n + 0.5) / steps;
    sum += std::sqrt(q) * noise_amplitude(q) * std::cos(2.0 * std::numbers::pi * q * peak_per_mm * t_mm);
  }
  return sum;
}

/// Weights of the samples 1/2, 3/2, ... to either side, for a place in the middle of two.
std::array<float, half_taps> middle_weights() {
  std::array<double, half_taps> w{};
  double sum = 0.0;
  for (std::size_t n = 0; n < half_taps; ++n) {
    const double x = std::numbers::pi * (static_cast<double>(n) + 0.5);
    w[n] = std::sin(x) / x * std::pow(std::cos(0.5 * x / half_taps), 2.0);
    sum += 2.0 * w[n];
  }
  std::array<float, half_taps> out{};
  for (std::size_t n = 0; n < half_taps; ++n) out[n] = static_cast<float>(w[n] / sum);
  return out;
}

/// A row or column at twice the density: even places are samples, the first of them at `half_taps`.
void doubled(const float* from, std::ptrdiff_t stride, std::int64_t count, float* out,
             std::ptrdiff_t out_stride) {
  static const std::array<float, half_taps> w = middle_weights();
  for (std::int64_t i = 0; i < count; ++i) {
    const float* at = from + (i / 2 + half_taps) * stride;
    float value = at[0];
    if ((i & 1) != 0) {
      value = 0.0f;
      for (std::int64_t n = 0; n < half_taps; ++n)
        value += w[static_cast<std::size_t>(n)] * (at[-n * stride] + at[(n + 1) * stride]);
    }
    out[i * out_stride] = value;
  }
}

}  // namespace

Vec3 noise_centre(const ScanOptions& options) {
  if (options.moving_radius_mm > 0.0) return options.moving_centre;
  const auto& size = options.grid.size;
  return options.grid.world(0.5 * Vec3(static_cast<double>(size[0] - 1), static_cast<double>(size[1] - 1),
                                       static_cast<double>(size[2] - 1)));
}

RayNoise::RayNoise(const Scene& scene, const ScanOptions& options, const core::TaskContext& task)
    : rays_(scene, options.grid, noise_centre(options), task),
      grid_(options.grid),
      strength_(options.realism.noise_structure),
      seed_(options.seed ^ ray_stream) {
  const double peak = options.noise_peak_per_mm;
  const Vec3 corner = grid_.direction.transpose() * (grid_.origin - noise_centre(options));
  first_height_mm_ = corner.z();
  step_ = peak * grid_.spacing.head<2>().maxCoeff() <= smooth_cycles_a_voxel ? 2 : 1;
  double reach_mm = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const std::int64_t size = grid_.size[static_cast<std::size_t>(axis)];
    Axis& a = axes_[static_cast<std::size_t>(axis)];
    a.step_mm = step_ * grid_.spacing[axis];
    const std::int64_t before = step_ > 1 ? half_taps : 0;
    a.count = step_ > 1 ? size / 2 + 2 * half_taps + 1 : size;
    a.first_mm = corner[axis] - a.step_mm * static_cast<double>(before);
    const double last_mm = a.first_mm + a.step_mm * static_cast<double>(a.count - 1);
    reach_mm = std::hypot(reach_mm, std::max(std::abs(a.first_mm), std::abs(last_mm)));
  }
  prepare_filter(peak, reach_mm);
  double sum = 0.0;
  for (int n = 0; n < views_; ++n)
    sum += std::exp(strength_ * rays_.line_integral(std::numbers::pi * n / views_, 0.0, 0.0));
  mean_variance_ = sum / views_;
}

void RayNoise::prepare_filter(double peak, double reach_mm) {
  const double wave_mm = 1.0 / peak;
  bin_mm_ = bin_per_wave * wave_mm;
  fine_mm_ = bin_mm_ / parts;
  taps_ = static_cast<std::int64_t>(std::ceil(taps_per_wave / bin_per_wave));
  bins_ = 2 * static_cast<std::int64_t>(std::ceil(reach_mm / bin_mm_) + 2) + 1;
  views_ = std::clamp(static_cast<int>(std::ceil(std::numbers::pi * reach_mm / (arc_per_wave * wave_mm))),
                      180, 1440);
  std::vector<std::vector<double>> filter;
  double power = 0.0;
  for (int part = 0; part < parts; ++part) {
    std::vector<double>& taps = filter.emplace_back();
    for (std::int64_t m = -taps_; m <= taps_; ++m) {
      const double t = (static_cast<double>(part) / parts - static_cast<double>(m)) * bin_mm_;
      const double end = static_cast<double>(taps_) * bin_mm_;
      const double fade = std::pow(std::cos(0.5 * std::numbers::pi * std::min(1.0, std::abs(t) / end)), 2.0);
      taps.push_back(fade * detector_filter(t, peak));
      power += taps.back() * taps.back() / parts;
    }
  }
  const double scale = 1.0 / std::sqrt(power * views_);
  for (const std::vector<double>& taps : filter) {
    std::vector<float>& out = filter_.emplace_back();
    for (const double tap : taps) out.push_back(static_cast<float>(scale * tap));
  }
}

void RayNoise::view(int n, std::int64_t k, std::vector<float>& fine) const {
  const std::int64_t wide = bins_ + 2 * taps_;
  std::vector<float> white(static_cast<std::size_t>(wide));
  fill_normal(seed_, static_cast<std::uint64_t>(((k + slice_offset) * views_ + n) * wide), white);
  const double angle = std::numbers::pi * n / views_;
  const double height = first_height_mm_ + grid_.spacing.z() * static_cast<double>(k);
  for (std::int64_t b = 0; b < wide; ++b) {
    const double distance = bin_mm_ * static_cast<double>(b - wide / 2);
    const double line = rays_.line_integral(angle, distance, height);
    white[static_cast<std::size_t>(b)] *=
        static_cast<float>(std::sqrt(std::exp(strength_ * line) / mean_variance_));
  }
  std::vector<float> one(static_cast<std::size_t>(bins_));
  Eigen::Map<Eigen::ArrayXf> sum(one.data(), bins_);
  for (int part = 0; part < parts; ++part) {
    sum.setZero();
    const std::vector<float>& taps = filter_[static_cast<std::size_t>(part)];
    for (std::int64_t m = 0; m <= 2 * taps_; ++m)
      sum += taps[static_cast<std::size_t>(m)] * Eigen::Map<const Eigen::ArrayXf>(white.data() + m, bins_);
    for (std::int64_t b = 0; b < bins_; ++b)
      fine[static_cast<std::size_t>(parts * b + part)] = one[static_cast<std::size_t>(b)];
  }
}

std::vector<float> RayNoise::back_projected(std::int64_t k) const {
  std::vector<float> out(static_cast<std::size_t>(axes_[0].count * axes_[1].count), 0.0f);
  std::vector<float> fine(static_cast<std::size_t>(bins_ * parts));
  for (int n = 0; n < views_; ++n) {
    view(n, k, fine);
    const double angle = std::numbers::pi * n / views_, c = std::cos(angle), s = std::sin(angle);
    const auto step = static_cast<float>(axes_[0].step_mm * c / fine_mm_);
    for (std::int64_t j = 0; j < axes_[1].count; ++j) {
      const double y = axes_[1].first_mm + axes_[1].step_mm * static_cast<double>(j);
      const double begin = (axes_[0].first_mm * c + y * s) / fine_mm_ + parts * (bins_ / 2) + 0.5;
      const auto from = static_cast<float>(begin);
      float* row = out.data() + j * axes_[0].count;
      for (int i = 0; i < static_cast<int>(axes_[0].count); ++i)
        row[i] += fine[static_cast<std::size_t>(static_cast<int>(from + static_cast<float>(i) * step))];
    }
  }
  return out;
}

std::vector<float> RayNoise::slice(std::int64_t k) const {
  std::vector<float> coarse = back_projected(k);
  if (step_ == 1) return coarse;
  const std::int64_t nx = grid_.size[0], ny = grid_.size[1];
  std::vector<float> across(static_cast<std::size_t>(nx * axes_[1].count)),
      out(static_cast<std::size_t>(nx * ny));
  for (std::int64_t j = 0; j < axes_[1].count; ++j)
    doubled(coarse.data() + j * axes_[0].count, 1, nx, across.data() + j * nx, 1);
  for (std::int64_t i = 0; i < nx; ++i) doubled(across.data() + i, nx, ny, out.data() + i, nx);
  return out;
}

}  // namespace ostia::phantom
