#include "ostia/segmentation/feature.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace ostia::segmentation {
namespace {

struct Axis {
  std::int64_t size;
  std::int64_t stride;
  double spacing;
};

/// One derivative at a voxel `at` places along its axis.
template <GradientScheme scheme, class T>
double derivative(const T* voxel, std::int64_t at, const Axis& axis) {
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

template <GradientScheme scheme, class T>
void fill(const imaging::Volume<T>& image, const imaging::Region& region, imaging::FloatVolume& out,
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
    const T* source = image.voxels.data() + g.offset(0, j, k);
    for (std::int64_t i = region.lower[0]; i < region.upper[0]; ++i) {
      const double x = derivative<scheme>(source + i, i, axes[0]);
      const double y = derivative<scheme>(source + i, j, axes[1]);
      const double z = derivative<scheme>(source + i, k, axes[2]);
      *target++ = static_cast<float>(std::sqrt(x * x + y * y + z * z));
    }
  });
}

/// A volume without values on a region of a grid. Throws InvalidInput that begins with `what`.
imaging::FloatVolume on_region(const imaging::Geometry& g, const imaging::Region& region, const char* what) {
  imaging::FloatVolume out;
  out.geometry = g;
  for (int d = 0; d < 3; ++d) {
    if (region.lower[d] < 0 || region.upper[d] > g.size[d] || region.lower[d] >= region.upper[d]) {
      throw InvalidInput(std::string(what) + ": the region [" + std::to_string(region.lower[d]) + ", " +
                         std::to_string(region.upper[d]) + ") along axis " + std::to_string(d) +
                         " is empty or not inside the image of " + std::to_string(g.size[d]) + " voxels");
    }
    out.geometry.size[d] = region.upper[d] - region.lower[d];
  }
  out.geometry.origin =
      g.world(Vec3(static_cast<double>(region.lower[0]), static_cast<double>(region.lower[1]),
                   static_cast<double>(region.lower[2])));
  out.voxels.resize(static_cast<std::size_t>(out.geometry.voxels()));
  return out;
}

/// The region with `margin` more on every side, within the grid.
imaging::Region widened(const imaging::Region& region, const std::array<std::int64_t, 3>& size,
                        const std::array<std::int64_t, 3>& margin) {
  imaging::Region out;
  for (std::size_t d = 0; d < 3; ++d) {
    out.lower[d] = std::max<std::int64_t>(region.lower[d] - margin[d], 0);
    out.upper[d] = std::min(region.upper[d] + margin[d], size[d]);
  }
  return out;
}

}  // namespace

imaging::FloatVolume gradient_magnitude(const imaging::ImageVolume& image, const imaging::Region& region,
                                        GradientScheme scheme, const core::TaskContext& task) {
  imaging::FloatVolume out = on_region(image.geometry, region, "gradient magnitude");
  if (scheme == GradientScheme::upwind) {
    fill<GradientScheme::upwind>(image, region, out, task);
  } else {
    fill<GradientScheme::centred>(image, region, out, task);
  }
  return out;
}

imaging::FloatVolume gaussian_gradient_magnitude(const imaging::ImageVolume& image,
                                                 const imaging::Region& region, double sigma_mm,
                                                 const core::TaskContext& task) {
  constexpr const char* kWhat = "Gaussian derivatives";
  if (!(sigma_mm > 0.0) || sigma_mm > 100.0)
    throw InvalidInput(std::string(kWhat) + ": sigma is " + std::to_string(sigma_mm) +
                       " mm; it must be in (0, 100]");
  imaging::FloatVolume out = on_region(image.geometry, region, kWhat);
  std::array<std::int64_t, 3> margin{};
  for (int d = 0; d < 3; ++d)
    margin[static_cast<std::size_t>(d)] =
        4 + static_cast<std::int64_t>(std::ceil(4.0 * sigma_mm / image.geometry.spacing[d]));
  const imaging::Region wide = widened(region, image.geometry.size, margin);
  const imaging::ImageVolume part = imaging::cropped(image, wide);
  const imaging::FloatVolume blurred = imaging::gaussian_blurred(
      {part.geometry, {part.voxels.begin(), part.voxels.end()}}, sigma_mm, task.sub(0.0, 0.8));
  imaging::Region inner;
  for (std::size_t d = 0; d < 3; ++d) {
    inner.lower[d] = region.lower[d] - wide.lower[d];
    inner.upper[d] = region.upper[d] - wide.lower[d];
  }
  fill<GradientScheme::centred>(blurred, inner, out, task.sub(0.8, 1.0));
  return out;
}

imaging::FloatVolume balloon_speed(const imaging::ImageVolume& image, const imaging::Region& region,
                                   double mean_hu, double sigma_hu, double tau) {
  if (!(sigma_hu > 0.0) || !std::isfinite(mean_hu) || !std::isfinite(tau))
    throw InvalidInput("balloon: sigma must be positive, mean and tau finite");
  imaging::FloatVolume out = on_region(image.geometry, region, "balloon");
  const imaging::ImageVolume part = imaging::cropped(image, region);
  core::parallel_for(out.voxels.size(), 65536, [&](std::size_t n) {
    const double away = (part.voxels[n] - mean_hu) / sigma_hu;
    out.voxels[n] = static_cast<float>(std::exp(-away * away) - tau);
  });
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
