#include "ostia/phantom/scan.h"

#include "simple_scene.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/phantom/stair_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Vec3;
using testing::ball_scene;
using testing::flat_scene;
using testing::FunctionScene;
using testing::quiet_scan;

double sum_of(const imaging::ImageVolume& image) {
  double sum = 0.0;
  for (const std::int16_t v : image.voxels) sum += v;
  return sum;
}

/// Mean and deviation of the whole image.
std::pair<double, double> moments(const imaging::ImageVolume& image) {
  const double n = static_cast<double>(image.voxels.size()), mean = sum_of(image) / n;
  double square = 0.0;
  for (const std::int16_t v : image.voxels) square += (v - mean) * (v - mean);
  return {mean, std::sqrt(square / n)};
}

TEST(Scan, PartialVolumesOfABallAddUpToItsVolume) {
  for (const double psf : {0.0, 0.6, 1.1}) {
    ScanOptions options = quiet_scan({48, 46, 40}, {0.35, 0.35, 0.45});
    options.psf_fwhm_mm = psf;
    options.psf_fwhm_z_mm = 1.2 * psf;
    const double radius = 5.123;
    const Scan scan = acquire(ball_scene({0.07, -0.11, 0.05}, radius), options);
    const double volume = sum_of(scan.image) / 1000.0 * options.grid.spacing.prod();
    const double truth = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
    EXPECT_NEAR(volume / truth, 1.0, 1e-3) << psf;
  }
}

TEST(Scan, AThinVesselMissedByTheCentresIsPaintedWhereTheSceneSaysThatItIsFine) {
  // A cylinder of radius 0.1 mm along y between the centres of voxels of 0.5 mm.
  const auto cylinder = [](bool fine) {
    return FunctionScene(
        [](const Vec3& p) {
          return std::hypot(p.x() - 0.01, p.z() + 0.02) < 0.1 ? Material{Label::coronary_lumen, 1000.0f}
                                                              : Material{Label::fat, 0.0f};
        },
        fine);
  };
  ScanOptions options = quiet_scan({16, 16, 16}, {0.5, 0.5, 0.5});
  options.supersampling = 8;
  EXPECT_EQ(sum_of(acquire(cylinder(false), options).image), 0.0);
  const double area = sum_of(acquire(cylinder(true), options).image) / 1000.0 * 0.25 / 16.0;
  EXPECT_NEAR(area, std::numbers::pi * 0.01, 0.15 * std::numbers::pi * 0.01);
}

TEST(Scan, LabelsAreThoseAtTheVoxelsCentres) {
  ScanOptions options = quiet_scan({30, 31, 29}, {0.4, 0.4, 0.5});
  options.grid.direction = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 centre(-2.0, 3.0, -1.0);
  const Scan scan = acquire(ball_scene(centre, 3.0), options);
  std::size_t inside = 0;
  for (std::int64_t k = 0; k < 29; ++k) {
    for (std::int64_t j = 0; j < 31; ++j) {
      for (std::int64_t i = 0; i < 30; ++i) {
        const Vec3 p =
            options.grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const bool in = (p - centre).squaredNorm() < 9.0;
        inside += in;
        ASSERT_EQ(scan.labels(i, j, k), static_cast<int>(in ? Label::coronary_lumen : Label::fat));
      }
    }
  }
  EXPECT_GT(inside, 500u);
}

