#include "ostia/view/volume_light.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace ostia::view {
namespace {

constexpr double near_mm = 3.0, far_mm = 8.0;
constexpr float solid_hu = 200.0F;
constexpr float near_share = 0.5F, far_share = 0.5F;

/// Means over `radius` voxels to either side along one axis; beyond the image there is nothing.
void mean_along(std::vector<float>& values, const imaging::Geometry& grid, std::size_t axis,
                std::int64_t radius) {
  const std::array<std::int64_t, 3> stride{1, grid.size[0], grid.size[0] * grid.size[1]};
  const std::size_t a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  const std::int64_t count = grid.size[axis], step = stride[axis];
  const auto width = static_cast<float>(2 * radius + 1);
  core::parallel_for(static_cast<std::size_t>(grid.size[b]), 1, [&](std::size_t outer) {
    std::vector<float> line(static_cast<std::size_t>(count));
    for (std::int64_t inner = 0; inner < grid.size[a]; ++inner) {
      float* first = values.data() + static_cast<std::int64_t>(outer) * stride[b] + inner * stride[a];
      for (std::int64_t n = 0; n < count; ++n) line[static_cast<std::size_t>(n)] = first[n * step];
      float sum = 0.0F;
      for (std::int64_t n = 0; n < std::min(radius, count); ++n) sum += line[static_cast<std::size_t>(n)];
      for (std::int64_t n = 0; n < count; ++n) {
        if (n + radius < count) sum += line[static_cast<std::size_t>(n + radius)];
        first[n * step] = sum / width;
        if (n - radius >= 0) sum -= line[static_cast<std::size_t>(n - radius)];
      }
    }
  });
}

std::vector<float> mean_about(std::vector<float> values, const imaging::Geometry& grid, double radius_mm) {
  for (const std::size_t axis : {0, 1, 2})
    mean_along(
        values, grid, axis,
        std::max<std::int64_t>(1, std::llround(radius_mm / grid.spacing[static_cast<Eigen::Index>(axis)])));
  return values;
}

}  // namespace

std::vector<float> ambient_light(const imaging::ImageVolume& image, const core::TaskContext& task) {
  std::vector<float> solid(image.voxels.size());
  core::parallel_for(solid.size(), 262144, [&](std::size_t n) {
    solid[n] = std::clamp(static_cast<float>(image.voxels[n]) / solid_hu, 0.0F, 1.0F);
  });
  task.throw_if_cancelled();
  const std::vector<float> close = mean_about(solid, image.geometry, near_mm);
  task.throw_if_cancelled();
  std::vector<float> light = mean_about(std::move(solid), image.geometry, far_mm);
  core::parallel_for(light.size(), 262144, [&](std::size_t n) {
    light[n] = std::clamp(1.0F - near_share * close[n] - far_share * light[n], 0.0F, 1.0F);
  });
  return light;
}

}  // namespace ostia::view
