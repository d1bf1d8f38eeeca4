#include "ostia/evaluation/image_quality.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

imaging::ImageVolume image_of(std::array<std::int64_t, 3> size, const Vec3& spacing,
                              const std::function<double(const Vec3&)>& value) {
  imaging::ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.geometry.origin = Vec3(-3.0, 2.0, 11.0);
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(value(image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))))));
  return image;
}

imaging::MaskVolume mask_where(const imaging::ImageVolume& image,
                               const std::function<bool(std::int16_t)>& in) {
  imaging::MaskVolume mask{image.geometry, {}};
  for (const std::int16_t v : image.voxels) mask.voxels.push_back(in(v));
  return mask;
}

TEST(HuStatistics, AreThoseOfKnownNumbers) {
  // 0 ... 100, each once a column.
  const auto image = image_of({101, 3, 2}, {1, 1, 1}, [](const Vec3& p) { return p.x() + 3.0; });
  const HuStatistics s = hu_statistics(image, mask_where(image, [](std::int16_t) { return true; }));
  EXPECT_EQ(s.voxels, 606u);
  EXPECT_NEAR(s.mean_hu, 50.0, 1e-9);
  EXPECT_NEAR(s.deviation_hu, std::sqrt(850.0 * 606 / 605), 1e-9);
  EXPECT_NEAR(s.median_hu, 50.0, 1e-9);
  EXPECT_NEAR(s.p05_hu, 5.0, 1.0);
  EXPECT_NEAR(s.p95_hu, 95.0, 1.0);
  imaging::MaskVolume mask = mask_where(image, [](std::int16_t v) { return v == 7; });
  for (auto& v : mask.voxels) v *= 3;
  EXPECT_EQ(hu_statistics(image, mask, 3).mean_hu, 7.0);
  EXPECT_THROW(hu_statistics(image, mask, 2), InvalidInput);
  mask.geometry.origin.x() += 1.0;
  EXPECT_THROW(hu_statistics(image, mask, 3), InvalidInput);
}

TEST(HuStatistics, ABallHoldsTheVoxelsWhoseCentresAreInIt) {
  const auto image = image_of({21, 21, 21}, {0.5, 0.5, 0.5}, [](const Vec3&) { return 42.0; });
  const Vec3 middle = image.geometry.world(Vec3(10, 10, 10));
  EXPECT_EQ(hu_statistics(image, middle, 0.51).voxels, 7u);
  EXPECT_EQ(hu_statistics(image, middle, 0.72).voxels, 19u);
  EXPECT_EQ(hu_statistics(image, image.geometry.world(Vec3(0, 0, 0)), 0.51).voxels, 4u);
  EXPECT_THROW(hu_statistics(image, middle + Vec3(100, 0, 0), 1.0), InvalidInput);
}

TEST(HuHistogram, CountsAndClampsToItsEnds) {
  const auto image =
      image_of({4, 1, 1}, {1, 1, 1}, [](const Vec3& p) { return 100.0 * (p.x() + 3.0) - 50.0; });
  const HuHistogram h = hu_histogram(image, 0.0, 200.0, 100.0);  // -50, 50, 150, 250
  ASSERT_EQ(h.share.size(), 2u);
  EXPECT_EQ(h.share[0], 0.5);
  EXPECT_EQ(h.share[1], 0.5);
  const auto mask = mask_where(image, [](std::int16_t v) { return v > 100; });
  EXPECT_EQ(hu_histogram(image, 0.0, 200.0, 100.0, &mask).share[1], 1.0);
  EXPECT_EQ(histogram_distance(h, hu_histogram(image, 0.0, 200.0, 100.0, &mask)), 0.5);
  EXPECT_EQ(histogram_distance(h, h), 0.0);
  EXPECT_THROW(histogram_distance(h, hu_histogram(image, 0.0, 200.0, 50.0)), InvalidInput);
  EXPECT_THROW(hu_histogram(image, 10.0, 0.0, 5.0), InvalidInput);
  EXPECT_THROW(hu_histogram(image, 0.0, 10.0, 0.0), InvalidInput);
}

