// The quick way to a wall's energies against the normal distributions written out.

#include "boundary/edge_profile.h"
#include "outer_wall/profile.h"

#include "ostia/core/parallel.h"
#include "ostia/core/processor.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

namespace ostia::segmentation {
namespace {

constexpr int n = detail::wall_samples;
using Matrix = Eigen::Matrix<double, n, n>;
using Samples = Eigen::Matrix<double, n, 1>;

constexpr double step_mm = 0.2, sigma_mm = 0.3, noise_hu = 22.0, wall_hu = 50.0, fat_hu = -95.0,
                 lumen_hu = 410.0, lumen_mm = 1.37;

Matrix smooth(double spread, double length_mm) {
  Matrix out;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      out(i, j) = spread * spread * std::exp(-0.5 * std::pow((i - j) * step_mm / length_mm, 2));
  return out;
}

/// A disc's share at a radius of the table, and between its radii as the profile takes it: linear.
Samples disc(double radius_mm, int start) {
  const double x = radius_mm / 0.05, below = std::floor(x);
  Samples out;
  for (int i = 0; i < n; ++i) {
    const double rho = (start + i) * step_mm;
    const double a = blurred_disc(0.05 * below, rho, sigma_mm),
                 b = blurred_disc(0.05 * (below + 1.0), rho, sigma_mm);
    out[i] = a + (x - below) * (b - a);
  }
  return out;
}

struct Layer {
  double to, hu, spread;
};
struct Hypothesis {
  double prior;
  bool healthy;
  double least_mm;
  std::vector<Layer> layers;
};
const std::vector<Hypothesis>& hypotheses() {
  static const std::vector<Hypothesis> all{
      {1.0, true, 0.0, {{1.0, wall_hu, 25.0}}},
      {0.15, false, 0.5, {{1.0, 35.0, 25.0}}},
      {0.15, false, 0.5, {{1.0, 95.0, 35.0}}},
      {0.02, false, 0.2, {{1.0, 850.0, 300.0}}},
      {0.02, false, 0.4, {{0.3, 75.0, 40.0}, {0.95, 850.0, 300.0}}},
      {0.02, false, 0.4, {{0.5, 850.0, 300.0}, {1.0, 75.0, 40.0}}},
      {0.02, false, 0.8, {{0.3, 75.0, 40.0}, {0.6, 850.0, 300.0}, {1.0, 75.0, 40.0}}},
      {0.02, false, 0.8, {{0.5, 75.0, 40.0}, {1.0, 850.0, 300.0}}}};
  return all;
}

/// Negative logarithm of prior x normal density, without the constant that the noise alone has.
double cost(const Samples& rest, const Matrix& covariance, const Matrix& noise, double prior) {
  const double logs = std::log(covariance.determinant()) - std::log(noise.determinant());
  return 0.5 * rest.dot(covariance.ldlt().solve(rest)) + 0.5 * logs - std::log(prior);
}

double written_out(const Samples& ray, int start, double outer_mm) {
  const Matrix noise = smooth(noise_hu, 0.6) + 100.0 * Matrix::Identity();
  const double thick = outer_mm - lumen_mm;
  const Samples lumen = disc(lumen_mm, start), everywhere = Samples::Ones();
  const Samples moved = (disc(lumen_mm + 0.05, start) - disc(lumen_mm - 0.05, start)) / 0.1;
  double sum = std::exp(
      -cost(ray - 60.0 * everywhere, noise + smooth(150.0, 0.5) + 22500.0 * Matrix::Ones(), noise, 0.05));
  for (const bool beyond : {false, true})
    for (const Hypothesis& one : hypotheses()) {
      if (thick < one.least_mm) continue;
      Matrix covariance = noise;
      Samples rest = ray - lumen_hu * lumen, inner = lumen;
      const auto add = [&](const Samples& outer, double hu, double spread) {
        const Samples part = outer - inner;
        rest -= hu * part;
        covariance += spread * spread * part * part.transpose();
        inner = outer;
      };
      for (const Layer& layer : one.layers)
        add(disc(lumen_mm + layer.to * thick, start), layer.hu, layer.spread);
      if (beyond) add(disc(outer_mm + 0.7, start), fat_hu, 20.0);
      beyond ? add(everywhere, 60.0, 150.0) : add(everywhere, fat_hu, 20.0);
      covariance += 225.0 * lumen * lumen.transpose();
      const double place = 0.05 * (lumen_hu - one.layers.front().hu);
      covariance += place * place * moved * moved.transpose();
      double energy = cost(rest, covariance, noise, (beyond ? 0.3 : 1.0) * one.prior);
      if (one.healthy) energy += 0.5 * std::pow(std::max({0.0, 0.25 - thick, thick - 0.9}) / 0.15, 2);
      sum += std::exp(-energy);
    }
  return -std::log(sum);
}

WallProfile profile() {
  return WallProfile({sigma_mm, noise_hu, wall_hu, 0.1, step_mm, {0.2, 0.05, 100}});
}

std::vector<float> ray_of(double outer_mm, double level_hu, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 15.0);
  std::vector<float> out;
  for (int i = 0; i < 40; ++i) {
    const double lumen = blurred_disc(lumen_mm, i * step_mm, sigma_mm),
                 all = blurred_disc(outer_mm, i * step_mm, sigma_mm);
    out.push_back(
        static_cast<float>(lumen_hu * lumen + level_hu * (all - lumen) - 95.0 * (1.0 - all) + noise(random)));
  }
  return out;
}

TEST(WallProfile, IsTheMixtureOfNormalDistributions) {
  const WallProfile quick = profile();
  for (const auto& [outer_mm, level_hu] : {std::pair(1.9, 50.0), {2.6, 30.0}, {2.3, 800.0}}) {
    const std::vector<float> hu = ray_of(outer_mm, level_hu, 7);
    const RayEnergy found = quick.energy({hu.data(), 40, lumen_mm, lumen_hu, fat_hu}, outer_mm);
    const int start = std::max(0, static_cast<int>(std::lround(outer_mm / step_mm)) - n / 2);
    Samples ray;
    for (int i = 0; i < n; ++i) ray[i] = hu[static_cast<std::size_t>(start + i)];
    ASSERT_GE(found.value.size(), 15U);
    for (std::size_t k = 0; k < found.value.size(); ++k) {
      const double radius = 0.2 + 0.05 * (found.first + static_cast<double>(k));
      EXPECT_NEAR(found.value[k], written_out(ray, start, radius), 1e-7) << outer_mm << " at " << radius;
    }
  }
}

TEST(WallProfile, ARayThatSaysNothingHasTheSameCandidates) {
  const WallProfile quick = profile();
  const std::vector<float> hu = ray_of(2.0, 50.0, 1);
  for (const double about_mm : {0.3, 1.5, 2.0, 5.0}) {
    const WallRay ray{hu.data(), 40, lumen_mm, lumen_hu, fat_hu};
    const RayEnergy one = quick.energy(ray, about_mm), none = quick.no_energy(ray, about_mm);
    EXPECT_EQ(one.first, none.first);
    EXPECT_EQ(none.value, std::vector<double>(one.value.size(), 0.0));
  }
}

TEST(WallProfile, HasTheSameBitsOnEveryProcessor) {
#if defined(__x86_64__)
  if (!core::has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
#endif
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  detail::WallSamples samples;
  for (auto& part : samples.value)
    for (auto& row : part)
      for (double& one : row) one = value(random);
  detail::WallMixture mixtures[2];
  mixtures[0] = {2, {{4, 0, 50.0, 25.0}, {2, 4, -90.0, 20.0}}};
  mixtures[1] = {4, {{5, 0, 75.0, 40.0}, {6, 5, 850.0, 300.0}, {9, 6, -90.0, 20.0}, {0, -1, 0.0, 15.0}}};
  double square[2][2][detail::wall_candidates] = {}, determinant[2][2][detail::wall_candidates] = {};
  detail::wall_loop_plain()(samples, 3, 21, mixtures, 2, square[0], determinant[0]);
  detail::wall_loop_avx2()(samples, 3, 21, mixtures, 2, square[1], determinant[1]);
  for (int h = 0; h < 2; ++h)
    for (int c = 0; c < 21; ++c) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(square[0][h][c]), std::bit_cast<std::uint64_t>(square[1][h][c]));
      EXPECT_EQ(std::bit_cast<std::uint64_t>(determinant[0][h][c]),
                std::bit_cast<std::uint64_t>(determinant[1][h][c]));
      EXPECT_GE(determinant[0][h][c], 1.0);
    }
}

