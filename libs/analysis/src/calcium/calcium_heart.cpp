#include "calcium/calcium_heart.h"

#include "ostia/imaging/morphology.h"
#include "ostia/imaging/reduced_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::analysis {
namespace {

using imaging::FloatVolume;
using imaging::Geometry;
using imaging::ImageVolume;
using imaging::MaskVolume;

constexpr double cell_mm = 4.0;
constexpr double least_tissue_hu = -50.0;  // fat and lung are darker
constexpr double least_ball_mm = 20.0, largest_ball_mm = 70.0;
constexpr double core_share = 0.6;  // of the largest ball: what is thicker than that is bulk
constexpr double bright_share = 0.8;

ImageVolume whole_numbers(const FloatVolume& image) {
  ImageVolume out{image.geometry, {}};
  out.voxels.reserve(image.voxels.size());
  for (const float hu : image.voxels)
    out.voxels.push_back(static_cast<std::int16_t>(std::lround(std::clamp(hu, -32768.0F, 32767.0F))));
  return out;
}

/// About 4 mm wide cells; the rim of the field is no tissue, so that nothing is thick by being cut.
MaskVolume tissue_of(const ImageVolume& cells) {
  const Geometry& grid = cells.geometry;
  MaskVolume mask{grid, std::vector<std::uint8_t>(cells.voxels.size(), 0)};
  for (std::int64_t k = 1; k + 1 < grid.size[2]; ++k)
    for (std::int64_t j = 1; j + 1 < grid.size[1]; ++j)
      for (std::int64_t i = 1; i + 1 < grid.size[0]; ++i)
        mask(i, j, k) = cells(i, j, k) >= least_tissue_hu ? 1 : 0;
  return mask;
}

bool is_empty(const MaskVolume& mask) {
  return std::none_of(mask.voxels.begin(), mask.voxels.end(), [](std::uint8_t v) { return v != 0; });
}

/// Radius of the largest ball in the mask, to a quarter of a cell.
double largest_ball_in(const MaskVolume& mask) {
  double low = 0.0, high = largest_ball_mm + cell_mm;
  if (!is_empty(imaging::eroded(mask, high))) return high;
  while (high - low > 0.25 * cell_mm) {
    const double radius = 0.5 * (low + high);
    (is_empty(imaging::eroded(mask, radius)) ? high : low) = radius;
  }
  return low;
}

/// The largest part of the mask alone.
void keep_largest(MaskVolume& mask) {
  const imaging::Components parts = imaging::components(mask);
  if (parts.voxels.size() < 2) return;
  const auto largest = static_cast<std::uint32_t>(
      std::max_element(parts.voxels.begin() + 1, parts.voxels.end()) - parts.voxels.begin());
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) mask.voxels[n] = parts.label[n] == largest ? 1 : 0;
}

}  // namespace

std::optional<HeartBulk> heart_bulk(const FloatVolume& image, const core::TaskContext& task) {
  imaging::ReducedVolumeOptions coarse;
  const double field_mm3 = static_cast<double>(image.geometry.voxels()) * image.geometry.spacing.prod();
  coarse.most_voxels = std::max<std::int64_t>(8, std::llround(field_mm3 / (cell_mm * cell_mm * cell_mm)));
  const ImageVolume cells = imaging::reduced_volume(whole_numbers(image), coarse, task);
  const MaskVolume tissue = tissue_of(cells);
  const double ball_mm = largest_ball_in(tissue);
  if (ball_mm < least_ball_mm || ball_mm > largest_ball_mm) return std::nullopt;
  HeartBulk heart;
  heart.mask = imaging::eroded(tissue, core_share * ball_mm);
  keep_largest(heart.mask);
  heart.mask = imaging::dilated(heart.mask, core_share * ball_mm);
  std::vector<std::int16_t> values;
  const Geometry& grid = cells.geometry;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        if (heart.mask(i, j, k) == 0) continue;
        values.push_back(cells(i, j, k));
        heart.centre += Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
      }
  if (values.empty()) return std::nullopt;
  const auto count = static_cast<double>(values.size());
  heart.centre = grid.world(heart.centre / count);
  heart.radius_mm = std::cbrt(0.75 / std::numbers::pi * count * grid.spacing.prod());
  const auto at = static_cast<std::ptrdiff_t>(bright_share * (count - 1.0));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  heart.bright_hu = values[static_cast<std::size_t>(at)];
  return heart;
}

}  // namespace ostia::analysis