TEST(NoisePower, AWaveHasItsPowerAtItsFrequency) {
  // 12 waves over 64 voxels of 0.5 mm: 0.375 cycles/mm; variance 40^2 / 2.
  const double f = 12.0 / 32.0;
  const auto image = image_of({64, 64, 3}, {0.5, 0.5, 1.0}, [&](const Vec3& p) {
    return 100.0 + 40.0 * std::cos(2.0 * std::numbers::pi * f * (p.x() + p.z()));
  });
  const NoisePower power = noise_power(image, {{0, 0, 0}, {0, 0, 2}}, 64);
  EXPECT_EQ(power.regions, 2u);
  EXPECT_NEAR(power.deviation_hu, 40.0 / std::numbers::sqrt2, 0.2);  // the trend takes a little
  EXPECT_NEAR(power.peak_per_mm, f, 0.02);
  EXPECT_NEAR(power.mean_per_mm, f, 0.02);
}

TEST(NoisePower, ATrendOfSecondOrderIsNoNoise) {
  const auto image = image_of({40, 40, 1}, {0.5, 0.5, 1.0}, [](const Vec3& p) {
    return 10.0 * p.x() - 4.0 * p.y() + 2.0 * p.x() * p.x() + p.x() * p.y() - 1.5 * p.y() * p.y();
  });
  EXPECT_LT(noise_power(image, {{2, 3, 0}}, 32).deviation_hu, 0.4);  // rounding to whole HU alone
}

TEST(NoisePower, WhiteNoiseIsFlatAndItsIntegralTheVariance) {
  // A deterministic scramble of the place: uniform in (-50, 50).
  std::uint64_t state = 1;
  const auto image = image_of({128, 128, 6}, {0.4, 0.4, 1.0}, [&](const Vec3&) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 33) / 2147483648.0 * 100.0 - 50.0;
  });
  std::vector<NoiseRegion> regions;
  for (std::int64_t k = 0; k < 6; ++k)
    for (std::int64_t j = 0; j < 128; j += 32)
      for (std::int64_t i = 0; i < 128; i += 32) regions.push_back({i, j, k});
  const NoisePower power = noise_power(image, regions, 32);
  EXPECT_NEAR(power.deviation_hu, 100.0 / std::sqrt(12.0), 0.4);
  const double level = 10000.0 / 12.0 * 0.16;  // variance times the voxel's area
  for (std::size_t r = 1; r < power.power_hu2_mm2.size(); ++r)
    EXPECT_NEAR(power.power_hu2_mm2[r], level, 0.15 * level) << r;
}

TEST(NoisePower, RefusesRegionsThatAreNoneAndTheSameForAnyThreads) {
  const auto image = image_of({40, 40, 2}, {0.5, 0.5, 1.0}, [](const Vec3& p) {
    return 50.0 * std::sin(3.0 * p.x()) * std::cos(5.0 * p.y());
  });
  EXPECT_THROW(noise_power(image, {}, 16), InvalidInput);
  EXPECT_THROW(noise_power(image, {{0, 0, 0}}, 4), InvalidInput);
  EXPECT_THROW(noise_power(image, {{30, 0, 0}}, 16), InvalidInput);
  EXPECT_THROW(noise_power(image, {{0, 0, 2}}, 16), InvalidInput);
  const std::vector<NoiseRegion> regions(40, {3, 5, 1});
  core::set_max_threads(1);
  const NoisePower one = noise_power(image, regions, 16);
  core::set_max_threads(0);
  EXPECT_EQ(one.power_hu2_mm2, noise_power(image, regions, 16).power_hu2_mm2);
}

TEST(NoisePower, RegionsTileAMask) {
  const auto image = image_of({30, 20, 4}, {1, 1, 1}, [](const Vec3& p) { return p.x(); });
  const auto mask = mask_where(image, [](std::int16_t v) { return v >= 2; });  // from i = 5
  const auto regions = noise_regions(mask, 10, 2);
  ASSERT_EQ(regions.size(), 8u);
  for (const NoiseRegion& r : regions) {
    EXPECT_GE(r[0], 5);
    EXPECT_LE(r[0], 20);
    EXPECT_EQ(r[2] % 2, 0);
  }
  EXPECT_TRUE(noise_regions(mask, 26).empty());
}

/// A ball with Gaussian edges: the exact profile of a plane, bent.
imaging::ImageVolume soft_ball(const Vec3& centre, double radius, double fwhm, double noise) {
  const double sigma = fwhm / std::sqrt(8.0 * std::numbers::ln2);
  std::uint64_t state = 5;
  return image_of({64, 64, 60}, {0.5, 0.5, 0.5}, [&](const Vec3& p) {
    const double d = radius - (p - centre).norm();
    double grain = 0.0;
    for (int n = 0; n < 12; ++n) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      grain += static_cast<double>(state >> 33) / 2147483648.0;
    }
    return -90.0 + 440.0 * 0.5 * std::erfc(-d / (sigma * std::numbers::sqrt2)) + noise * (grain - 6.0);
  });
}