TEST(BlurredDiscs, AreThoseOfTheFormulaWhateverWasAskedForBefore) {
  const auto check = [](double largest_mm, double reach_mm, double step, double sigma) {
    const BlurredDiscs discs(largest_mm, reach_mm, step, sigma);
    for (int r = 0; r < discs.radii(); r += 7)
      for (int i = 0; i < discs.samples(); i += 3)
        EXPECT_EQ(discs.share(r, i), blurred_disc(r * 0.05, i * step, sigma))
            << r << ", " << i << " of " << largest_mm;
    EXPECT_EQ(discs.share(3, 10000), discs.share(3, discs.samples() - 1));
  };
  check(2.0, 4.0, 0.2, 0.31);
  check(9.0, 5.0, 0.2, 0.31);   // more radii than before
  check(3.0, 14.0, 0.2, 0.31);  // more samples
  check(2.0, 4.0, 0.2, 0.31);
  check(2.0, 4.0, 0.25, 0.31);
  check(2.0, 4.0, 0.2, 0.45);
}

TEST(BlurredDiscs, AreAskedForByManyAtOnce) {
  std::vector<double> sums(32, 0.0);
  core::parallel_for(sums.size(), 1, [&](std::size_t k) {
    const BlurredDiscs discs(2.0 + 0.3 * static_cast<double>(k % 5), 6.0, 0.2, 0.37);
    for (int i = 0; i < 30; ++i) sums[k] += discs.at(1.23, i);
  });
  for (const double sum : sums) EXPECT_EQ(sum, sums.front());
}

}  // namespace
}  // namespace ostia::segmentation
