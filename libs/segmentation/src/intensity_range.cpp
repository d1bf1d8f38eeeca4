#include "ostia/segmentation/intensity_range.h"

#include "range_about_seeds.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::segmentation {
namespace detail {
namespace {

using core::fixed_text;

constexpr double kNoVesselHu = -300.0;
constexpr int kDarkestTissueHu = -150;  // fat and its mixtures with lung lie below
constexpr double kTissueHu = 50.0;      // where the neighbourhood shows no background
constexpr double kNeighbourhoodMm = 20.0;
constexpr double kLeastContrast = 1.0 / 3.0;  // of the darkest seed, as a part of the brightest one's
constexpr double kThresholdHeight = 0.6;      // from the background (0) to the lumen (1)

double cross_median(const imaging::ImageVolume& image, const Voxel& v) {
  std::vector<std::int16_t> values{image(v[0], v[1], v[2])};
  for (int d = 0; d < 3; ++d) {
    for (const int s : {-1, 1}) {
      Voxel n = v;
      n[d] += s;
      if (inside(image.geometry.size, n)) values.push_back(image(n[0], n[1], n[2]));
    }
  }
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

using Histogram = std::vector<std::int64_t>;

/// Tissue darker than the lumen in balls about the seeds; a voxel in two balls counts twice.
Histogram tissue_about(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm,
                       double brightest) {
  Histogram histogram(static_cast<std::size_t>(std::max(1.0, std::ceil(brightest) - kDarkestTissueHu + 1)),
                      0);
  const auto& g = image.geometry;
  for (const Vec3& seed : seeds_mm) {
    const Voxel centre = nearest_voxel(g, seed);
    Voxel low{};
    Voxel high{};
    Voxel step{};
    for (int d = 0; d < 3; ++d) {
      const int reach = static_cast<int>(kNeighbourhoodMm / g.spacing[d]);
      low[d] = std::max(0, centre[d] - reach);
      high[d] = static_cast<std::int32_t>(std::min<std::int64_t>(g.size[d] - 1, centre[d] + reach));
      step[d] = std::max(1, static_cast<int>(0.8 / g.spacing[d]));  // 0.8 mm is dense enough for a histogram
    }
    for (int k = low[2]; k <= high[2]; k += step[2]) {
      for (int j = low[1]; j <= high[1]; j += step[1]) {
        for (int i = low[0]; i <= high[0]; i += step[0]) {
          const Vec3 away = Vec3(i - centre[0], j - centre[1], k - centre[2]).cwiseProduct(g.spacing);
          if (away.squaredNorm() > kNeighbourhoodMm * kNeighbourhoodMm) continue;
          const int bin = image(i, j, k) - kDarkestTissueHu;
          if (bin >= 0 && bin < static_cast<int>(histogram.size()))
            ++histogram[static_cast<std::size_t>(bin)];
        }
      }
    }
  }
  return histogram;
}

/// Otsu's split (1979): the last bin of the darker class.
std::size_t otsu(const Histogram& histogram, std::int64_t total) {
  double sum = 0.0;
  for (std::size_t b = 0; b < histogram.size(); ++b)
    sum += static_cast<double>(b) * static_cast<double>(histogram[b]);
  double dark_sum = 0.0;
  std::int64_t dark = 0;
  double best = -1.0;
  std::size_t split = 0;
  for (std::size_t b = 0; b + 1 < histogram.size(); ++b) {
    dark += histogram[b];
    dark_sum += static_cast<double>(b) * static_cast<double>(histogram[b]);
    if (dark == 0 || dark == total) continue;
    const double n0 = static_cast<double>(dark);
    const double n1 = static_cast<double>(total - dark);
    const double difference = dark_sum / n0 - (sum - dark_sum) / n1;
    const double between = n0 * n1 * difference * difference;
    if (between > best) {
      best = between;
      split = b;
    }
  }
  return split;
}

}  // namespace

double background_hu(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm, double lumen) {
  const Histogram histogram = tissue_about(image, seeds_mm, lumen);
  std::int64_t total = 0;
  for (const std::int64_t n : histogram) total += n;
  const double fallback = std::min(kTissueHu, lumen - 100.0);
  if (total < 64) return fallback;
  const std::size_t split = otsu(histogram, total);
  std::int64_t dark = 0;
  for (std::size_t b = 0; b <= split; ++b) dark += histogram[b];
  if (dark < 32) return fallback;
  std::int64_t seen = 0;
  for (std::size_t b = 0; b <= split; ++b) {
    seen += histogram[b];
    if (2 * seen >= dark) return static_cast<double>(b) + kDarkestTissueHu;
  }
  return fallback;
}

std::string text(const Vec3& point) {
  return "(" + fixed_text(point.x(), 1) + ", " + fixed_text(point.y(), 1) + ", " + fixed_text(point.z(), 1) +
         ")";
}

SeedIntensities seed_intensities(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm) {
  if (seeds_mm.empty())
    throw InvalidInput("segmentation: no seed is given; place one at each end of the vessel");
  SeedIntensities result;
  for (const Vec3& seed : seeds_mm) {
    if (!seed.allFinite() || !image.geometry.contains(seed)) {
      const Vec3 last(image.geometry.size[0] - 1.0, image.geometry.size[1] - 1.0,
                      image.geometry.size[2] - 1.0);
      throw InvalidInput("seed " + text(seed) + " mm lies outside the image, which spans " +
                         text(image.geometry.world(Vec3::Zero())) + " to " +
                         text(image.geometry.world(last)) + " mm (LPS): place it inside");
    }
    const double hu = cross_median(image, nearest_voxel(image.geometry, seed));
    if (hu < kNoVesselHu) {
      throw InvalidInput("seed " + text(seed) + " mm lies in air (" + fixed_text(hu, 0) +
                         " HU): place it in the contrast-filled lumen");
    }
    if (hu < result.darkest) {
      result.darkest = hu;
      result.darkest_at = seed;
    }
    if (hu > result.brightest) {
      result.brightest = hu;
      result.brightest_at = seed;
    }
  }
  return result;
}

/// Contrast varies along a vessel, by a factor of two at times. A seed that has hardly any beside another one
/// lies elsewhere, and a range from it would hold the tissue around.
void require_like_contrast(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm,
                           const SeedIntensities& at) {
  const double background = background_hu(image, seeds_mm, at.brightest);
  if (at.darkest - background >= kLeastContrast * (at.brightest - background)) return;
  throw InvalidInput("seed " + text(at.darkest_at) + " mm has " + fixed_text(at.darkest, 0) +
                     " HU, but seed " + text(at.brightest_at) + " mm " + fixed_text(at.brightest, 0) +
                     " HU, and the tissue around " + fixed_text(background, 0) +
                     " HU: the first lies outside of the lumen; move it, or give the lower bound of the "
                     "intensities if both are right");
}

ChosenRange choose_range(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm,
                         const std::optional<double>& lower, const std::optional<double>& upper) {
  const SeedIntensities at_seeds = seed_intensities(image, seeds_mm);
  ChosenRange result;
  result.lumen_hu = at_seeds.darkest;
  result.chosen = !lower || !upper;
  if (!lower) require_like_contrast(image, seeds_mm, at_seeds);
  if (result.chosen) {
    const double background = background_hu(image, seeds_mm, at_seeds.darkest);
    const double contrast = at_seeds.darkest - background;
    result.range.lower = background + kThresholdHeight * contrast;
    result.range.upper = at_seeds.brightest + contrast;
  }
  if (lower) result.range.lower = *lower;
  if (upper) result.range.upper = *upper;
  if (!(result.range.lower < result.range.upper)) {
    throw InvalidInput("intensity range " + fixed_text(result.range.lower, 0) + " to " +
                       fixed_text(result.range.upper, 0) +
                       " HU is empty: give a lower bound below the upper one");
  }
  return result;
}

Voxel voxel_in_range(const imaging::ImageVolume& image, const Vec3& seed_mm, const IntensityRange& range) {
  const auto& g = image.geometry;
  const Voxel centre = nearest_voxel(g, seed_mm);
  Voxel best = centre;
  double best_distance = 1e300;
  for (int k = -1; k <= 1; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const Voxel v{centre[0] + i, centre[1] + j, centre[2] + k};
        if (!inside(g.size, v)) continue;
        const double hu = image(v[0], v[1], v[2]);
        if (hu < range.lower || hu > range.upper) continue;
        double distance = (g.world(Vec3(v[0], v[1], v[2])) - seed_mm).norm();
        if (v == centre) distance = -1.0;
        if (distance < best_distance) {
          best_distance = distance;
          best = v;
        }
      }
    }
  }
  if (best_distance == 1e300) {
    throw InvalidInput("seed " + text(seed_mm) + " mm lies outside the intensity range: " +
                       fixed_text(image(centre[0], centre[1], centre[2]), 0) + " HU there, the range is " +
                       fixed_text(range.lower, 0) + " to " + fixed_text(range.upper, 0) +
                       " HU; move the seed into the lumen or widen the range");
  }
  return best;
}

}  // namespace detail

IntensityRange intensity_range_around(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm) {
  return detail::choose_range(image, seeds_mm, std::nullopt, std::nullopt).range;
}

}  // namespace ostia::segmentation