TEST(EdgeWidth, AKnownEdgeIsMeasuredBack) {
  const Vec3 centre(13.1, 18.2, 26.3);
  for (const double fwhm : {0.5, 0.9, 1.6}) {
    const auto image = soft_ball(centre, 10.0, fwhm, 0.0);
    for (const EdgeDirection direction :
         {EdgeDirection::any, EdgeDirection::in_plane, EdgeDirection::along_k}) {
      EdgeOptions options;
      options.direction = direction;
      const EdgeWidth width = edge_width(
          image, [&](const Vec3& p) { return 10.0 - (p - centre).norm(); }, options);
      EXPECT_NEAR(width.fwhm_mm, fwhm, 0.01) << fwhm;
      EXPECT_NEAR(width.low_hu, -90.0, 1.0);
      EXPECT_NEAR(width.high_hu, 350.0, 1.0);
      EXPECT_NEAR(width.shift_mm, 0.0, 0.005);
      if (direction != EdgeDirection::along_k) {
        EXPECT_NEAR(width.line_spread_fwhm_mm, fwhm, 0.05 * fwhm);
      }
    }
  }
}

TEST(EdgeWidth, AnOffsetBoundaryIsToldAsShift) {
  const Vec3 centre(13.1, 18.2, 26.3);
  const auto image = soft_ball(centre, 10.0, 0.8, 0.0);
  const EdgeWidth width = edge_width(image, [&](const Vec3& p) { return 9.7 - (p - centre).norm(); });
  EXPECT_NEAR(width.shift_mm, -0.3, 0.01);
  EXPECT_NEAR(width.fwhm_mm, 0.8, 0.02);
}

TEST(EdgeWidth, FittedBoundariesGiveTheSameWidthThroughNoise) {
  const Vec3 centre(13.1, 18.2, 26.3);
  const auto image = soft_ball(centre, 10.0, 0.9, 20.0);
  const auto mask = mask_where(soft_ball(centre, 10.0, 0.9, 0.0), [](std::int16_t v) { return v > 130; });
  const EdgeWidths widths = edge_widths(image, mask, {}, 600);
  EXPECT_GT(widths.fwhm_mm.size(), 300u);
  EXPECT_LE(widths.fwhm_mm.size(), widths.tried);
  EXPECT_NEAR(widths.median_mm, 0.9, 0.05);
  EXPECT_LE(widths.p25_mm, widths.median_mm);
  EXPECT_LE(widths.median_mm, widths.p75_mm);
}

TEST(EdgeWidth, FaintEdgesAreLeftOut) {
  const auto image =
      image_of({30, 30, 30}, {0.5, 0.5, 0.5}, [](const Vec3& p) { return p.x() > 4.0 ? 60.0 : 0.0; });
  const auto mask = mask_where(image, [](std::int16_t v) { return v > 30; });
  const EdgeWidths widths = edge_widths(image, mask);
  EXPECT_GT(widths.tried, 0u);
  EXPECT_TRUE(widths.fwhm_mm.empty());
  EXPECT_EQ(widths.median_mm, 0.0);
}

