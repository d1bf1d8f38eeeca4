#include "ostia/motion/hyperelastic.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::motion {
namespace {

using geometry::Mat3;
using geometry::Vec3;
using Corners = std::array<Vec3, 8>;

const Vec3 size(1.0, 1.5, 0.8);

Corners at_rest() {
  Corners corners;
  for (int c = 0; c < 8; ++c)
    corners[static_cast<std::size_t>(c)] = size.cwiseProduct(Vec3(c & 1, c >> 1 & 1, c >> 2 & 1));
  return corners;
}

Corners shaken(double by, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-by, by);
  Corners corners = at_rest();
  for (Vec3& p : corners) p += Vec3(unit(random), unit(random), unit(random));
  return corners;
}

Corners mapped(const Mat3& a) {
  Corners corners = at_rest();
  for (Vec3& p : corners) p = a * p + Vec3(5, -3, 2);
  return corners;
}

CellEnergy energy_of(const Corners& corners, const HyperelasticWeights& weights, Derivatives derivatives) {
  return ElasticCell(size).energy(corners, weights, derivatives);
}

double area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

TEST(EqualAreaPoint, HasFourEqualTrianglesWhereThatCanBe) {
  const std::array<Vec3, 4> parallelogram = {Vec3(0, 0, 1), Vec3(3, 1, 1), Vec3(4, 3, 1), Vec3(1, 2, 1)};
  EXPECT_NEAR((equal_area_point(parallelogram) - Vec3(2, 1.5, 1)).norm(), 0.0, 1e-9);
}

// [Yi] figure 5c and 5d: the mean of the corners lies outside.
TEST(EqualAreaPoint, StaysInsideAConcaveQuadrilateral) {
  const std::array<Vec3, 4> dart = {Vec3(0, 0, 0), Vec3(4, 1.9, 0), Vec3(0, 4, 0), Vec3(3.3, 2.0, 0)};
  const auto signed_area = [&](const Vec3& p, std::size_t i) {
    return 0.5 * (dart[(i + 1) % 4] - dart[i]).cross(p - dart[i]).z();
  };
  const auto worst = [&](const Vec3& p) {
    double least = 1e9;
    for (std::size_t i = 0; i < 4; ++i) least = std::min(least, signed_area(p, i));
    return least;
  };
  const Vec3 mean = (dart[0] + dart[1] + dart[2] + dart[3]) / 4.0;
  EXPECT_LT(worst(mean), 0.0);
  EXPECT_GT(worst(equal_area_point(dart)), worst(mean));
}