TEST(Scan, APlaneIsShownAsTheIntegralOfItsGaussian) {
  // Across a plane at x = a (or z = a) the image is the normal distribution function of the asked width.
  for (const int axis : {0, 2}) {
    ScanOptions options = quiet_scan({24, 24, 24}, {0.35, 0.35, 0.45});
    options.supersampling = 8;
    const double a = 0.13;
    const Scan scan =
        acquire(FunctionScene([=](const Vec3& p) {
                  return p[axis] > a ? Material{Label::aorta, 1000.0f} : Material{Label::fat, 0.0f};
                }),
                options);
    const double fwhm = axis == 2 ? options.psf_fwhm_z_mm : options.psf_fwhm_mm;
    const double sigma = fwhm / std::sqrt(8.0 * std::numbers::ln2);
    for (std::int64_t n = 0; n < 24; ++n) {
      const double at = options.grid.origin[axis] + options.grid.spacing[axis] * static_cast<double>(n);
      // The pieces put the plane at the nearest of their borders: at most half a piece away.
      const double truth = 500.0 * std::erfc((a - at) / (sigma * std::numbers::sqrt2));
      const double slack = 1000.0 / (sigma * 2.507) * options.grid.spacing[axis] / 16.0 + 3.0;
      EXPECT_NEAR(axis == 2 ? scan.image(12, 12, n) : scan.image(n, 12, 12), truth, slack)
          << axis << " " << n;
    }
  }
}

TEST(Scan, TheBorderShowsWhatLiesBeyondIt) {
  // The same place in a larger and in a smaller field of view.
  const FunctionScene scene = ball_scene({0, 0, 0}, 3.0);
  ScanOptions large = quiet_scan({40, 40, 40}, {0.4, 0.4, 0.4}), small = large;
  small.grid.size = {12, 11, 10};
  small.grid.origin = large.grid.world({9, 10, 11});
  const Scan a = acquire(scene, large), b = acquire(scene, small);
  for (std::int64_t k = 0; k < 10; ++k)
    for (std::int64_t j = 0; j < 11; ++j)
      for (std::int64_t i = 0; i < 12; ++i) ASSERT_NEAR(a.image(i + 9, j + 10, k + 11), b.image(i, j, k), 1);
}

TEST(Scan, NoiseHasTheDeviationAskedForWhateverItsSpectrum) {
  for (const double peak : {0.0, 0.15, 0.25, 0.4}) {
    for (const double along_z : {0.0, 0.9}) {
      ScanOptions options = quiet_scan({160, 150, 40}, {0.4, 0.4, 0.5});
      options.noise_hu = 25.0;
      options.noise_peak_per_mm = peak;
      options.noise_fwhm_z_mm = along_z;
      const auto [mean, deviation] = moments(acquire(flat_scene(100.0f), options).image);
      EXPECT_NEAR(mean, 100.0, 0.6) << peak << " " << along_z;
      EXPECT_NEAR(deviation, 25.0, 0.25) << peak << " " << along_z;
    }
  }
}

TEST(Scan, IsTheSameForAnyThreadsAndOtherForAnotherSeed) {
  ScanOptions options = quiet_scan({50, 40, 37}, {0.4, 0.4, 0.5});
  options.noise_hu = 20.0;
  options.stair_step_mm = 1.0;
  options.stair_block_mm = 5.0;
  options.motion_mm = 1.0;
  options.beam_hardening = 1.0;
  const FunctionScene scene = ball_scene({1, 0, 0}, 5.0);
  core::set_max_threads(1);
  const Scan one = acquire(scene, options);
  core::set_max_threads(3);
  const Scan three = acquire(scene, options);
  core::set_max_threads(0);
  EXPECT_EQ(one.image.voxels, three.image.voxels);
  EXPECT_EQ(one.labels.voxels, three.labels.voxels);
  options.seed = 2;
  EXPECT_NE(acquire(scene, options).image.voxels, one.image.voxels);
}

