#include "ostia/imaging/diffusion.h"

#include "diffusion_step.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/filters.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ostia::imaging {
namespace {

constexpr double kNoises = 3.0;               // an edge is steeper than the noise by this
constexpr double kMedianOfGradient = 1.538;   // of the length of three independent normal components
constexpr double kLeastContrast = 1.0;        // HU/mm
constexpr std::int64_t kSampled = 2'000'000;  // voxels the median is taken of, at most

/// The blur on which the flux's directions are read, one voxel.
double blur_mm(const Geometry& grid) {
  return grid.spacing.minCoeff();
}

void require_usable(const FloatVolume& image) {
  if (image.voxels.empty() || static_cast<std::int64_t>(image.voxels.size()) != image.geometry.voxels())
    throw InvalidInput("diffusion: the image has " + std::to_string(image.voxels.size()) + " values for " +
                       std::to_string(image.geometry.voxels()) + " voxels");
  for (const float v : image.voxels)
    if (!std::isfinite(v)) throw InvalidInput("diffusion: the image has values that are not finite");
}

/// Noise of one component of the gradient, HU/mm.
double gradient_noise(const FloatVolume& image) {
  const auto& size = image.geometry.size;
  if (*std::min_element(size.begin(), size.end()) < 3) return 0.0;
  const float padding = *std::min_element(image.voxels.begin(), image.voxels.end());
  const std::int64_t every = image.geometry.voxels() / kSampled + 1;
  std::vector<float> lengths;
  for (std::int64_t n = 0; n < image.geometry.voxels(); n += every) {
    const std::int64_t i = n % size[0], j = n / size[0] % size[1], k = n / (size[0] * size[1]);
    const bool border =
        i == 0 || j == 0 || k == 0 || i + 1 == size[0] || j + 1 == size[1] || k + 1 == size[2];
    if (border || image(i, j, k) <= padding) continue;
    const Vec3 twice(image(i + 1, j, k) - image(i - 1, j, k), image(i, j + 1, k) - image(i, j - 1, k),
                     image(i, j, k + 1) - image(i, j, k - 1));
    lengths.push_back(static_cast<float>((0.5 * twice).cwiseQuotient(image.geometry.spacing).norm()));
  }
  if (lengths.empty()) return 0.0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle / kMedianOfGradient;
}

}  // namespace

void validate(const DiffusionOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("diffusion: ") + what);
  };
  require(o.iterations >= 0 && o.iterations <= 1000, "iterations must be in [0, 1000]");
  require(o.contrast_hu_per_mm >= 0.0 && std::isfinite(o.contrast_hu_per_mm),
          "contrast_hu_per_mm must be 0 or more");
  require(o.attachment >= 0.0 && o.attachment <= 1.0, "attachment must be in [0, 1]");
  require(o.step > 0.0 && o.step <= 1.0, "step must be in (0, 1]");
}

double diffusion_contrast(const FloatVolume& image, Diffusion method, const core::TaskContext& task) {
  const double noise = method == Diffusion::flux
                           ? gradient_noise(gaussian_blurred(image, blur_mm(image.geometry), task))
                           : gradient_noise(image);
  return std::max(kNoises * noise, kLeastContrast);
}

FloatVolume diffused(const FloatVolume& image, const DiffusionOptions& options,
                     const core::TaskContext& task) {
  validate(options);
  require_usable(image);
  FloatVolume u = image;
  if (options.iterations == 0) return u;
  detail::StepOptions step;
  step.method = options.method;
  step.contrast = options.contrast_hu_per_mm > 0.0
                      ? options.contrast_hu_per_mm
                      : diffusion_contrast(image, options.method, task.sub(0.0, 0.1));
  // In units of the least voxel, so that iterations and attachment mean the same at every spacing.
  const Vec3 inverse = image.geometry.spacing.cwiseInverse();
  step.dt = options.step / (2.0 * inverse.squaredNorm());
  // A lone dark voxel has the gradients of six neighbours against it and would overshoot.
  if (options.method == Diffusion::curvature) step.dt *= 0.5;
  const double h = image.geometry.spacing.minCoeff();
  if (options.method == Diffusion::flux) step.attachment = options.attachment / (h * h);
  std::vector<float> next(u.voxels.size());
  for (int n = 0; n < options.iterations; ++n) {
    const core::TaskContext part =
        task.sub(0.1 + 0.9 * n / options.iterations, 0.1 + 0.9 * (n + 1) / options.iterations);
    task.throw_if_cancelled();
    FloatVolume smooth;
    if (options.method == Diffusion::flux)
      smooth = gaussian_blurred(u, blur_mm(u.geometry), part.sub(0.0, 0.3));
    detail::diffusion_step(u.geometry, u.voxels, smooth.voxels, image.voxels, step, next, part);
    std::swap(u.voxels, next);
    part.set_progress(1.0);
  }
  return u;
}

ImageVolume diffused(const ImageVolume& image, const DiffusionOptions& options,
                     const core::TaskContext& task) {
  const FloatVolume smoothed =
      diffused(FloatVolume{image.geometry, {image.voxels.begin(), image.voxels.end()}}, options, task);
  ImageVolume out{image.geometry, {}};
  out.voxels.resize(image.voxels.size());
  core::parallel_for(out.voxels.size(), 262144, [&](std::size_t n) {
    out.voxels[n] = static_cast<std::int16_t>(std::clamp(std::lround(smoothed.voxels[n]), -32768L, 32767L));
  });
  return out;
}

}  // namespace ostia::imaging
