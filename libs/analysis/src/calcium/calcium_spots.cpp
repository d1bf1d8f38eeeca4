#include "calcium/calcium_spots.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::analysis {
namespace {

using imaging::FloatVolume;
using imaging::Geometry;
using imaging::MaskVolume;

/// Of one slice: clears what is too small in `slice`.
std::vector<CalciumSpot> spots_of(const FloatVolume& image, std::int64_t k, MaskVolume& slice,
                                  const CalciumOptions& o) {
  const Geometry& grid = image.geometry;
  const auto start = static_cast<std::size_t>(grid.offset(0, 0, k));
  const imaging::Components parts = imaging::components(slice);
  const double pixel_mm2 = grid.spacing.x() * grid.spacing.y();
  std::vector<CalciumSpot> spots(parts.voxels.size());
  for (std::size_t n = 0; n < slice.voxels.size(); ++n) {
    const std::uint32_t part = parts.label[n];
    if (part == 0) continue;
    CalciumSpot& spot = spots[part];
    if (spot.area_mm2 == 0.0) spot.first_voxel = static_cast<std::int64_t>(start + n);
    spot.area_mm2 += pixel_mm2;
    spot.peak_hu = std::max(spot.peak_hu, static_cast<double>(image.voxels[start + n]));
    spot.slice = k;
  }
  const auto counts = [&](const CalciumSpot& spot) { return spot.area_mm2 >= o.least_area_mm2 - 1e-9; };
  for (std::size_t n = 0; n < slice.voxels.size(); ++n)
    if (parts.label[n] != 0 && !counts(spots[parts.label[n]])) slice.voxels[n] = 0;
  spots.erase(spots.begin());
  std::erase_if(spots, [&](const CalciumSpot& spot) { return !counts(spot); });
  return spots;
}

/// How far calcium reaches from a voxel's centre towards a neighbour, as a share of their distance, with
/// values linear between; half where the neighbour is calcium, too, whose the other half is.
double reach(double hu, double neighbour_hu, double threshold_hu) {
  if (neighbour_hu >= threshold_hu) return 0.5;
  return (hu - threshold_hu) / (hu - neighbour_hu);
}

}  // namespace

int agatston_weight(double peak_hu) {
  return peak_hu < 130.0 ? 0 : peak_hu < 200.0 ? 1 : peak_hu < 300.0 ? 2 : peak_hu < 400.0 ? 3 : 4;
}

CalciumSpots calcium_spots(const CalciumSlices& slices, const CalciumOptions& o,
                           const core::TaskContext& task) {
  const FloatVolume& image = slices.image;
  const Geometry& grid = image.geometry;
  const auto per_slice = static_cast<std::size_t>(grid.size[0] * grid.size[1]);
  MaskVolume mask{grid, std::vector<std::uint8_t>(image.voxels.size())};
  std::vector<std::vector<CalciumSpot>> by_slice(static_cast<std::size_t>(grid.size[2]));
  core::parallel_for(by_slice.size(), 1, [&](std::size_t k) {
    task.throw_if_cancelled();
    MaskVolume slice{grid, std::vector<std::uint8_t>(per_slice)};
    slice.geometry.size[2] = 1;
    for (std::size_t n = 0; n < per_slice; ++n)
      slice.voxels[n] = static_cast<double>(image.voxels[k * per_slice + n]) >= o.threshold_hu ? 1 : 0;
    by_slice[k] = spots_of(image, static_cast<std::int64_t>(k), slice, o);
    std::copy(slice.voxels.begin(), slice.voxels.end(),
              mask.voxels.begin() + static_cast<std::ptrdiff_t>(k * per_slice));
  });
  CalciumSpots out;
  for (const std::vector<CalciumSpot>& spots : by_slice)
    out.spots.insert(out.spots.end(), spots.begin(), spots.end());
  out.parts = imaging::components(mask);
  return out;
}

std::vector<CalciumLesion> measured_parts(const CalciumSlices& slices, const CalciumSpots& found,
                                          const CalciumOptions& o, const core::TaskContext& task) {
  const FloatVolume& image = slices.image;
  const Geometry& grid = image.geometry;
  std::vector<CalciumLesion> out(found.parts.voxels.size());
  std::vector<double> above(out.size(), 0.0);
  std::vector<std::int64_t> last_slice(out.size(), -1);
  for (std::int64_t k = 0; k < grid.size[2]; ++k) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(k) / static_cast<double>(grid.size[2]));
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const std::uint32_t part = found.parts.label[static_cast<std::size_t>(grid.offset(i, j, k))];
        if (part == 0) continue;
        CalciumLesion& lesion = out[part];
        const double hu = image(i, j, k), volume = slices.voxel_mm3(k);
        const double below = k > 0 ? image(i, j, k - 1) : hu,
                     over = k + 1 < grid.size[2] ? image(i, j, k + 1) : hu;
        lesion.amount.volume_mm3 += volume;
        lesion.amount.interpolated_mm3 +=
            volume * (reach(hu, below, o.threshold_hu) + reach(hu, over, o.threshold_hu));
        if (o.calibration) lesion.amount.mass_mg += *o.calibration * hu * volume / 1000.0;
        const double weight = hu - o.threshold_hu + 1.0;
        lesion.centre +=
            weight * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        above[part] += weight;
        lesion.peak_hu = std::max(lesion.peak_hu, hu);
        if (last_slice[part] != k) ++lesion.slices;
        last_slice[part] = k;
      }
  }
  for (std::size_t part = 1; part < out.size(); ++part)
    out[part].centre = grid.world(out[part].centre / above[part]);
  for (const CalciumSpot& spot : found.spots) {
    const std::uint32_t part = found.parts.label[static_cast<std::size_t>(spot.first_voxel)];
    out[part].amount.agatston +=
        spot.area_mm2 * agatston_weight(spot.peak_hu) * slices.height(spot.slice, o.definition_mm);
  }
  return out;
}

}  // namespace ostia::analysis