TEST(EqualAreaPoint, HasTheLeastSumOfSquaredAreas) {
  const std::array<Vec3, 4> quad = {Vec3(0, 0, 0), Vec3(3, 0, 0.5), Vec3(2, 2, 0), Vec3(0.2, 1, -0.3)};
  const auto sum = [&](const Vec3& p) {
    double s = 0.0;
    for (std::size_t i = 0; i < 4; ++i) s += std::pow(area(quad[i], quad[(i + 1) % 4], p), 2);
    return s;
  };
  const Vec3 best = equal_area_point(quad);
  for (const Vec3& step : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    for (const double by : {-0.01, 0.01}) EXPECT_GT(sum(best + by * step), sum(best));
}

TEST(CellPoints, ThoseOfABoxAreItsCentres) {
  const CellPoints points = cell_points(at_rest());
  EXPECT_NEAR((points[14] - size / 2.0).norm(), 0.0, 1e-10);
  EXPECT_NEAR((points[8] - Vec3(0.0, 0.75, 0.4)).norm(), 0.0, 1e-10);
  double volume = 0.0;
  for (const auto& tet : cell_tetrahedra()) {
    const auto p = [&](std::size_t i) { return points[static_cast<std::size_t>(tet[i])]; };
    const double v = (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) / 6.0;
    EXPECT_NEAR(v, size.prod() / 24.0, 1e-10);
    volume += v;
  }
  EXPECT_NEAR(volume, size.prod(), 1e-9);
}

TEST(CellEnergy, OfShiftedBoxesIsZero) {
  const CellEnergy e = energy_of(mapped(Mat3::Identity()), {}, Derivatives::second);
  EXPECT_NEAR(e.energy, 0.0, 1e-12);
  EXPECT_NEAR(e.gradient.norm(), 0.0, 1e-9);
}

// For an affine map F is the same in all tetrahedra: the formula by hand.
TEST(CellEnergy, OfAffineMapsIsTheFormula) {
  const Mat3 stretch = Vec3(1.2, 1.0, 0.9).asDiagonal();
  const double v = 1.08, cof1 = 0.9 * 0.9 - 1.0, cof2 = 1.08 * 1.08 - 1.0, cof3 = 1.2 * 1.2 - 1.0;
  (void)cof1;  // shrinks: costs nothing
  const HyperelasticWeights w{2.0, 3.0, 5.0};
  const double density = 2.0 / 2.0 * (0.04 + 0.01) + 3.0 * (cof2 * cof2 + cof3 * cof3) +
                         5.0 * std::pow((v - 1.0) * (v - 1.0) / v, 2);
  EXPECT_NEAR(energy_of(mapped(stretch), w, Derivatives::none).energy, density * size.prod(), 1e-9);
}

TEST(CellEnergy, OfTurningIsLengthAlone) {
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_NEAR(energy_of(mapped(turn), {0.0, 10.0, 10.0}, Derivatives::none).energy, 0.0, 1e-9);
  EXPECT_GT(energy_of(mapped(turn), {10.0, 0.0, 0.0}, Derivatives::none).energy, 0.1);
}

TEST(CellEnergy, HasTheDerivativesOfDifferences) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Corners corners = shaken(0.15, seed);
    const CellEnergy e = energy_of(corners, {}, Derivatives::second);
    ASSERT_TRUE(std::isfinite(e.energy));
    constexpr double h = 1e-6;
    for (std::size_t i = 0; i < 24; ++i) {
      Corners more = corners, less = corners;
      more[i / 3][static_cast<Eigen::Index>(i % 3)] += h;
      less[i / 3][static_cast<Eigen::Index>(i % 3)] -= h;
      const double difference =
          (energy_of(more, {}, Derivatives::none).energy - energy_of(less, {}, Derivatives::none).energy) /
          (2.0 * h);
      EXPECT_NEAR(e.gradient[static_cast<Eigen::Index>(i)], difference, 1e-6 * (1.0 + std::abs(difference)))
          << "seed " << seed << ", coordinate " << i;
    }
  }
}

TEST(CellEnergy, HessianIsExactAtRestAndNeverNegative) {
  const Corners rest = at_rest();
  const CellEnergy e = energy_of(rest, {10.0, 0.0, 10.0}, Derivatives::second);
  constexpr double h = 1e-5;
  for (std::size_t i = 0; i < 24; ++i) {
    Corners more = rest, less = rest;
    more[i / 3][static_cast<Eigen::Index>(i % 3)] += h;
    less[i / 3][static_cast<Eigen::Index>(i % 3)] -= h;
    const Eigen::Matrix<double, 24, 1> column =
        (energy_of(more, {10.0, 0.0, 10.0}, Derivatives::first).gradient -
         energy_of(less, {10.0, 0.0, 10.0}, Derivatives::first).gradient) /
        (2.0 * h);
    EXPECT_NEAR((e.hessian.col(static_cast<Eigen::Index>(i)) - column).norm(), 0.0, 1e-4);
  }
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Eigen::Matrix<double, 24, 24> shaken_hessian =
        energy_of(shaken(0.2, seed), {}, Derivatives::second).hessian;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 24, 24>> eigen(shaken_hessian);
    EXPECT_GE(eigen.eigenvalues()[0], -1e-9 * eigen.eigenvalues()[23]);
  }
}

TEST(CellEnergy, GrowsWithoutBoundTowardsInversion) {
  double last = 0.0;
  for (const double height : {0.5, 0.1, 0.02, 0.004}) {
    const double now = energy_of(mapped(Vec3(1.0, 1.0, height).asDiagonal()), {}, Derivatives::none).energy;
    EXPECT_GT(now, 4.0 * last);
    last = now;
  }
  EXPECT_TRUE(std::isinf(energy_of(mapped(Vec3(1.0, 1.0, -0.1).asDiagonal()), {}, Derivatives::none).energy));
}

}  // namespace
}  // namespace ostia::motion
