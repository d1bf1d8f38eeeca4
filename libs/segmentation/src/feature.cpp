#include "ostia/segmentation/feature.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace ostia::segmentation {
namespace {

struct Axis {
  std::int64_t size;
  std::int64_t stride;
  double spacing;
};

/// One derivative at a voxel `at` places along its axis.
template <GradientScheme scheme>
double derivative(const std::int16_t* voxel, std::int64_t at, const Axis& axis) {
  const double here = *voxel;
  const bool has_before = at > 0;
  const bool has_after = at + 1 < axis.size;
  const double before = has_before ? voxel[-axis.stride] : here;
  const double after = has_after ? voxel[axis.stride] : here;
  if constexpr (scheme == GradientScheme::upwind) {
    return std::max({here - after, here - before, 0.0}) / axis.spacing;
  } else {
    const double steps = (has_before ? 1.0 : 0.0) + (has_after ? 1.0 : 0.0);
    return steps > 0.0 ? (after - before) / (steps * axis.spacing) : 0.0;
  }
}

template <GradientScheme scheme>
void fill(const imaging::ImageVolume& image, const imaging::Region& region, imaging::FloatVolume& out,
          const core::TaskContext& task) {
  const auto& g = image.geometry;
  const std::array<Axis, 3> axes{Axis{g.size[0], 1, g.spacing[0]}, Axis{g.size[1], g.size[0], g.spacing[1]},
                                 Axis{g.size[2], g.size[0] * g.size[1], g.spacing[2]}};
  const std::int64_t rows = out.geometry.size[1] * out.geometry.size[2];
  core::parallel_for(static_cast<std::size_t>(rows), 64, [&](std::size_t row) {
    if (row % 4096 == 0) task.throw_if_cancelled();
    const std::int64_t j = region.lower[1] + static_cast<std::int64_t>(row) % out.geometry.size[1];
    const std::int64_t k = region.lower[2] + static_cast<std::int64_t>(row) / out.geometry.size[1];
    float* target = out.voxels.data() + static_cast<std::int64_t>(row) * out.geometry.size[0];
    const std::int16_t* source = image.voxels.data() + g.offset(0, j, k);
    for (std::int64_t i = region.lower[0]; i < region.upper[0]; ++i) {
      const double x = derivative<scheme>(source + i, i, axes[0]);
      const double y = derivative<scheme>(source + i, j, axes[1]);
      const double z = derivative<scheme>(source + i, k, axes[2]);
      *target++ = static_cast<float>(std::sqrt(x * x + y * y + z * z));
    }
  });
}

}  // namespace

imaging::FloatVolume gradient_magnitude(const imaging::ImageVolume& image, const imaging::Region& region,
                                        GradientScheme scheme, const core::TaskContext& task) {
  const auto& g = image.geometry;
  imaging::FloatVolume out;
  out.geometry = g;
  for (int d = 0; d < 3; ++d) {
    if (region.lower[d] < 0 || region.upper[d] > g.size[d] || region.lower[d] >= region.upper[d]) {
      throw InvalidInput("gradient magnitude: the region [" + std::to_string(region.lower[d]) + ", " +
                         std::to_string(region.upper[d]) + ") along axis " + std::to_string(d) +
                         " is empty or not inside the image of " + std::to_string(g.size[d]) + " voxels");
    }
    out.geometry.size[d] = region.upper[d] - region.lower[d];
  }
  out.geometry.origin =
      g.world(Vec3(static_cast<double>(region.lower[0]), static_cast<double>(region.lower[1]),
                   static_cast<double>(region.lower[2])));
  out.voxels.resize(static_cast<std::size_t>(out.geometry.voxels()));
  if (scheme == GradientScheme::upwind) {
    fill<GradientScheme::upwind>(image, region, out, task);
  } else {
    fill<GradientScheme::centred>(image, region, out, task);
  }
  return out;
}

void compress_feature(imaging::FloatVolume& gradient_magnitude, double k_hu_per_mm) {
  if (!(k_hu_per_mm > 0.0) || !std::isfinite(k_hu_per_mm)) {
    throw InvalidInput("compress_feature: k must be positive and finite, in HU/mm");
  }
  const float inverse = static_cast<float>(1.0 / k_hu_per_mm);
  core::parallel_for(gradient_magnitude.voxels.size(), 65536, [&](std::size_t n) {
    const float part = gradient_magnitude.voxels[n] * inverse;
    gradient_magnitude.voxels[n] = 0.5F * std::log1p(part * part);
  });
}

}  // namespace ostia::segmentation
