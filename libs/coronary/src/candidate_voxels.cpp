#include "candidate_voxels.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::coronary {

imaging::MaskVolume vessel_candidates(const imaging::ImageVolume& image, double level_hu, double inner_mm,
                                      const core::TaskContext& task) {
  const imaging::Geometry& grid = image.geometry;
  std::array<std::int64_t, 3> reach{};
  for (std::size_t a = 0; a < 3; ++a)
    reach[a] = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(inner_mm / grid.spacing[static_cast<Eigen::Index>(a)]));
  const std::array<std::int64_t, 3> stride{1, grid.size[0], grid.size[0] * grid.size[1]};
  const auto level = static_cast<std::int16_t>(std::ceil(level_hu));
  imaging::MaskVolume mask;
  mask.geometry = grid;
  mask.voxels.assign(image.voxels.size(), 0);
  core::parallel_for(static_cast<std::size_t>(grid.size[2]), 4, [&](std::size_t slice) {
    task.throw_if_cancelled();
    std::array<std::int64_t, 3> at{0, 0, static_cast<std::int64_t>(slice)};
    for (at[1] = 0; at[1] < grid.size[1]; ++at[1])
      for (at[0] = 0; at[0] < grid.size[0]; ++at[0]) {
        const std::int64_t offset = grid.offset(at[0], at[1], at[2]);
        if (image.voxels[static_cast<std::size_t>(offset)] < level) continue;
        int darker = 0;
        for (std::size_t a = 0; a < 3; ++a)
          for (const std::int64_t sign : {-1, 1}) {
            const std::int64_t there = at[a] + sign * reach[a];
            darker +=
                there < 0 || there >= grid.size[a] ||
                        image.voxels[static_cast<std::size_t>(offset + sign * reach[a] * stride[a])] < level
                    ? 1
                    : 0;
          }
        mask.voxels[static_cast<std::size_t>(offset)] = darker >= 2 ? 1 : 0;
      }
  });
  return mask;
}

}  // namespace ostia::coronary
