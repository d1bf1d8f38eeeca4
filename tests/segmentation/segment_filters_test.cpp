// What `segment_vessels` does with its filters, on tubes whose walls are known.

#include "tube_images.h"

#include "ostia/core/error.h"
#include "ostia/segmentation/segment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::segmentation {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using testing::Tube;

constexpr double kVoxel = 0.4;
const std::array<std::int64_t, 3> kSegmentFiltersSize{60, 60, 60};
const Vec3 kSegmentFiltersSpacing = Vec3::Constant(kVoxel);
constexpr double kNoise = 25.0;

Tube oblique(double radius_mm) {
  const Vec3 a(10.6, 11.2, 0.0);
  const Vec3 b(12.3, 13.1, 23.6);
  return {a + 0.15 * (b - a), a + 0.85 * (b - a), radius_mm};
}

SegmentationResult segmented(const imaging::ImageVolume& image, const Tube& tube,
                             const SegmentOptions& options) {
  return segment_vessels(image, {{tube.from, std::nullopt, tube.to}}, options);
}

testing::WallError wall(const imaging::ImageVolume& image, const Tube& tube, const SegmentOptions& options) {
  const SegmentationResult result = segmented(image, tube, options);
  return testing::wall_error(surface_of(result.level_set, {tube.from, tube.to}).points, tube, 2.5);
}

double spread(const testing::WallError& e) {
  return std::sqrt(std::max(0.0, e.rms * e.rms - e.mean * e.mean));
}

TEST(SegmentFilters, EachCurvatureFindsTheWallAndMinimalAllowsMoreWeight) {
  const Tube tube = oblique(1.5);
  const auto image = testing::tube_image({tube}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel);
  SegmentOptions options;
  options.level_set.curvature_term = CurvatureTerm::minimal;
  EXPECT_LT(std::abs(wall(image, tube, options).mean), 0.05 * kVoxel);
  options.level_set.curvature = 2.0;
  const double minimal = wall(image, tube, options).mean;
  options.level_set.curvature_term = CurvatureTerm::mean;
  const double mean = wall(image, tube, options).mean;
  EXPECT_LT(std::abs(minimal), 0.02 * tube.radius + 0.03 * kVoxel);
  EXPECT_LT(mean, -0.1 * tube.radius);
}

TEST(SegmentFilters, DenoisingSmoothsTheWallAndLeavesItInPlace) {
  const Tube tube = oblique(1.6);
  const auto image =
      testing::tube_image({tube}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel, kNoise);
  const testing::WallError before = wall(image, tube, {});
  for (const imaging::Diffusion method :
       {imaging::Diffusion::flux, imaging::Diffusion::gradient, imaging::Diffusion::curvature}) {
    SegmentOptions options;
    options.denoise.emplace();
    options.denoise->method = method;
    const testing::WallError after = wall(image, tube, options);
    EXPECT_LT(std::abs(after.mean), 0.1 * kVoxel);
    EXPECT_LT(spread(after), (method == imaging::Diffusion::flux ? 0.6 : 0.8) * spread(before));
  }
}

TEST(SegmentFilters, GaussianDerivativesRestOnTheirRidge) {
  const Tube tube = oblique(2.4);
  SegmentOptions options;
  options.feature = WallFeature::gaussian;
  options.level_set.curvature = 0.0;
  // The ridge of a wall blurred by s lies s^2 / 2 times its curvature inside of it (Verbeek and van Vliet
  // 1994).
  const auto clear = testing::tube_image({tube}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel);
  for (const double sigma : {0.4, 0.7}) {
    options.gaussian_sigma_mm = sigma;
    const double blur = std::hypot(0.8 * kVoxel, sigma);
    EXPECT_NEAR(wall(clear, tube, options).mean, -0.5 * blur * blur / tube.radius, 0.2 * kVoxel) << sigma;
  }
  // Noise of a twelfth of the contrast troubles it less than differences between voxels.
  const auto noisy =
      testing::tube_image({tube}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel, kNoise);
  const double smooth = spread(wall(noisy, tube, options));
  options.feature = WallFeature::centred;
  EXPECT_LT(smooth, 0.7 * spread(wall(noisy, tube, options)));
}

/// A tube of 350 HU with a hole in its wall: a pouch of fainter blood beside it, joined without an edge to
/// speak of.
imaging::ImageVolume leaking(const Tube& tube) {
  auto image = testing::tube_image({tube}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel, 10.0);
  const Vec3 middle = 0.5 * (tube.from + tube.to);
  const Vec3 axis = (tube.to - tube.from).normalized();
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n) {
    const Vec3 p = image.geometry.world(
        Vec3(static_cast<double>(n % 60), static_cast<double>(n / 60 % 60), static_cast<double>(n / 3600)));
    const Vec3 away = p - middle;
    const double out = away.x();
    if (out < 0.0 || std::abs(away.dot(axis)) > 2.0 || std::abs(away.y()) > 2.0) continue;
    // From the lumen's brightness at the axis down by 30 HU a mm: nowhere steep.
    const auto fading = static_cast<std::int16_t>(350.0 - 30.0 * std::max(0.0, out - 1.2));
    image.voxels[static_cast<std::size_t>(n)] = std::max(image.voxels[static_cast<std::size_t>(n)], fading);
  }
  return image;
}

