#include "ostia/imaging/noise.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace ostia::imaging {
namespace {

constexpr std::int64_t least_side = 4;  // voxels: fewer leave too little beside the plane
constexpr std::size_t most_squares = 20000, least_squares = 20;

/// A square's mean, and its deviation from the plane that fits it best.
struct SquareNoise {
  double mean_hu = 0.0, deviation_hu = 0.0;
};

SquareNoise noise_of(const ImageVolume& image, std::int64_t i0, std::int64_t j0, std::int64_t k,
                     std::int64_t side) {
  const auto n = static_cast<double>(side * side);
  const double middle = 0.5 * static_cast<double>(side - 1);
  double sum = 0.0, squares = 0.0, along_i = 0.0, along_j = 0.0, spread = 0.0;
  for (std::int64_t j = 0; j < side; ++j) {
    const double y = static_cast<double>(j) - middle;
    for (std::int64_t i = 0; i < side; ++i) {
      const double x = static_cast<double>(i) - middle, v = image(i0 + i, j0 + j, k);
      sum += v, squares += v * v, along_i += x * v, along_j += y * v, spread += x * x;
    }
  }
  SquareNoise out;
  out.mean_hu = sum / n;
  const double rest = squares - sum * sum / n - (along_i * along_i + along_j * along_j) / spread;
  out.deviation_hu = std::sqrt(std::max(rest, 0.0) / (n - 3.0));
  return out;
}

/// The half-sample mode (Robertson and Cryer 1974): the densest half of the densest half of ...
double commonest(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::size_t first = 0, count = values.size();
  while (count > 2) {
    const std::size_t half = (count + 1) / 2;
    std::size_t best = first;
    for (std::size_t i = first; i + half <= first + count; ++i)
      if (values[i + half - 1] - values[i] < values[best + half - 1] - values[best]) best = i;
    first = best, count = half;
  }
  return 0.5 * (values[first] + values[first + count - 1]);
}

/// Voxels [lower, upper) whose centres may lie in the box.
Region voxels_in(const Geometry& grid, const geometry::Box3& box) {
  Region out{{0, 0, 0}, grid.size};
  if (box.isEmpty()) return out;
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 index = grid.index(box.corner(static_cast<geometry::Box3::CornerType>(corner)));
    low = low.cwiseMin(index), high = high.cwiseMax(index);
  }
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const auto size = static_cast<double>(grid.size[axis]);
    out.lower[axis] = static_cast<std::int64_t>(std::clamp(std::ceil(low[a]), 0.0, size));
    out.upper[axis] = static_cast<std::int64_t>(std::clamp(std::floor(high[a]) + 1.0, 0.0, size));
  }
  return out;
}

void validate(const NoiseOptions& options) {
  if (!(options.square_mm >= 2.0 && options.square_mm <= 50.0))
    throw InvalidInput("noise: squares of " + std::to_string(options.square_mm) +
                       " mm; give a side in [2, 50] mm");
  if (!(options.from_hu < options.to_hu)) throw InvalidInput("noise: from_hu has to be less than to_hu");
}

}  // namespace

std::optional<double> noise_level_hu(const ImageVolume& image, const geometry::Box3& within,
                                     const NoiseOptions& options) {
  validate(options);
  const Geometry& grid = image.geometry;
  const Region region = voxels_in(grid, within);
  const double in_plane = std::max(grid.spacing.x(), grid.spacing.y());
  const auto side =
      std::max(least_side, static_cast<std::int64_t>(std::lround(options.square_mm / in_plane)));
  const std::int64_t across = (region.upper[0] - region.lower[0]) / side,
                     down = (region.upper[1] - region.lower[1]) / side,
                     slices = region.upper[2] - region.lower[2];
  if (across <= 0 || down <= 0 || slices <= 0) return std::nullopt;
  const auto in_slice = static_cast<std::size_t>(across * down);
  const auto kept = static_cast<std::int64_t>(std::max<std::size_t>(1, most_squares / in_slice));
  const std::int64_t step = std::max<std::int64_t>(1, (slices + kept - 1) / kept);
  const auto looked_at = static_cast<std::size_t>((slices + step - 1) / step);
  std::vector<SquareNoise> all(looked_at * in_slice);
  core::parallel_for(looked_at, 4, [&](std::size_t n) {
    const std::int64_t k = region.lower[2] + static_cast<std::int64_t>(n) * step;
    for (std::int64_t s = 0; s < across * down; ++s)
      all[n * in_slice + static_cast<std::size_t>(s)] = noise_of(
          image, region.lower[0] + (s % across) * side, region.lower[1] + (s / across) * side, k, side);
  });
  std::vector<double> deviations;
  for (const SquareNoise& one : all)
    if (one.mean_hu >= options.from_hu && one.mean_hu <= options.to_hu)
      deviations.push_back(one.deviation_hu);
  if (deviations.size() < least_squares) return std::nullopt;
  return commonest(std::move(deviations));
}

}  // namespace ostia::imaging
