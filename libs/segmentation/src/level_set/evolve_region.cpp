#include "level_set/evolve_region.h"

#include "outer_wall/wall_blur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace ostia::segmentation::detail {

Shell shell_of(const imaging::FloatVolume& level_set) {
  Shell shell;
  const auto& size = level_set.geometry.size;
  const std::array<std::int64_t, 3> strides{1, size[0], size[0] * size[1]};
  for (std::int64_t k = 1; k + 1 < size[2]; ++k) {
    for (std::int64_t j = 1; j + 1 < size[1]; ++j) {
      for (std::int64_t i = 1; i + 1 < size[0]; ++i) {
        const std::int64_t n = level_set.geometry.offset(i, j, k);
        if (level_set.voxels[n] >= 0.0F) continue;
        bool border = false;
        for (const std::int64_t s : strides) {
          border |= level_set.voxels[n - s] >= 0.0F || level_set.voxels[n + s] >= 0.0F;
        }
        (border ? shell.surface : shell.interior).push_back(n);
      }
    }
  }
  return shell;
}

namespace {

float percentile(const imaging::FloatVolume& image, const std::vector<std::int64_t>& voxels, double part) {
  if (voxels.empty()) return 0.0F;
  std::vector<float> values;
  values.reserve(voxels.size());
  for (const std::int64_t n : voxels) values.push_back(image.voxels[n]);
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// Gradients that tell walls from noise, HU/mm.
struct Contrast {
  double wall = 0.0;
  double noise = 0.0;  ///< above what the interior shows, well below what the surface shows
};

Contrast contrast_of(const imaging::FloatVolume& gradient, const Shell& shell) {
  Contrast contrast;
  contrast.wall = percentile(gradient, shell.surface, 0.75);
  if (contrast.wall <= 0.0) return {1.0, 1.0};
  contrast.noise =
      std::clamp(1.5 * percentile(gradient, shell.interior, 0.5), 0.1 * contrast.wall, 0.4 * contrast.wall);
  return contrast;
}

/// The feature at which curvature counts in full.
double full_feature(const Contrast& contrast) {
  return 0.5 * std::log1p(std::pow(0.35 * contrast.wall / contrast.noise, 2));
}

double sigma_of(const SegmentOptions& wanted, const imaging::Geometry& grid) {
  return wanted.gaussian_sigma_mm > 0.0 ? wanted.gaussian_sigma_mm : grid.spacing.minCoeff();
}

constexpr double kDeviationOfMedian = 1.4826;  // of a normal distribution, over its median deviation
constexpr double kLeastSigma = 10.0;           // HU; an image without noise has none

/// Median and robust deviation of the voxels well inside the initial region; of all inside where the vessel
/// is too thin to have such.
IntensityBalloon statistics_of(const imaging::ImageVolume& image, const imaging::Region& region,
                               const imaging::Geometry& grid, const Shell& shell) {
  constexpr std::size_t kEnough = 30;
  const auto& voxels = shell.interior.size() >= kEnough ? shell.interior : shell.surface;
  std::vector<double> hu;
  for (const std::int64_t n : voxels)
    hu.push_back(image(n % grid.size[0] + region.lower[0], n / grid.size[0] % grid.size[1] + region.lower[1],
                       n / (grid.size[0] * grid.size[1]) + region.lower[2]));
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  IntensityBalloon found;
  if (hu.empty()) return found;
  const double mean = median(hu);
  for (double& value : hu) value = std::abs(value - mean);
  found.mean_hu = mean;
  found.sigma_hu = std::max(kDeviationOfMedian * median(hu), kLeastSigma);
  return found;
}

}  // namespace

EvolvedRegion evolve_region(const imaging::ImageVolume& image, const imaging::Region& region,
                            const imaging::FloatVolume& initial, const Shell& shell,
                            const SegmentOptions& wanted, double lumen_hu, const core::TaskContext& task) {
  const WallFeature feature = wanted.feature;
  LevelSetOptions options = wanted.level_set;
  const auto scheme = feature == WallFeature::upwind ? GradientScheme::upwind : GradientScheme::centred;
  const core::TaskContext first = task.sub(0.0, 0.1), rest = task.sub(0.1, 1.0);
  imaging::FloatVolume gradient =
      feature == WallFeature::gaussian
          ? gaussian_gradient_magnitude(image, region, sigma_of(wanted, image.geometry), first)
          : gradient_magnitude(image, region, scheme, first);
  const Contrast contrast = contrast_of(gradient, shell);
  options.curvature_needs_feature = full_feature(contrast);
  EvolvedRegion out;
  std::optional<imaging::FloatVolume> speed;
  if (wanted.balloon) {
    const IntensityBalloon own = statistics_of(image, region, initial.geometry, shell);
    out.balloon_mean_hu = wanted.balloon->mean_hu.value_or(own.mean_hu.value_or(lumen_hu));
    out.balloon_sigma_hu = wanted.balloon->sigma_hu.value_or(own.sigma_hu.value_or(kLeastSigma));
    speed = balloon_speed(image, region, out.balloon_mean_hu, out.balloon_sigma_hu, wanted.balloon->tau);
  }
  if (feature == WallFeature::edges || feature == WallFeature::upwind) {
    gradient = {};
    EdgeFeature edge;
    edge.noise_hu_per_mm = contrast.noise;
    edge.blur = wall_blur(image, initial.geometry, shell.surface);
    edge.upwind = feature == WallFeature::upwind;
    if (wanted.bright_is_lumen) edge.brightest_hu = lumen_hu;
    out.surface = speed ? level_set(initial, image, edge, *speed, options, rest)
                        : level_set(initial, image, edge, options, rest);
    return out;
  }
  options.feature_offset_voxels = 0.0;
  compress_feature(gradient, contrast.noise);
  out.surface = speed ? level_set(initial, gradient, *speed, options, rest)
                      : level_set(initial, gradient, options, rest);
  return out;
}

}  // namespace ostia::segmentation::detail