TEST(EdgeWidth, RefusesNonsenseAndCanBeCancelled) {
  const auto image =
      image_of({20, 20, 20}, {0.5, 0.5, 0.5}, [](const Vec3& p) { return p.x() > 2.0 ? 500.0 : 0.0; });
  const auto far = [](const Vec3&) { return 1000.0; };
  EXPECT_THROW(edge_width(image, far), InvalidInput);
  EdgeOptions bad;
  bad.half_length_mm = 0.0;
  EXPECT_THROW(edge_width(image, far, bad), InvalidInput);
  auto mask = mask_where(image, [](std::int16_t v) { return v > 30; });
  mask.geometry.spacing.x() = 0.6;
  EXPECT_THROW(edge_widths(image, mask), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(edge_width(
                   image, [](const Vec3& p) { return p.x() - 2.0; }, {}, task),
               Cancelled);
}

/// A wave of 20 HU with its normal at this angle from the i axis.
double wave(const Vec3& p, double degrees, double per_mm) {
  const double a = degrees * std::numbers::pi / 180.0;
  return 20.0 * std::cos(2.0 * std::numbers::pi * per_mm * (p.x() * std::cos(a) + p.y() * std::sin(a)));
}

TEST(NoisePower, StreaksLieAcrossTheWavesThatMakeThem) {
  const std::vector<NoiseRegion> squares{{0, 0, 0}, {32, 0, 0}, {0, 32, 0}, {32, 32, 0}};
  for (const double angle : {0.0, 30.0, 90.0, 135.0}) {
    const auto one =
        image_of({64, 64, 1}, {0.5, 0.5, 0.5}, [&](const Vec3& p) { return wave(p, angle, 0.3); });
    const NoisePower power = noise_power(one, squares, 32);
    EXPECT_GT(power.anisotropy, 0.8) << angle;  // the square lets some power leak
    EXPECT_NEAR(std::remainder(power.streaks_deg - angle - 90.0, 180.0), 0.0, 3.0) << angle;
    // With as much across, there is no direction.
    const auto both = image_of({64, 64, 1}, {0.5, 0.5, 0.5}, [&](const Vec3& p) {
      return wave(p, angle, 0.3) + wave(p, angle + 90.0, 0.3);
    });
    EXPECT_LT(noise_power(both, squares, 32).anisotropy, 0.08) << angle;
    // Three quarters of the power one way: 3/4 - 1/4.
    const auto more = image_of({64, 64, 1}, {0.5, 0.5, 0.5}, [&](const Vec3& p) {
      return std::sqrt(3.0) * wave(p, angle, 0.3) + wave(p, angle + 90.0, 0.3);
    });
    EXPECT_NEAR(noise_power(more, squares, 32).anisotropy, 0.5, 0.12) << angle;
  }
}

TEST(NoiseCorrelation, IsTheShareThatSlicesHaveInCommon) {
  // Slices k and k + 1 share a wave of half the power, slices farther apart nothing.
  const auto image = image_of({48, 48, 8}, {0.5, 0.5, 1.0}, [](const Vec3& p) {
    const double k = p.z() - 11.0;
    return wave(p, 25.0 * k, 0.3) + wave(p, 25.0 * (k + 1.0), 0.3);
  });
  const std::vector<double> alike =
      noise_correlation_along_k(image, {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}}, 48, 3);
  ASSERT_EQ(alike.size(), 3u);
  EXPECT_NEAR(alike[0], 0.5, 0.08);
  EXPECT_NEAR(alike[1], 0.0, 0.08);
  EXPECT_NEAR(alike[2], 0.0, 0.08);
  EXPECT_THROW(noise_correlation_along_k(image, {{0, 0, 7}}, 48, 1), InvalidInput);
  EXPECT_THROW(noise_correlation_along_k(image, {{0, 0, 0}}, 48, 0), InvalidInput);
  EXPECT_THROW(noise_correlation_along_k(image, {}, 48, 1), InvalidInput);
}

TEST(EdgeProfile, ShowsHowFarAnEdgeFallsBelowAndRisesAboveItsSides) {
  const auto rise = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
  for (const double negative : {0.0, 0.3}) {
    const auto level = [&](double x) { return (1.0 + negative) * rise(x / 0.4) - negative * rise(x / 0.8); };
    double lowest = 0.0;
    for (double x = -3.0; x < 0.0; x += 0.01) lowest = std::min(lowest, level(x));
    // A ball, brighter and darker than what is about it.
    for (const double step : {600.0, -600.0}) {
      const Vec3 middle(10.0, 15.0, 24.0);
      const auto image = image_of({64, 64, 64}, {0.4, 0.4, 0.4}, [&](const Vec3& p) {
        return 100.0 + (step > 0.0 ? step * level(8.0 - (p - middle).norm())
                                   : step * (1.0 - level((p - middle).norm() - 8.0)));
      });
      imaging::MaskVolume mask{image.geometry, {}};
      for (std::int64_t v = 0; v < image.geometry.voxels(); ++v) {
        const Vec3 index(static_cast<double>(v % 64), static_cast<double>(v / 64 % 64),
                         static_cast<double>(v / 4096));
        mask.voxels.push_back((image.geometry.world(index) - middle).norm() < 8.0);
      }
      EdgeOptions options;
      options.half_length_mm = 4.0;
      const EdgeProfile profile = edge_profile(image, mask, options, 300);
      ASSERT_GT(profile.edges, 100u);
      EXPECT_NEAR(profile.undershoot, -lowest, 0.006) << negative << " " << step;
      EXPECT_NEAR(profile.overshoot, -lowest, 0.006) << negative << " " << step;
      EXPECT_LT(profile.level.front(), 0.02);
      EXPECT_GT(profile.level.back(), 0.98);
    }
  }
}

}  // namespace
}  // namespace ostia::evaluation
