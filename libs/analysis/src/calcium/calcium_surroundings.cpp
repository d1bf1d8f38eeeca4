#include "calcium/calcium_surroundings.h"

#include "ostia/imaging/morphology.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr double inner_mm = 2.5, outer_mm = 6.0;
constexpr float cartilage_hu = 100.0F;

}  // namespace

std::vector<imaging::Region> part_boxes(const CalciumSpots& found, const imaging::Geometry& grid) {
  imaging::Region none;
  none.lower = grid.size;
  std::vector<imaging::Region> boxes(found.parts.voxels.size(), none);
  std::size_t n = 0;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i, ++n) {
        const std::uint32_t part = found.parts.label[n];
        if (part == 0) continue;
        const std::array<std::int64_t, 3> at{i, j, k};
        for (std::size_t d = 0; d < 3; ++d) {
          boxes[part].lower[d] = std::min(boxes[part].lower[d], at[d]);
          boxes[part].upper[d] = std::max(boxes[part].upper[d], at[d] + 1);
        }
      }
  return boxes;
}

double bright_surroundings(const CalciumSlices& slices, const CalciumSpots& found, std::uint32_t part,
                           const imaging::Region& box) {
  const imaging::FloatVolume& image = slices.image;
  const imaging::Geometry& grid = image.geometry;
  const std::int64_t k = (box.lower[2] + box.upper[2] - 1) / 2;
  std::array<std::int64_t, 2> low{}, high{};
  for (std::size_t d = 0; d < 2; ++d) {
    const auto more =
        static_cast<std::int64_t>(std::ceil(outer_mm / grid.spacing[static_cast<Eigen::Index>(d)]));
    low[d] = std::max<std::int64_t>(0, box.lower[d] - more);
    high[d] = std::min(grid.size[d], box.upper[d] + more);
  }
  imaging::MaskVolume mask{grid, {}};
  mask.geometry.size = {high[0] - low[0], high[1] - low[1], 1};
  const auto label = [&](std::int64_t i, std::int64_t j) {
    return found.parts.label[static_cast<std::size_t>(grid.offset(i, j, k))];
  };
  for (std::int64_t j = low[1]; j < high[1]; ++j)
    for (std::int64_t i = low[0]; i < high[0]; ++i) mask.voxels.push_back(label(i, j) == part ? 1 : 0);
  const imaging::MaskVolume inner = imaging::dilated(mask, inner_mm),
                            outer = imaging::dilated(mask, outer_mm);
  double all = 0.0, bright = 0.0;
  std::size_t n = 0;
  for (std::int64_t j = low[1]; j < high[1]; ++j)
    for (std::int64_t i = low[0]; i < high[0]; ++i, ++n) {
      if (outer.voxels[n] == 0 || inner.voxels[n] != 0 || label(i, j) != 0) continue;
      all += 1.0;
      bright += image(i, j, k) > cartilage_hu ? 1.0 : 0.0;
    }
  return all > 0.0 ? bright / all : 0.0;
}

}  // namespace ostia::analysis