/// Centre of mass of a slice.
Vec3 centre_of_slice(const imaging::ImageVolume& image, std::int64_t k) {
  Vec3 sum = Vec3::Zero();
  double mass = 0.0;
  for (std::int64_t j = 0; j < image.geometry.size[1]; ++j) {
    for (std::int64_t i = 0; i < image.geometry.size[0]; ++i) {
      const double v = image(i, j, k);
      sum += v * image.geometry.world(
                     Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
      mass += v;
    }
  }
  return sum / mass;
}

FunctionScene cylinder_scene(double radius_mm) {
  return FunctionScene([=](const Vec3& p) {
    return p.head<2>().norm() < radius_mm ? Material{Label::aorta, 1000.0f} : Material{Label::fat, 0.0f};
  });
}

TEST(Scan, StairStepsMoveBlocksAsAsked) {
  ScanOptions options = quiet_scan({60, 60, 40}, {0.4, 0.4, 0.5});
  options.stair_step_mm = 2.0;
  options.stair_block_mm = 5.0;  // ten slices
  const Scan scan = acquire(cylinder_scene(5.0), options);
  for (const std::int64_t k : {5, 15, 25, 35}) {
    const Vec3 at = centre_of_slice(scan.image, k);
    EXPECT_NEAR((at - stair_shift(options, k)).head<2>().norm(), 0.0, 0.02) << k;
    const Vec3 axis(0.0, 0.0, at.z());
    EXPECT_NEAR((at - shown_at(options, axis)).norm(), 0.0, 0.02) << k;
  }
  EXPECT_NEAR((stair_shift(options, 9) - stair_shift(options, 10)).norm(), 2.0, 1e-12);
  EXPECT_EQ((stair_shift(options, 0) - stair_shift(options, 9)).norm(), 0.0);
  EXPECT_NEAR((centre_of_slice(scan.image, 5) - centre_of_slice(scan.image, 15)).head<2>().norm(), 2.0, 0.02);
}

TEST(Scan, WhatLiesOutsideTheMovingBallStaysWhereItIs) {
  ScanOptions options = quiet_scan({60, 60, 20}, {0.4, 0.4, 0.5});
  const Scan still = acquire(cylinder_scene(5.0), options);
  options.stair_step_mm = 2.0;
  options.stair_block_mm = 3.0;
  options.motion_mm = 2.0;
  options.moving_centre = {0, 0, 100.0};
  options.moving_radius_mm = 50.0;
  EXPECT_EQ(acquire(cylinder_scene(5.0), options).image.voxels, still.image.voxels);
  EXPECT_EQ(shown_at(options, {1.0, 2.0, 3.0}), Vec3(1.0, 2.0, 3.0));
}

TEST(Scan, MotionBlursAlongOneDirectionByTheVarianceOfItsPath) {
  // A small ball: its variance in the plane grows by L^2 / 12 in all.
  ScanOptions options = quiet_scan({60, 60, 12}, {0.4, 0.4, 0.4});
  const auto spread = [](const imaging::ImageVolume& image) {
    const Vec3 centre = centre_of_slice(image, 6);
    double sum = 0.0, mass = 0.0;
    for (std::int64_t j = 0; j < 60; ++j) {
      for (std::int64_t i = 0; i < 60; ++i) {
        const Vec3 p = image.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), 6.0));
        sum += image(i, j, 6) * (p - centre).head<2>().squaredNorm();
        mass += image(i, j, 6);
      }
    }
    return sum / mass;
  };
  const double before = spread(acquire(cylinder_scene(1.5), options).image);
  options.motion_mm = 4.0;
  const double after = spread(acquire(cylinder_scene(1.5), options).image);
  // Two interpolated axes add at most a quarter of a voxel's square each.
  EXPECT_NEAR(after - before, 16.0 / 12.0, 0.08);
}

TEST(Scan, BeamHardeningDarkensBetweenDenseObjectsAndIsProportional) {
  const FunctionScene scene([](const Vec3& p) {
    const bool dense = (p.head<2>() - geometry::Vec2(-25, 0)).norm() < 8.0 ||
                       (p.head<2>() - geometry::Vec2(25, 0)).norm() < 8.0;
    return dense ? Material{Label::bone, 1000.0f} : Material{Label::muscle, 50.0f};
  });
  ScanOptions options = quiet_scan({100, 100, 1}, {1.0, 1.0, 1.0});
  options.psf_fwhm_mm = options.psf_fwhm_z_mm = 1.0;
  const Scan none = acquire(scene, options);
  options.beam_hardening = 1.0;
  const Scan one = acquire(scene, options);
  options.beam_hardening = 2.0;
  const Scan two = acquire(scene, options);
  const int between = one.image(50, 50, 0) - none.image(50, 50, 0);
  EXPECT_LT(between, -10);
  EXPECT_GT(between, -150);
  EXPECT_NEAR(two.image(50, 50, 0) - none.image(50, 50, 0), 2 * between, 2);
  // Far from the line between them there is less of it.
  EXPECT_LT(std::abs(one.image(50, 95, 0) - none.image(50, 95, 0)), std::abs(between) / 2);
}

