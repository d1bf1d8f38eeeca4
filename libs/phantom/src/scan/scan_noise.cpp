#include "scan/scan_noise.h"

#include "scan/slice_blur.h"

#include "ostia/core/parallel.h"
#include "ostia/phantom/noise.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::phantom {
namespace {

using Row = Eigen::Map<Eigen::ArrayXf, Eigen::Unaligned>;
using ConstRow = Eigen::Map<const Eigen::ArrayXf, Eigen::Unaligned>;

// The filter exp(-a f^2) - c exp(-b f^2), f in units of the peak's frequency, whose square is closest (least
// squares) to f exp(-f^2 / 2): the ramp of filtered back-projection under a Gaussian apodisation.
constexpr double narrow_decay = 0.1803, broad_decay = 2.0422, broad_amount = 0.5944;
constexpr std::uint64_t noise_stream = 0x6e6f697365ULL;

/// Sum over all places of the product of two symmetric kernels.
double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = a[0] * b[0];
  for (std::size_t n = 1; n < std::min(a.size(), b.size()); ++n) sum += 2.0 * a[n] * b[n];
  return sum;
}

/// Transform of a symmetric kernel at `f` cycles a voxel.
double response(const std::vector<double>& kernel, double f) {
  double sum = kernel[0];
  for (std::size_t n = 1; n < kernel.size(); ++n)
    sum += 2.0 * kernel[n] * std::cos(2.0 * std::numbers::pi * f * static_cast<double>(n));
  return sum;
}

/// Deviations, in voxels, of the two lobes for a peak at `peak` cycles a voxel, when the voxels are fine.
std::pair<double, double> lobe_sigmas(double peak) {
  // exp(-decay (f / peak)^2) is the transform of a Gaussian of this deviation.
  const auto sigma = [&](double decay) { return std::sqrt(0.5 * decay) / (std::numbers::pi * peak); };
  return {sigma(narrow_decay), sigma(broad_decay)};
}

/// Where the power of the two lobes' difference really peaks on the grid (mean of axis and diagonal).
double true_peak(double peak) {
  const auto [narrow, broad] = lobe_sigmas(peak);
  const std::vector<double> a = gaussian_weights(narrow), b = gaussian_weights(broad);
  double best = 0.0, at = 0.0;
  for (double f = 0.2 * peak; f < std::min(0.5, 3.0 * peak); f += 0.002 * peak) {
    const double d = f / std::numbers::sqrt2;
    const double axis = response(a, f) - broad_amount * response(b, f);
    const double diagonal = std::pow(response(a, d), 2) - broad_amount * std::pow(response(b, d), 2);
    const double power = axis * axis + diagonal * diagonal;
    if (power > best) {
      best = power;
      at = f;
    }
  }
  return at;
}

}  // namespace

double noise_amplitude(double q) {
  return std::exp(-narrow_decay * q * q) - broad_amount * std::exp(-broad_decay * q * q);
}

ScanNoise::ScanNoise(const Scene& scene, const ScanOptions& options, const core::TaskContext& task)
    : options_(options) {
  const geometry::Vec3& spacing = options.grid.spacing;
  z_ = gaussian_weights(options.noise_fwhm_z_mm / fwhm_per_sigma / spacing.z());
  if (options.noise_hu > 0.0 && options.realism.noise_structure > 0.0) {
    rays_.emplace(scene, options, task);
    scale_ = options.noise_hu / std::sqrt(product(z_, z_));
    return;
  }
  const auto lobe = [&](double amount, double sigma_mm) {
    lobes_.push_back(
        {amount, gaussian_weights(sigma_mm / spacing.x()), gaussian_weights(sigma_mm / spacing.y())});
  };
  if (options.noise_peak_per_mm > 0.0) {
    // A coarse grid moves the peak: asked for a little elsewhere, it comes out where it should.
    const double voxel = std::sqrt(spacing.x() * spacing.y()), wanted = options.noise_peak_per_mm * voxel;
    double asked = wanted;
    for (int round = 0; round < 8; ++round) asked *= std::clamp(wanted / true_peak(asked), 0.7, 1.4);
    const auto [narrow, broad] = lobe_sigmas(asked);
    lobe(1.0, narrow * voxel);
    lobe(-broad_amount, broad * voxel);
  } else {
    lobe(1.0, options.psf_fwhm_mm / fwhm_per_sigma);
  }
  double power = 0.0;
  for (const Lobe& a : lobes_) {
    margin_x_ = std::max(margin_x_, static_cast<std::int64_t>(a.x.size()) - 1);
    margin_y_ = std::max(margin_y_, static_cast<std::int64_t>(a.y.size()) - 1);
    for (const Lobe& b : lobes_) power += a.amount * b.amount * product(a.x, b.x) * product(a.y, b.y);
  }
  scale_ = options.noise_hu / std::sqrt(power * product(z_, z_));
}

