#include "ostia/evaluation/phase_sharpness.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>

namespace ostia::evaluation {
namespace {

constexpr double fat = -100.0, blood = 400.0;

imaging::ImageVolume sharpness_image(std::array<std::int64_t, 3> size, double spacing,
                                     const std::function<double(const Vec3&)>& hu, double noise_hu = 0.0,
                                     unsigned seed = 1) {
  imaging::ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = Vec3::Constant(spacing);
  image.geometry.origin = Vec3(-7.0, 3.0, 20.0);
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const Vec3 at(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        const double more = noise_hu > 0.0 ? noise_hu * noise(random) : 0.0;
        image(i, j, k) = static_cast<std::int16_t>(std::lround(hu(spacing * at) + more));
      }
  return image;
}

/// Share of blood behind an edge at a signed distance (positive: in the fat), blurred by a Gaussian.
double edge(double distance_mm, double sigma_mm) {
  return 0.5 * std::erfc(distance_mm / (sigma_mm * std::numbers::sqrt2));
}

/// Two arteries of 3 mm beside a chamber, 24 mm a side, smeared by the way that they make while the scanner
/// looks: the mean over that way. Places are from the corner.
constexpr double artery_mm = 1.5, scanner_mm = 0.4;
std::vector<Vec3> artery_points(double shift_mm) {
  std::vector<Vec3> points;
  for (double z = 2.0; z <= 22.0; z += 1.0) {
    points.push_back(Vec3(-7.0, 3.0, 20.0) + Vec3(6.0 + shift_mm, 7.0, z));
    points.push_back(Vec3(-7.0, 3.0, 20.0) + Vec3(6.0 + shift_mm, 17.0, z));
  }
  return points;
}
imaging::ImageVolume heart_at(double shift_mm, double smear_mm, double noise_hu = 0.0, unsigned seed = 1,
                              double spacing = 0.5) {
  constexpr int steps = 7;
  const auto still = [](double x, double y) {
    const double artery = std::min(std::hypot(x - 6.0, y - 7.0), std::hypot(x - 6.0, y - 17.0)) - artery_mm;
    const double chamber = std::hypot(x - 20.0, y - 12.0) - 7.0;
    return std::max(edge(artery, scanner_mm), edge(chamber, scanner_mm));
  };
  const auto side = static_cast<std::int64_t>(std::lround(24.0 / spacing)) + 1;
  return sharpness_image(
      {side, side, side}, spacing,
      [&](const Vec3& p) {
        double sum = 0.0;
        for (int n = 0; n < steps; ++n)
          sum += still(p.x() - shift_mm - smear_mm * (n / (steps - 1.0) - 0.5), p.y());
        return fat + (blood - fat) * sum / steps;
      },
      noise_hu, seed);
}

/// A heart that rests at one phase: the faster it goes, the longer the way while the scanner looks.
constexpr int beat_phases = 10;
double smear_of(int phase, int rest) {
  const double away = std::abs(std::remainder((phase - rest) / static_cast<double>(beat_phases), 1.0));
  return 8.0 * away;  // 0 to 4 mm
}
double shift_of(int phase, int rest) {
  return 1.5 * std::sin(2.0 * std::numbers::pi * (phase - rest) / static_cast<double>(beat_phases));
}
struct MeasuredBeat {
  std::vector<std::optional<EdgeSharpness>> carried, same;  // axes that go along; the same at all phases
};
MeasuredBeat measured_beat(int rest, double noise_hu) {
  MeasuredBeat beat;
  SharpnessOptions wider;
  wider.within_mm = 7.0;
  for (int n = 0; n < beat_phases; ++n) {
    const auto image = heart_at(shift_of(n, rest), smear_of(n, rest), noise_hu, static_cast<unsigned>(n + 1));
    beat.carried.emplace_back(edge_sharpness(image, artery_points(shift_of(n, rest))));
    beat.same.emplace_back(edge_sharpness(image, artery_points(0.0), wider));
  }
  return beat;
}

EdgeSharpness made_up(double per_mm, double noise_hu = 20.0) {
  EdgeSharpness one;
  one.per_mm = per_mm;
  one.edges_mm2 = 1000.0;
  one.noise_hu = noise_hu;
  one.spacing_mm = Vec3(0.4, 0.4, 0.5);
  return one;
}

TEST(EdgeSharpness, IsThatOfTheFormulaForABlurredEdge) {
  for (const double sigma : {0.4, 0.8, 1.2}) {
    const auto image = sharpness_image(
        {61, 41, 41}, 0.4, [&](const Vec3& p) { return fat + (blood - fat) * edge(p.x() - 12.0, sigma); });
    const Vec3 middle = image.geometry.world(Vec3(30, 20, 20));
    SharpnessOptions options;
    options.within_mm = 7.5;
    options.least_share_per_mm = 0.0;
    const double all = std::hypot(sigma, options.sigma_mm), whole = 0.5 / (std::sqrt(std::numbers::pi) * all);
    const EdgeSharpness found = edge_sharpness(image, {middle}, options);
    EXPECT_NEAR(found.per_mm, whole, 0.04 * whole) << sigma;
    EXPECT_NEAR(found.blur_mm(options), sigma, 0.1) << sigma;
    const double disc_mm2 = std::numbers::pi * 7.5 * 7.5;
    EXPECT_NEAR(found.edges_mm2, disc_mm2, 0.06 * disc_mm2) << sigma;
    // Without what is fainter than noise: the integrals over what is left of the Gaussian.
    options.least_share_per_mm = 0.04;
    const double top = 1.0 / (all * std::sqrt(2.0 * std::numbers::pi));
    const double cut = std::sqrt(2.0 * std::log(top / options.least_share_per_mm));
    const double left = whole * std::erf(cut) / std::erf(cut / std::numbers::sqrt2);
    EXPECT_NEAR(edge_sharpness(image, {middle}, options).per_mm, left, 0.04 * left) << sigma;
  }
}

TEST(EdgeSharpness, MoreEdgesAreNotSharper) {
  const auto plates = [](double apart_mm) {
    return sharpness_image({81, 41, 41}, 0.4, [&](const Vec3& p) {
      return fat + (blood - fat) * edge(std::abs(std::remainder(p.x(), apart_mm)) - apart_mm / 4.0, 0.6);
    });
  };
  const auto few = plates(32.0), many = plates(10.0);
  const std::vector<Vec3> all{few.geometry.world(Vec3(40, 20, 20))};
  SharpnessOptions options;
  options.within_mm = 30.0;
  const EdgeSharpness a = edge_sharpness(few, all, options), b = edge_sharpness(many, all, options);
  EXPECT_GT(b.edges_mm2, 2.0 * a.edges_mm2);
  EXPECT_NEAR(b.per_mm, a.per_mm, 0.03 * a.per_mm);
}

TEST(EdgeSharpness, FallsWithTheWayThatTheHeartMakes) {
  double before = 1.0;
  for (const double smear : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0}) {
    const EdgeSharpness found = edge_sharpness(heart_at(0.0, smear), artery_points(0.0));
    EXPECT_LT(found.per_mm, before) << smear;
    before = found.per_mm;
  }
}

TEST(EdgeSharpness, LungCalciumAndBoneDoNotCountAsSharper) {
  const auto plain = heart_at(0.0, 1.0);
  auto with = plain;
  for (auto& hu : with.voxels)
    if (hu <= -100)
      hu = -850;  // where there was fat without blood
    else if (hu >= 399)
      hu = 1400;
  const auto points = artery_points(0.0);
  const double a = edge_sharpness(plain, points).per_mm, b = edge_sharpness(with, points).per_mm;
  EXPECT_NEAR(b, a, 1e-3 * a);
}

TEST(EdgeSharpness, NoiseChangesItLittle) {
  const auto points = artery_points(0.0);
  const double quiet = edge_sharpness(heart_at(0.0, 1.0), points).per_mm;
  const EdgeSharpness usual = edge_sharpness(heart_at(0.0, 1.0, 30.0), points);
  EXPECT_NEAR(usual.per_mm, quiet, 0.05 * quiet);
  EXPECT_GT(usual.noise_hu, 15.0);
}

TEST(EdgeSharpness, WithoutAxesTheMiddleOfTheChestIsLookedAt) {
  const auto chest = [](double smear_mm, double wall_mm) {
    return sharpness_image({101, 101, 31}, 1.0, [&](const Vec3& p) {
      const double heart = std::hypot(p.x() - 50.0, p.y() - 45.0) - 22.0;
      const double wall = 48.0 - std::hypot(p.x() - 50.0, p.y() - 50.0);  // outside of the box
      return fat + (blood - fat) * std::max(edge(heart, std::hypot(0.7, smear_mm)), edge(wall, wall_mm));
    });
  };
  const double still = edge_sharpness(chest(0.0, 0.7), {}).per_mm;
  EXPECT_LT(edge_sharpness(chest(1.5, 0.7), {}).per_mm, 0.8 * still) << "the heart counts";
  EXPECT_NEAR(edge_sharpness(chest(0.0, 2.0), {}).per_mm, still, 0.01 * still) << "the chest's wall does not";
}

TEST(EdgeSharpness, AFlatImageHasNone) {
  const auto flat = sharpness_image({20, 20, 20}, 0.5, [](const Vec3&) { return 50.0; });
  const EdgeSharpness found = edge_sharpness(flat, {});
  EXPECT_EQ(found.per_mm, 0.0);
  EXPECT_EQ(found.edges_mm2, 0.0);
  EXPECT_EQ(found.blur_mm(), 0.0);
}

TEST(EdgeSharpness, TheSameBitsForAnyNumberOfThreads) {
  const auto image = heart_at(0.3, 1.0, 20.0);
  core::set_max_threads(1);
  const double one = edge_sharpness(image, artery_points(0.3)).per_mm;
  core::set_max_threads(0);
  EXPECT_EQ(edge_sharpness(image, artery_points(0.3)).per_mm, one);
}

TEST(EdgeSharpness, RefusesWhatItCannotMeasure) {
  const auto image = heart_at(0.0, 0.0);
  EXPECT_THROW(edge_sharpness(image, {Vec3(500, 0, 0)}), InvalidInput);
  EXPECT_THROW(edge_sharpness(sharpness_image({20, 20, 2}, 1.0, [](const Vec3&) { return 0.0; }), {}),
               InvalidInput);
  SharpnessOptions options;
  options.high_hu = options.low_hu;
  EXPECT_THROW(edge_sharpness(image, {}, options), InvalidInput);
  options = {};
  options.sigma_mm = std::nan("");
  EXPECT_THROW(edge_sharpness(image, {}, options), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(edge_sharpness(image, {}, {}, task), Cancelled);
  auto points = artery_points(0.0);
  points.resize(4);
  points.push_back(Vec3(500, 0, 0));
  EXPECT_NEAR(edge_sharpness(image, points).inside, 0.8, 1e-12);
}

TEST(BloodLevel, IsTheChambersPeak) {
  const auto heart = sharpness_image(
      {60, 60, 20}, 1.0, [](const Vec3& p) { return std::hypot(p.x() - 30, p.y() - 27) < 14 ? 352.0 : 60.0; },
      25.0);
  EXPECT_NEAR(*blood_level_hu(heart), 352.0, 15.0);
  const auto plain = sharpness_image(
      {60, 60, 20}, 1.0, [](const Vec3&) { return 45.0; }, 25.0);
  EXPECT_FALSE(blood_level_hu(plain)) << "a scan without contrast";
}

TEST(BestPhase, IsTheOneAtRestWhereverThatIs) {
  for (const int rest : {0, 7}) {
    const MeasuredBeat beat = measured_beat(rest, 25.0);
    const BestPhase carried = best_phase(beat.carried);
    EXPECT_EQ(carried.best, static_cast<std::size_t>(rest)) << "axes are carried";
    EXPECT_EQ(best_phase(beat.same).best, static_cast<std::size_t>(rest)) << "the same axes at all phases";
    EXPECT_TRUE(carried.as_sharp.empty());
    for (int n = 1; n <= beat_phases / 2; ++n) {
      const auto at = [&](int phase) {
        return carried.share[static_cast<std::size_t>((phase + beat_phases) % beat_phases)];
      };
      EXPECT_LT(at(rest + n), at(rest + n - 1)) << n << " after the rest";
      EXPECT_LT(at(rest - n), at(rest - n + 1)) << n << " before the rest";
    }
  }
}

TEST(BestPhase, ABadPhaseIsNotProposedAndNamed) {
  auto phases = measured_beat(3, 25.0).carried;
  const auto points = artery_points(shift_of(6, 3));
  phases[6] = edge_sharpness(heart_at(shift_of(6, 3), smear_of(6, 3), 400.0), points);
  EXPECT_GT(phases[6]->per_mm, 0.0);
  EXPECT_EQ(best_phase(phases).best, 3u);
  EXPECT_EQ(best_phase(phases).left_out[6], LeftOut::noisy);
  phases[6] = edge_sharpness(heart_at(0.0, 0.0, 25.0, 1, 0.7), artery_points(0.0));
  EXPECT_EQ(best_phase(phases).left_out[6], LeftOut::other_voxels);
  phases[6].reset();
  EXPECT_EQ(best_phase(phases).left_out[6], LeftOut::not_measured);
  phases[6] = made_up(0.0);
  phases[6]->edges_mm2 = 0.0;
  EXPECT_EQ(best_phase(phases).left_out[6], LeftOut::no_edges);
  phases[6] = phases[3];
  phases[6]->inside = 0.5;
  EXPECT_EQ(best_phase(phases).left_out[6], LeftOut::elsewhere);
  phases[6] = phases[3];
  phases[6]->per_mm *= 2.0;
  phases[6]->edges_mm2 *= 0.2;
  EXPECT_EQ(best_phase(phases).left_out[6], LeftOut::lost_edges);
  const BestPhase found = best_phase(phases);
  EXPECT_EQ(found.best, 3u);
  EXPECT_EQ(found.share[6], 0.0);
  EXPECT_EQ(found.left_out[5], LeftOut::none) << "the others stay";
}

TEST(BestPhase, OfTiesTheOneOnTheTableStays) {
  const std::vector<std::optional<EdgeSharpness>> tied{made_up(0.200), made_up(0.2495), made_up(0.2500),
                                                       made_up(0.2495)};
  EXPECT_EQ(best_phase(tied).best, 2u);
  EXPECT_EQ(best_phase(tied).as_sharp, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(best_phase(tied, 3).best, 3u);
  EXPECT_EQ(best_phase(tied, 3).as_sharp, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(best_phase(tied, 0).best, 2u) << "it is clearly less sharp";
  EXPECT_EQ(best_phase({made_up(0.25), made_up(0.25)}).best, 0u);
}

TEST(BestPhase, ThereIsNoneAmongFlatImagesOrOfOnePhase) {
  const std::vector<std::optional<EdgeSharpness>> flat{EdgeSharpness{}, EdgeSharpness{}, EdgeSharpness{}};
  EXPECT_FALSE(best_phase(flat).best);
  EXPECT_EQ(best_phase(flat).left_out, (std::vector<LeftOut>(3, LeftOut::no_edges)));
  EXPECT_FALSE(best_phase({made_up(0.3)}).best);
  EXPECT_FALSE(best_phase({}).best);
  EXPECT_THROW(best_phase({made_up(0.3)}, 1), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
