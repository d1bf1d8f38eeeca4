// Noise and blur measured back in the finished image must be what was asked for, within 5 %.

#include "simple_scene.h"

#include "ostia/evaluation/image_quality.h"
#include "ostia/phantom/scan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::phantom {
namespace {

using evaluation::EdgeDirection;
using geometry::Vec3;
using testing::flat_scene;
using testing::FunctionScene;
using testing::quiet_scan;

struct Asked {
  Vec3 spacing;
  double in_plane, along_z;
};

TEST(ScanQuality, TheEdgesOfABallHaveTheWidthAskedFor) {
  const double radius = 9.3;
  const Vec3 centre(0.12, -0.07, 0.21);
  for (const Asked& asked : {Asked{{0.35, 0.35, 0.45}, 0.6, 0.7}, Asked{{0.5, 0.5, 0.6}, 0.6, 0.7},
                             Asked{{0.7, 0.7, 0.9}, 0.8, 1.0}, Asked{{0.35, 0.35, 0.45}, 1.1, 0.5}}) {
    std::array<std::int64_t, 3> size{};
    for (std::size_t a = 0; a < 3; ++a)
      size[a] = static_cast<std::int64_t>(26.0 / asked.spacing[static_cast<int>(a)]);
    ScanOptions options = quiet_scan(size, asked.spacing);
    options.psf_fwhm_mm = asked.in_plane;
    options.psf_fwhm_z_mm = asked.along_z;
    const Scan scan = acquire(testing::ball_scene(centre, radius), options);
    const auto distance = [&](const Vec3& p) { return radius - (p - centre).norm(); };
    evaluation::EdgeOptions edges;
    for (const bool in_plane : {true, false}) {
      edges.direction = in_plane ? EdgeDirection::in_plane : EdgeDirection::along_k;
      const evaluation::EdgeWidth width = evaluation::edge_width(scan.image, distance, edges);
      const double expected = in_plane ? asked.in_plane : asked.along_z;
      EXPECT_NEAR(width.fwhm_mm, expected, 0.05 * expected) << asked.spacing.transpose() << " " << in_plane;
      EXPECT_NEAR(width.shift_mm, 0.0, 0.04);
      EXPECT_NEAR(width.high_hu - width.low_hu, 1000.0, 10.0);
    }
  }
}

TEST(ScanQuality, TheLineSpreadOfSlantedPlanesHasTheWidthAskedFor) {
  // Planes turned by 7 degrees against the grid, so that the voxels oversample the profile; no model of it.
  const Vec3 across = Vec3(std::cos(0.12), std::sin(0.12), 0.0), along = Vec3(0.1, 0.07, 1.0).normalized();
  for (const Asked& asked : {Asked{{0.35, 0.35, 0.45}, 0.6, 0.7}, Asked{{0.7, 0.7, 0.9}, 0.8, 1.0}}) {
    for (const Vec3& normal : {across, along}) {
      ScanOptions options = quiet_scan({40, 40, 36}, asked.spacing);
      options.psf_fwhm_mm = asked.in_plane;
      options.psf_fwhm_z_mm = asked.along_z;
      const auto distance = [&](const Vec3& p) { return normal.dot(p) - 0.1; };
      const Scan scan =
          acquire(FunctionScene([&](const Vec3& p) {
                    return distance(p) > 0.0 ? Material{Label::aorta, 1000.0f} : Material{Label::fat, 0.0f};
                  }),
                  options);
      const double expected = normal == across ? asked.in_plane : asked.along_z;
      const auto width = evaluation::edge_width(scan.image, distance);
      EXPECT_NEAR(width.line_spread_fwhm_mm, expected, 0.05 * expected) << normal.transpose();
      EXPECT_NEAR(width.fwhm_mm, expected, 0.05 * expected) << normal.transpose();
    }
  }
}

TEST(ScanQuality, TheVoxelsOwnBoxIsLeftWhereNoBlurIsAskedFor) {
  ScanOptions options = quiet_scan({60, 60, 20}, {0.5, 0.5, 0.5});
  options.psf_fwhm_mm = options.psf_fwhm_z_mm = 0.0;
  options.supersampling = 8;
  // A plane turned by 7 degrees in the slice: its profile is the box's integral.
  const Vec3 normal(std::cos(0.12), std::sin(0.12), 0.0);
  const auto distance = [&](const Vec3& p) { return normal.dot(p); };
  const Scan scan =
      acquire(FunctionScene([&](const Vec3& p) {
                return distance(p) > 0.0 ? Material{Label::aorta, 1000.0f} : Material{Label::fat, 0.0f};
              }),
              options);
  EXPECT_NEAR(evaluation::edge_width(scan.image, distance).line_spread_fwhm_mm, 0.5, 0.04);
}

TEST(ScanQuality, NoiseHasTheDeviationAndThePeakAskedFor) {
  for (const double spacing : {0.35, 0.7}) {
    for (const double peak : {0.2, 0.22, 0.25}) {
      ScanOptions options = quiet_scan({192, 192, 24}, {spacing, spacing, 0.5});
      options.noise_hu = 30.0;
      options.noise_peak_per_mm = peak;
      const Scan scan = acquire(flat_scene(50.0f), options);
      const auto flat = evaluation::hu_statistics(scan.image, Vec3::Zero(), 30.0);
      EXPECT_NEAR(flat.deviation_hu, 30.0, 0.05 * 30.0);
      EXPECT_NEAR(flat.mean_hu, 50.0, 1.5);
      const imaging::MaskVolume everywhere{options.grid,
                                           std::vector<std::uint8_t>(scan.image.voxels.size(), 1)};
      const auto power =
          evaluation::noise_power(scan.image, evaluation::noise_regions(everywhere, 64, 2), 64);
      EXPECT_NEAR(power.deviation_hu, 30.0, 0.05 * 30.0) << spacing << " " << peak;
      EXPECT_NEAR(power.peak_per_mm, peak, 0.05 * peak) << spacing << " " << peak;
    }
  }
}

TEST(ScanQuality, TheNoisePowerIsThatOfFilteredBackProjection) {
  ScanOptions options = quiet_scan({192, 192, 40}, {0.35, 0.35, 0.45});
  options.noise_hu = 25.0;
  options.noise_peak_per_mm = 0.3;
  const Scan scan = acquire(flat_scene(0.0f), options);
  const imaging::MaskVolume everywhere{options.grid, std::vector<std::uint8_t>(scan.image.voxels.size(), 1)};
  const auto power = evaluation::noise_power(scan.image, evaluation::noise_regions(everywhere, 64), 64);
  double highest = 0.0;
  for (const double p : power.power_hu2_mm2) highest = std::max(highest, p);
  for (std::size_t r = 0; r < power.frequency_per_mm.size(); ++r) {
    const double f = power.frequency_per_mm[r] / 0.3;
    // A ramp under a Gaussian, but for the lowest frequencies, where the two lobes keep some power.
    if (f < 0.5 || f > 2.5) continue;
    EXPECT_NEAR(power.power_hu2_mm2[r] / highest, f * std::exp(0.5 - 0.5 * f * f), 0.13) << f;
  }
  EXPECT_LT(power.power_hu2_mm2.front() / highest, 0.55);
}

TEST(ScanQuality, BlurIsMeasuredThroughTheNoise) {
  const double radius = 9.3;
  ScanOptions options = quiet_scan({74, 74, 58}, {0.35, 0.35, 0.45});
  options.noise_hu = 25.0;
  const Scan scan =
      acquire(FunctionScene([=](const Vec3& p) {
                return p.norm() < radius ? Material{Label::aorta, 350.0f} : Material{Label::fat, -90.0f};
              }),
              options);
  evaluation::EdgeOptions edges;
  edges.direction = EdgeDirection::in_plane;
  const auto distance = [&](const Vec3& p) { return radius - p.norm(); };
  EXPECT_NEAR(evaluation::edge_width(scan.image, distance, edges).fwhm_mm, 0.7, 0.035);
  edges.direction = EdgeDirection::along_k;
  EXPECT_NEAR(evaluation::edge_width(scan.image, distance, edges).fwhm_mm, 0.8, 0.08);
}

}  // namespace
}  // namespace ostia::phantom