/// White noise of a slice (wider than the grid, so that the border is like everywhere) through the lobes.
std::vector<float> ScanNoise::filtered(std::int64_t k) const {
  if (rays_) return rays_->slice(k);
  const std::int64_t nx = options_.grid.size[0], ny = options_.grid.size[1];
  const std::int64_t width = nx + 2 * margin_x_, height = ny + 2 * margin_y_;
  const std::int64_t margin_z = static_cast<std::int64_t>(z_.size()) - 1;
  std::vector<float> white(static_cast<std::size_t>(width * height));
  fill_normal(options_.seed ^ noise_stream, static_cast<std::uint64_t>((k + margin_z) * width * height),
              white);
  std::vector<float> result(static_cast<std::size_t>(nx * ny), 0.0f),
      across(static_cast<std::size_t>(nx * height));
  for (const Lobe& lobe : lobes_) {
    for (std::int64_t j = 0; j < height; ++j) {
      const float* centre = white.data() + j * width + margin_x_;
      Row out(across.data() + j * nx, nx);
      out = static_cast<float>(lobe.x[0]) * ConstRow(centre, nx);
      for (std::size_t d = 1; d < lobe.x.size(); ++d) {
        const auto n = static_cast<std::ptrdiff_t>(d);
        out += static_cast<float>(lobe.x[d]) * (ConstRow(centre - n, nx) + ConstRow(centre + n, nx));
      }
    }
    for (std::int64_t j = 0; j < ny; ++j) {
      const float* centre = across.data() + (j + margin_y_) * nx;
      Row out(result.data() + j * nx, nx);
      out += static_cast<float>(lobe.amount * lobe.y[0]) * ConstRow(centre, nx);
      for (std::size_t d = 1; d < lobe.y.size(); ++d) {
        const auto n = static_cast<std::ptrdiff_t>(d) * nx;
        out += static_cast<float>(lobe.amount * lobe.y[d]) *
               (ConstRow(centre - n, nx) + ConstRow(centre + n, nx));
      }
    }
  }
  return result;
}

void ScanNoise::prepare(std::int64_t first, std::int64_t last, const core::TaskContext& task) {
  if (options_.noise_hu <= 0.0) return;
  const std::int64_t margin = static_cast<std::int64_t>(z_.size()) - 1;
  ready_.erase(ready_.begin(), ready_.lower_bound(first - margin));
  std::vector<std::pair<std::int64_t, std::vector<float>*>> wanted;
  for (std::int64_t k = first - margin; k < last + margin; ++k) {
    const auto [at, is_new] = ready_.try_emplace(k);
    if (is_new) wanted.emplace_back(k, &at->second);
  }
  core::parallel_for(wanted.size(), 1, [&](std::size_t n) {
    task.throw_if_cancelled();
    *wanted[n].second = filtered(wanted[n].first);
  });
}

void ScanNoise::add(const SliceView& slice, std::int64_t k) const {
  if (options_.noise_hu <= 0.0) return;
  const std::int64_t nx = options_.grid.size[0];
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    Row out(slice.row(j), slice.width);
    for (std::int64_t d = 1 - static_cast<std::int64_t>(z_.size()); d < static_cast<std::int64_t>(z_.size());
         ++d) {
      const auto weight = static_cast<float>(scale_ * z_[static_cast<std::size_t>(std::abs(d))]);
      out += weight * ConstRow(ready_.at(k + d).data() + j * nx, slice.width);
    }
  }
}

}  // namespace ostia::phantom
