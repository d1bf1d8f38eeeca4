#include "motion/level_set_image.h"

#include "ostia/geometry/isosurface.h"

#include <algorithm>

namespace ostia::experiments {

imaging::FloatVolume share_inside(const imaging::FloatVolume& level_set) {
  const double ramp = 0.5 * level_set.geometry.spacing.maxCoeff();
  imaging::FloatVolume share{level_set.geometry, std::vector<float>(level_set.voxels.size())};
  std::transform(level_set.voxels.begin(), level_set.voxels.end(), share.voxels.begin(), [&](float phi) {
    return static_cast<float>(1000.0 * std::clamp(0.5 - 0.5 * phi / ramp, 0.0, 1.0));
  });
  return share;
}

imaging::MaskVolume mask_inside(const imaging::FloatVolume& level_set) {
  imaging::MaskVolume mask{level_set.geometry, std::vector<std::uint8_t>(level_set.voxels.size())};
  std::transform(level_set.voxels.begin(), level_set.voxels.end(), mask.voxels.begin(),
                 [](float phi) { return static_cast<std::uint8_t>(phi < 0.0F ? 1 : 0); });
  return mask;
}

geometry::TriMesh isosurface_of(const imaging::FloatVolume& level_set, const core::TaskContext& task) {
  geometry::ScalarGrid grid;
  grid.size = level_set.geometry.size;
  grid.values = level_set.voxels.data();
  grid.origin = level_set.geometry.origin;
  grid.axes = level_set.geometry.direction * level_set.geometry.spacing.asDiagonal();
  return geometry::isosurface(grid, 0.0F, true, task);
}

}  // namespace ostia::experiments
