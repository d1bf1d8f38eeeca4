// What is seen of a wall on images of tubes whose edge, noise and calcium are known.

#include "ostia/analysis/wall_evidence.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/analytic_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace ostia::analysis {
namespace {

constexpr double radius_mm = 1.5, length_mm = 30.0;

/// CT number at a distance from the axis, an angle and an abscissa.
using Scene = std::function<double(double rho, double theta, double s_mm)>;

imaging::ImageVolume image_of(const Scene& scene, double noise_hu, double spacing_mm = 0.4) {
  imaging::ImageVolume image;
  const auto side = static_cast<std::int64_t>(12.0 / spacing_mm);
  image.geometry.size = {side, side, static_cast<std::int64_t>((length_mm + 4.0) / spacing_mm)};
  image.geometry.spacing = geometry::Vec3::Constant(spacing_mm);
  const double corner = -0.5 * spacing_mm * static_cast<double>(side - 1);
  image.geometry.origin = {corner, corner, -2.0};
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, noise_hu);
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < side; ++j)
      for (std::int64_t i = 0; i < side; ++i) {
        const geometry::Vec3 p = image.geometry.world(
            geometry::Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const double hu = scene(std::hypot(p.x(), p.y()), std::atan2(p.y(), p.x()), p.z());
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(hu + noise(generator))));
      }
  return image;
}

double blurred_step(double x_mm, double sigma_mm) {
  return 0.5 * std::erfc(x_mm / (sigma_mm * std::numbers::sqrt2));
}
Scene tube(double lumen_hu, double outside_hu, double sigma_mm = 0.4) {
  return [=](double rho, double, double) {
    return outside_hu + (lumen_hu - outside_hu) * blurred_step(rho - radius_mm, sigma_mm);
  };
}

std::vector<WallEvidence> seen(const imaging::ImageVolume& image, double noise_hu,
                               double modelled_mm = radius_mm) {
  const geometry::AxisCurve axis(geometry::straight_tube(length_mm, radius_mm, 0.5).tubes.front().axis);
  WallEvidenceOptions options;
  options.noise_hu = noise_hu;
  return wall_evidence(
      image, axis, [=](double, double) { return modelled_mm; }, 2.0, 28.0, options);
}

TEST(WallEvidence, OfAClearEdge) {
  const auto evidence = seen(image_of(tube(400.0, 0.0), 20.0), 20.0);
  ASSERT_EQ(evidence.size(), 53U);
  EXPECT_DOUBLE_EQ(evidence.front().s_mm, 2.0);
  EXPECT_DOUBLE_EQ(evidence.back().s_mm, 28.0);
  for (const WallEvidence& one : evidence) {
    EXPECT_TRUE(one.in_image);
    EXPECT_NEAR(one.calibre_mm, 2.0 * radius_mm, 1e-9);
    EXPECT_NEAR(one.lumen_hu, 395.0, 30.0);
    EXPECT_NEAR(one.contrast_hu, 340.0, 50.0);  // the edge's foot is not black yet
    EXPECT_GT(one.clear_share, 0.95);
    EXPECT_LT(one.calcium_share, 0.05);
    EXPECT_NEAR(one.blur_mm, 0.42, 0.12);  // the blur and the voxels' own
  }
}

TEST(WallEvidence, ABlurIsMeasured) {
  const auto blur = [](double sigma_mm) {
    return seen(image_of(tube(400.0, 0.0, sigma_mm), 10.0), 10.0)[26].blur_mm;
  };
  EXPECT_LT(blur(0.3), 0.5);
  EXPECT_GT(blur(0.8), 0.65);
  EXPECT_LT(blur(0.3), blur(0.55));
  EXPECT_LT(blur(0.55), blur(0.8));
}

TEST(WallEvidence, WhereThereIsNoEdgeNoneIsSeen) {
  // A wall that is modelled within a chamber.
  for (const WallEvidence& one : seen(image_of([](double, double, double) { return 400.0; }, 20.0), 20.0)) {
    EXPECT_LT(one.clear_share, 0.15);
    EXPECT_LT(one.contrast_hu, 30.0);
    EXPECT_EQ(one.calcium_share, 0.0);
  }
}

TEST(WallEvidence, HalfAnEdgeIsHalfClear) {
  // A vein runs along the vessel.
  const Scene scene = [](double rho, double theta, double s) {
    return std::abs(theta) < 0.5 * std::numbers::pi ? 400.0 : tube(400.0, 0.0)(rho, theta, s);
  };
  for (const WallEvidence& one : seen(image_of(scene, 20.0), 20.0)) EXPECT_NEAR(one.clear_share, 0.5, 0.15);
}