/// Voxels inside that lie more than `beyond` outside of the tube's wall.
std::int64_t leaked(const SegmentationResult& result, const Tube& tube, double beyond) {
  std::int64_t count = 0;
  const auto& g = result.level_set.geometry;
  for (std::int64_t k = 0; k < g.size[2]; ++k)
    for (std::int64_t j = 0; j < g.size[1]; ++j)
      for (std::int64_t i = 0; i < g.size[0]; ++i) {
        const Vec3 p = g.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if (result.level_set(i, j, k) < 0.0F && distance_to_axis(tube, p) > tube.radius + beyond) ++count;
      }
  return count;
}

TEST(SegmentFilters, TheBalloonStopsInALeakWherePlainInflationRunsOut) {
  const Tube tube = oblique(1.6);
  const auto image = leaking(tube);
  SegmentOptions options;
  options.fronts.lower_hu = 320.0;  // the initial region keeps out of the pouch
  options.level_set.inflation = 0.5;
  options.fronts.margin_voxels = 12;
  const std::int64_t plain = leaked(segmented(image, tube, options), tube, 1.2);
  options.balloon.emplace();
  const SegmentationResult held = segmented(image, tube, options);
  EXPECT_GT(plain, 200);
  EXPECT_LT(leaked(held, tube, 1.2), plain / 10);
  EXPECT_NEAR(held.balloon_mean_hu, 345.0, 15.0);
  EXPECT_GE(held.balloon_sigma_hu, 10.0);
  EXPECT_LT(held.balloon_sigma_hu, 40.0);
  // The wall elsewhere is where it was.
  const Tube whole = oblique(1.6);
  const auto closed =
      testing::tube_image({whole}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel, 10.0);
  EXPECT_LT(std::abs(wall(closed, whole, options).mean), 0.25 * kVoxel);
}

TEST(SegmentFilters, TheBalloonFillsAVesselFromItsCore) {
  // Fronts that run in the brightest part alone begin with a core; without inflation the wall is out of
  // reach.
  const Tube tube = oblique(3.2);
  const auto image =
      testing::tube_image({tube}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel, 15.0);
  SegmentOptions options;
  options.fronts.lower_hu = 343.0;
  options.level_set.advection = 0.5;
  options.level_set.inflation = 0.5;
  options.balloon.emplace();
  options.balloon->mean_hu = 350.0;
  options.balloon->sigma_hu = 40.0;
  EXPECT_LT(std::abs(wall(image, tube, options).mean), 0.25 * kVoxel);
}

TEST(SegmentFilters, CalciumTakenOutLeavesTheLumenBesideIt) {
  const Tube tube = oblique(2.0);
  auto image = testing::tube_image({tube}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel);
  const Vec3 spot = 0.5 * (tube.from + tube.to) + Vec3(2.0, 0.0, 0.0);
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n) {
    const Vec3 p = image.geometry.world(
        Vec3(static_cast<double>(n % 60), static_cast<double>(n / 60 % 60), static_cast<double>(n / 3600)));
    const double part = 0.5 * std::erfc(((p - spot).norm() - 1.0) / (std::sqrt(2.0) * 0.32));
    auto& hu = image.voxels[static_cast<std::size_t>(n)];
    hu = static_cast<std::int16_t>(std::lround(hu + (1100.0 - hu) * part));
  }
  SegmentOptions options;
  options.bright_is_lumen = true;  // else the surface stops before it by itself
  const auto inside_spot = [&](const SegmentationResult& r) {
    const auto index = r.level_set.geometry.index(spot);
    return r.level_set(std::llround(index[0]), std::llround(index[1]), std::llround(index[2])) < 0.0F;
  };
  EXPECT_TRUE(inside_spot(segmented(image, tube, options)));
  options.remove.calcium = true;
  EXPECT_FALSE(inside_spot(segmented(image, tube, options)));
}

TEST(SegmentFilters, RefusesBadOptionsByName) {
  const Tube tube = oblique(1.6);
  const auto image = testing::tube_image({tube}, kSegmentFiltersSize, kSegmentFiltersSpacing, 0.8 * kVoxel);
  const auto refused = [&](const SegmentOptions& options, const char* name) {
    EXPECT_THAT([&] { segmented(image, tube, options); }, ThrowsMessage<InvalidInput>(HasSubstr(name)));
  };
  SegmentOptions bad;
  bad.gaussian_sigma_mm = -1.0;
  refused(bad, "gaussian_sigma_mm");
  bad = {};
  bad.balloon.emplace();
  refused(bad, "inflation");
  bad.level_set.inflation = 0.5;
  bad.balloon->tau = 1.0;
  refused(bad, "tau");
  bad.balloon->tau = 0.2;
  bad.balloon->sigma_hu = 0.0;
  refused(bad, "sigma_hu");
  bad = {};
  bad.denoise.emplace();
  bad.denoise->iterations = -3;
  refused(bad, "iterations");
  bad = {};
  bad.remove.shell_hu = 10.0;
  refused(bad, "shell_hu");
}

}  // namespace
}  // namespace ostia::segmentation
