#include "ostia/evaluation/image_quality.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

void require_grid(const imaging::ImageVolume& image, const imaging::MaskVolume& mask) {
  if (!imaging::same_grid(image.geometry, mask.geometry))
    throw InvalidInput("image quality: the mask and the image are on different grids");
}

double percentile(const std::vector<std::int16_t>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

HuStatistics statistics_of(std::vector<std::int16_t> values, const char* where) {
  if (values.empty()) throw InvalidInput(std::string("HU statistics: no voxel lies in the ") + where);
  std::sort(values.begin(), values.end());
  HuStatistics result;
  result.voxels = values.size();
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, square = 0.0;
  for (const std::int16_t v : values) sum += v;
  result.mean_hu = sum / n;
  for (const std::int16_t v : values) square += (v - result.mean_hu) * (v - result.mean_hu);
  result.deviation_hu = values.size() > 1 ? std::sqrt(square / (n - 1.0)) : 0.0;
  result.median_hu = percentile(values, 0.5);
  result.p05_hu = percentile(values, 0.05);
  result.p95_hu = percentile(values, 0.95);
  return result;
}

}  // namespace

HuStatistics hu_statistics(const imaging::ImageVolume& image, const imaging::MaskVolume& mask,
                           std::uint8_t value) {
  require_grid(image, mask);
  std::vector<std::int16_t> values;
  for (std::size_t i = 0; i < image.voxels.size(); ++i) {
    if (value == 0 ? mask.voxels[i] != 0 : mask.voxels[i] == value) values.push_back(image.voxels[i]);
  }
  return statistics_of(std::move(values), "mask");
}

HuStatistics hu_statistics(const imaging::ImageVolume& image, const Vec3& centre_mm, double radius_mm) {
  const imaging::Geometry& g = image.geometry;
  const Vec3 middle = g.index(centre_mm), reach = Vec3::Constant(radius_mm).cwiseQuotient(g.spacing);
  std::array<std::int64_t, 3> lower{}, upper{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double most = static_cast<double>(g.size[a]);
    lower[a] = static_cast<std::int64_t>(std::clamp(std::ceil(middle[axis] - reach[axis]), 0.0, most));
    upper[a] = static_cast<std::int64_t>(std::clamp(std::floor(middle[axis] + reach[axis]) + 1.0, 0.0, most));
  }
  std::vector<std::int16_t> values;
  for (std::int64_t k = lower[2]; k < upper[2]; ++k) {
    for (std::int64_t j = lower[1]; j < upper[1]; ++j) {
      for (std::int64_t i = lower[0]; i < upper[0]; ++i) {
        const Vec3 p = g.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if ((p - centre_mm).squaredNorm() <= radius_mm * radius_mm) values.push_back(image(i, j, k));
      }
    }
  }
  return statistics_of(std::move(values), "ball");
}

HuHistogram hu_histogram(const imaging::ImageVolume& image, double from_hu, double to_hu, double bin_hu,
                         const imaging::MaskVolume* mask) {
  if (!(bin_hu > 0.0) || !(to_hu > from_hu) || !std::isfinite(to_hu - from_hu) ||
      (to_hu - from_hu) / bin_hu > 1e6)
    throw InvalidInput("HU histogram: the range [" + std::to_string(from_hu) + ", " + std::to_string(to_hu) +
                       ") in bins of " + std::to_string(bin_hu) + " HU makes no sense");
  if (mask != nullptr) require_grid(image, *mask);
  HuHistogram result{from_hu, bin_hu, {}};
  const auto bins = static_cast<std::size_t>(std::ceil((to_hu - from_hu) / bin_hu));
  result.share.assign(bins, 0.0);
  double count = 0.0;
  for (std::size_t i = 0; i < image.voxels.size(); ++i) {
    if (mask != nullptr && mask->voxels[i] == 0) continue;
    const double bin = std::floor((image.voxels[i] - from_hu) / bin_hu);
    result.share[static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins - 1)))] += 1.0;
    count += 1.0;
  }
  if (count == 0.0) throw InvalidInput("HU histogram: there are no voxels");
  for (double& share : result.share) share /= count;
  return result;
}

double histogram_distance(const HuHistogram& a, const HuHistogram& b) {
  if (a.share.size() != b.share.size() || a.from_hu != b.from_hu || a.bin_hu != b.bin_hu)
    throw InvalidInput("HU histograms of different bins cannot be compared");
  double sum = 0.0;
  for (std::size_t i = 0; i < a.share.size(); ++i) sum += std::abs(a.share[i] - b.share[i]);
  return 0.5 * sum;
}

}  // namespace ostia::evaluation