TEST(WallEvidence, AnEdgeElsewhereThanTheWallIsNone) {
  for (const WallEvidence& one : seen(image_of(tube(400.0, 0.0), 20.0), 20.0, 0.4))
    EXPECT_LT(one.clear_share, 0.3);
}

TEST(WallEvidence, CalciumIsSeenAndSaysNothingOfTheEdge) {
  const Scene scene = [](double rho, double theta, double s) {
    const double shell = blurred_step(std::abs(rho - radius_mm - 0.6) - 0.4, 0.3);
    return tube(400.0, 0.0)(rho, theta, s) + (theta > 0.0 ? 900.0 * shell : 0.0);
  };
  for (const WallEvidence& one : seen(image_of(scene, 20.0), 20.0)) {
    EXPECT_NEAR(one.calcium_share, 0.5, 0.15);
    EXPECT_GT(one.clear_share, 0.8);
  }
}

TEST(WallEvidence, NoiseHidesAFaintEdge) {
  const auto mean_clear = [](double lumen_hu, double noise_hu) {
    double sum = 0.0;
    const auto evidence = seen(image_of(tube(lumen_hu, 50.0), noise_hu), noise_hu);
    for (const WallEvidence& one : evidence) sum += one.clear_share;
    return sum / static_cast<double>(evidence.size());
  };
  EXPECT_GT(mean_clear(400.0, 20.0), 0.95);
  EXPECT_LT(mean_clear(150.0, 90.0), 0.5);
}

TEST(WallEvidence, BeyondTheImageNothingIsKnown) {
  imaging::ImageVolume image = image_of(tube(400.0, 0.0), 10.0);
  image.geometry.origin.z() = 10.0;
  for (const WallEvidence& one : seen(image, 10.0)) {
    EXPECT_EQ(one.in_image, one.s_mm >= 9.8) << one.s_mm;
    if (!one.in_image) {
      EXPECT_EQ(one.contrast_hu, 0.0);
      EXPECT_EQ(one.clear_share, 0.0);
    }
  }
}

TEST(WallEvidence, AShutLumenHasNoEdge) {
  for (const WallEvidence& one : seen(image_of(tube(400.0, 0.0), 10.0), 10.0, 0.05)) {
    EXPECT_NEAR(one.calibre_mm, 0.1, 1e-9);
    EXPECT_EQ(one.contrast_hu, 0.0);
    EXPECT_EQ(one.clear_share, 0.0);
    EXPECT_EQ(one.blur_mm, 0.0);
  }
}

TEST(WallEvidence, IsTheSameForAnyNumberOfThreads) {
  const imaging::ImageVolume image = image_of(tube(400.0, 0.0), 20.0);
  const int before = core::max_threads();
  core::set_max_threads(1);
  const auto one = seen(image, 20.0);
  core::set_max_threads(4);
  const auto four = seen(image, 20.0);
  core::set_max_threads(before);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].clear_share, four[i].clear_share);
    EXPECT_EQ(one[i].blur_mm, four[i].blur_mm);
    EXPECT_EQ(one[i].contrast_hu, four[i].contrast_hu);
  }
}

TEST(WallEvidence, RefusesWhatItCannotUseAndStopsWhenTold) {
  const imaging::ImageVolume image = image_of(tube(400.0, 0.0), 0.0, 1.0);
  const geometry::AxisCurve axis(geometry::straight_tube(length_mm, radius_mm, 0.5).tubes.front().axis);
  const auto wall = [](double, double) { return radius_mm; };
  EXPECT_THROW(wall_evidence(image, axis, wall, 5.0, 5.0), InvalidInput);
  EXPECT_THROW(wall_evidence(image, axis, wall, 5.0, 31.0), InvalidInput);
  EXPECT_THROW(wall_evidence(image, axis, wall, 5.0, 9.0, {0.01, 32, 20.0}), InvalidInput);
  EXPECT_THROW(wall_evidence(image, axis, wall, 5.0, 9.0, {0.5, 30, 20.0}), InvalidInput);
  EXPECT_THROW(wall_evidence(image, axis, wall, 5.0, 9.0, {0.5, 32, -1.0}), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(wall_evidence(image, axis, wall, 5.0, 9.0, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::analysis
