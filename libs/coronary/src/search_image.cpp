#include "search_image.h"

#include "median.h"

#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/frame.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::coronary {
namespace {

constexpr double coarse_slice_mm = 1.25, coarse_slice_share = 1.4;  // of the voxels' width
constexpr double fine_slice_mm = 1.0;                               // at most, afterwards
constexpr double epicardial_fat_hu = -90.0;
constexpr double left_noise = 0.75;   // at a vessel's width, by such a blur
constexpr double borne_noise = 0.14;  // as a share of the contrast above fat
constexpr double noise_blur_mm = 0.5;

imaging::ImageVolume with_finer_slices(const imaging::ImageVolume& image, Eigen::Index axis,
                                       const core::TaskContext& task) {
  imaging::Geometry grid = image.geometry;
  const auto parts = static_cast<std::int64_t>(std::ceil(grid.spacing[axis] / fine_slice_mm));
  const auto a = static_cast<std::size_t>(axis);
  grid.size[a] = (grid.size[a] - 1) * parts + 1;
  grid.spacing[axis] /= static_cast<double>(parts);
  return imaging::resampled(image, grid, imaging::Interpolation::cubic, std::int16_t{-1024}, task);
}

imaging::ImageVolume blurred(const imaging::ImageVolume& image, double sigma_mm,
                             const core::TaskContext& task) {
  imaging::FloatVolume values{image.geometry, {image.voxels.begin(), image.voxels.end()}};
  values = imaging::gaussian_blurred(values, sigma_mm, task);
  imaging::ImageVolume result{image.geometry, {}};
  result.voxels.resize(values.voxels.size());
  std::transform(values.voxels.begin(), values.voxels.end(), result.voxels.begin(),
                 [](float hu) { return static_cast<std::int16_t>(std::lround(hu)); });
  return result;
}

}  // namespace

double aortic_noise_hu(const imaging::ImageVolume& image, const Aorta& aorta) {
  constexpr double inner = 0.6, step_mm = 1.0;  // of the radius: clear of the wall
  constexpr std::size_t least_values = 20;
  constexpr double normal = 1.4826;  // a normal deviation over its median absolute one
  std::vector<double> deviations;
  for (const AortaStation& station : aorta.stations) {
    const Vec3 u = geometry::initial_normal(station.tangent), v = station.tangent.cross(u);
    const double reach = inner * station.radius_mm;
    std::vector<double> hu;
    for (double a = -reach; a <= reach; a += step_mm)
      for (double b = -reach; b <= reach; b += step_mm) {
        const Vec3 at = station.centre + a * u + b * v;
        if (std::hypot(a, b) > reach || !image.geometry.contains(at)) continue;
        hu.push_back(imaging::sample(image, at, imaging::Interpolation::nearest));
      }
    if (hu.size() < least_values) continue;
    const double middle = median(hu);
    for (double& value : hu) value = std::abs(value - middle);
    deviations.push_back(normal * median(hu));
  }
  if (deviations.empty()) return 0.0;
  const auto quarter = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 4);
  std::nth_element(deviations.begin(), quarter, deviations.end());
  return *quarter;
}

SearchImage search_image(const imaging::ImageVolume& image, const Aorta& aorta,
                         const core::TaskContext& task) {
  SearchImage result;
  const Vec3& spacing = image.geometry.spacing;
  Eigen::Index axis = 0;
  const double slice_mm = spacing.maxCoeff(&axis);
  const double wide_mm = std::max(spacing[(axis + 1) % 3], spacing[(axis + 2) % 3]);
  if (slice_mm > coarse_slice_mm && slice_mm > coarse_slice_share * wide_mm)
    result.changed = with_finer_slices(image, axis, task.sub(0.0, 0.5));
  result.noise_hu = aortic_noise_hu(image, aorta);
  if (result.noise_hu <= borne_noise * (aorta.lumen_hu - epicardial_fat_hu)) return result;
  result.blur_mm = noise_blur_mm;
  result.changed = blurred(result.of(image), result.blur_mm, task.sub(0.5, 1.0));
  result.warnings.push_back(
      "the image is noisy (a deviation of " + core::rounded_text(result.noise_hu, 0) +
      " HU in the aorta): arteries were sought in a smoother copy, and thin ones may be "
      "missing");
  result.noise_hu *= left_noise;
  return result;
}

}  // namespace ostia::coronary