TEST(Scan, ClampsToTheRangeOfAScanner) {
  const Scan low = acquire(flat_scene(-5000.0f), quiet_scan({8, 8, 8}, {0.5, 0.5, 0.5}));
  const Scan high = acquire(flat_scene(9000.0f), quiet_scan({8, 8, 8}, {0.5, 0.5, 0.5}));
  EXPECT_EQ(low.image(4, 4, 4), -1024);
  EXPECT_EQ(high.image(4, 4, 4), 3071);
}

TEST(Scan, ASingleVoxelIsAnImage) {
  const Scan scan = acquire(flat_scene(77.0f), quiet_scan({1, 1, 1}, {0.5, 0.5, 0.5}));
  ASSERT_EQ(scan.image.voxels.size(), 1u);
  EXPECT_EQ(scan.image.voxels[0], 77);
}

TEST(Scan, RefusesBadOptionsByName) {
  const auto refused = [](const char* word, const std::function<void(ScanOptions&)>& spoil) {
    ScanOptions options = quiet_scan({8, 8, 8}, {0.5, 0.5, 0.5});
    spoil(options);
    try {
      validate(options);
      ADD_FAILURE() << word << " was accepted";
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused("voxels along axis 1", [](ScanOptions& o) { o.grid.size[1] = 0; });
  refused("spacing", [](ScanOptions& o) { o.grid.spacing.x() = 0.0; });
  refused("orthonormal", [](ScanOptions& o) { o.grid.direction(0, 0) = 2.0; });
  refused("supersampling", [](ScanOptions& o) { o.supersampling = 9; });
  refused("psf_fwhm_mm", [](ScanOptions& o) { o.psf_fwhm_mm = std::nan(""); });
  refused("half a voxel", [](ScanOptions& o) { o.psf_fwhm_z_mm = 0.2; });
  refused("noise_hu", [](ScanOptions& o) { o.noise_hu = 501.0; });
  refused("noise_peak_per_mm", [](ScanOptions& o) {
    o.noise_hu = 20.0;
    o.noise_peak_per_mm = 0.8;
  });
  refused("noise_fwhm_z_mm", [](ScanOptions& o) { o.noise_fwhm_z_mm = -1.0; });
  refused("stair_block_mm", [](ScanOptions& o) { o.stair_block_mm = 0.0; });
  refused("motion_mm", [](ScanOptions& o) { o.motion_mm = 11.0; });
  refused("beam_hardening", [](ScanOptions& o) { o.beam_hardening = -1.0; });
  refused("moving_centre", [](ScanOptions& o) { o.moving_centre.x() = INFINITY; });
}

TEST(Scan, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(acquire(flat_scene(0.0f), quiet_scan({8, 8, 8}, {0.5, 0.5, 0.5}), task), Cancelled);
  // From within, while it works.
  const core::TaskContext later;
  const FunctionScene cancelling([&](const Vec3& p) {
    if (p.z() > 0.0) later.cancel();
    return Material{Label::fat, 0.0f};
  });
  EXPECT_THROW(acquire(cancelling, quiet_scan({16, 16, 64}, {0.5, 0.5, 0.5}), later), Cancelled);
}

TEST(Scan, ReportsProgressToTheEnd) {
  const core::TaskContext task;
  acquire(flat_scene(0.0f), quiet_scan({8, 8, 30}, {0.5, 0.5, 0.5}), task);
  EXPECT_NEAR(task.progress(), 1.0, 1e-9);
}

}  // namespace
}  // namespace ostia::phantom
