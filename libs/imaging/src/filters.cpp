#include "ostia/imaging/filters.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace ostia::imaging {
namespace {

/// Weights w[0] (centre), w[1], ... of the symmetric discrete Gaussian of `sigma` voxels, of unit sum.
std::vector<float> gaussian_weights(double sigma) {
  const double variance = sigma * sigma;
  // Far above one voxel the sampled Gaussian is the same to double precision, and the Bessel functions
  // overflow.
  const bool sampled = variance > 100.0;
  const int radius = static_cast<int>(std::ceil(4.0 * sigma)) + (sigma > 0.0 ? 2 : 0);
  std::vector<double> weights;
  double sum = 0.0;
  for (int n = 0; n <= radius; ++n) {
    const double w =
        sampled ? std::exp(-0.5 * n * n / variance) : std::exp(-variance) * std::cyl_bessel_i(n, variance);
    weights.push_back(w);
    sum += n == 0 ? w : 2.0 * w;
  }
  std::vector<float> result;
  for (const double w : weights) result.push_back(static_cast<float>(w / sum));
  return result;
}

/// Along x: the row is copied with its border repeated, so that the inner loop has no branches.
void blur_row(const float* in, float* out, std::int64_t n, const std::vector<float>& weights,
              std::vector<float>& padded) {
  const std::int64_t radius = static_cast<std::int64_t>(weights.size()) - 1;
  padded.resize(static_cast<std::size_t>(n + 2 * radius));
  std::fill_n(padded.begin(), radius, in[0]);
  std::copy_n(in, n, padded.begin() + radius);
  std::fill_n(padded.begin() + radius + n, radius, in[n - 1]);
  const float* centre = padded.data() + radius;
  for (std::int64_t i = 0; i < n; ++i) out[i] = weights[0] * centre[i];
  for (std::int64_t r = 1; r <= radius; ++r) {
    const float w = weights[static_cast<std::size_t>(r)];
    for (std::int64_t i = 0; i < n; ++i) out[i] += w * (centre[i - r] + centre[i + r]);
  }
}

/// One row of the pass along an axis whose neighbours lie `stride` voxels apart: `at` of `count` along that
/// axis.
void blur_across(const float* in, float* out, std::int64_t n, std::int64_t at, std::int64_t count,
                 std::int64_t stride, const std::vector<float>& weights) {
  for (std::int64_t i = 0; i < n; ++i) out[i] = weights[0] * in[i];
  for (std::int64_t r = 1; r < static_cast<std::int64_t>(weights.size()); ++r) {
    const float w = weights[static_cast<std::size_t>(r)];
    const float* before = in + (std::max<std::int64_t>(at - r, 0) - at) * stride;
    const float* after = in + (std::min(at + r, count - 1) - at) * stride;
    for (std::int64_t i = 0; i < n; ++i) out[i] += w * (before[i] + after[i]);
  }
}

}  // namespace

FloatVolume gaussian_blurred(const FloatVolume& image, double sigma_mm, const core::TaskContext& task) {
  if (!(sigma_mm >= 0.0) || !std::isfinite(sigma_mm))
    throw InvalidInput("Gaussian blur: sigma is " + std::to_string(sigma_mm) + " mm; it must be 0 or more");
  const Geometry& grid = image.geometry;
  const std::int64_t nx = grid.size[0], ny = grid.size[1], nz = grid.size[2];
  FloatVolume result{grid, image.voxels};
  if (sigma_mm == 0.0 || image.voxels.empty()) return result;

  std::vector<float> other(image.voxels.size());
  const auto pass = [&](int axis, const std::vector<float>& in, std::vector<float>& out,
                        const core::TaskContext& part) {
    const std::vector<float> weights = gaussian_weights(sigma_mm / grid.spacing[axis]);
    const std::size_t grain = std::max<std::size_t>(1, 65536 / static_cast<std::size_t>(nx));
    core::parallel_chunks(static_cast<std::size_t>(ny * nz), grain, [&](std::size_t first, std::size_t last) {
      part.throw_if_cancelled();
      std::vector<float> padded;
      for (std::size_t row = first; row < last; ++row) {
        const std::int64_t j = static_cast<std::int64_t>(row) % ny, k = static_cast<std::int64_t>(row) / ny;
        const float* from = in.data() + row * static_cast<std::size_t>(nx);
        float* to = out.data() + row * static_cast<std::size_t>(nx);
        if (axis == 0) blur_row(from, to, nx, weights, padded);
        if (axis == 1) blur_across(from, to, nx, j, ny, nx, weights);
        if (axis == 2) blur_across(from, to, nx, k, nz, nx * ny, weights);
      }
      part.set_progress(static_cast<double>(last) / static_cast<double>(ny * nz));
    });
  };
  pass(0, image.voxels, result.voxels, task.sub(0.0, 1.0 / 3.0));
  pass(1, result.voxels, other, task.sub(1.0 / 3.0, 2.0 / 3.0));
  pass(2, other, result.voxels, task.sub(2.0 / 3.0, 1.0));
  return result;
}

}  // namespace ostia::imaging
