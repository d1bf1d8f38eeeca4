#include "motion/gauss_sum.h"
#include "motion/kernel_deformation.h"
#include "motion/lbfgs.h"
#include "motion/mixture_distance.h"

#include "ostia/core/error.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::experiments {
namespace {

using Eigen::VectorXd;
using geometry::Vec3;
using Points = std::vector<Vec3>;

Points scattered(std::size_t count, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-reach, reach);
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(unit(random), unit(random), unit(random));
  return points;
}

WeightedCloud cloud_of(const Points& points) {
  WeightedCloud cloud{points, {}};
  for (std::size_t i = 0; i < points.size(); ++i) cloud.weights.push_back(0.5 + static_cast<double>(i % 3));
  return cloud;
}

double all_pairs(const WeightedCloud& a, const WeightedCloud& b, double width) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    for (std::size_t k = 0; k < b.points.size(); ++k) {
      const double squared = (a.points[i] - b.points[k]).squaredNorm() / (4.0 * width * width);
      if (squared < 9.0) sum += a.weights[i] * b.weights[k] * (std::exp(-squared) - std::exp(-9.0));
    }
  return sum;
}

TEST(GaussSum, IsThatOfAllPairsHoweverTheCloudsLie) {
  const WeightedCloud a = cloud_of(scattered(120, 3.0, 1));
  for (const double width : {0.1, 0.6, 5.0})
    for (const double off : {0.0, 2.0, 300.0}) {
      Points points = scattered(80, 4.0, 2);
      for (Vec3& p : points) p.x() += off;
      const WeightedCloud b = cloud_of(points);
      const double truth = all_pairs(a, b, width);
      EXPECT_NEAR(GaussSum(a, width)(b, nullptr), truth, 1e-12 * (1.0 + truth));
    }
}

TEST(GaussSum, HasTheDerivativesOfDifferences) {
  const WeightedCloud a = cloud_of(scattered(100, 3.0, 1));
  WeightedCloud b = cloud_of(scattered(20, 3.0, 2));
  const GaussSum sum(a, 0.7);
  std::vector<Vec3> by;
  sum(b, &by);
  for (std::size_t i = 0; i < b.points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double step = 1e-5;
      const Vec3 at = b.points[i];
      b.points[i][axis] = at[axis] + step;
      const double more = sum(b, nullptr);
      b.points[i][axis] = at[axis] - step;
      EXPECT_NEAR(by[i][axis], (more - sum(b, nullptr)) / (2.0 * step), 1e-4);
      b.points[i] = at;
    }
}

TEST(Thinned, KeepsDistanceAndAllWeight) {
  const Points points = scattered(500, 2.0, 3);
  std::vector<std::size_t> kept;
  const WeightedCloud cloud = thinned(points, 0.5, kept);
  EXPECT_LT(kept.size(), 450U);
  double weight = 0.0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    weight += cloud.weights[i];
    EXPECT_EQ(cloud.points[i], points[kept[i]]);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((cloud.points[i] - cloud.points[k]).norm(), 0.5);
  }
  EXPECT_NEAR(weight, 1.0, 1e-12);
  thinned(points, 1e-9, kept);
  EXPECT_EQ(kept.size(), points.size());
}

/// Rosenbrock's valley in many dimensions: its minimum is 0 where all are 1.
double valley(const VectorXd& x, VectorXd& gradient) {
  gradient = VectorXd::Zero(x.size());
  double sum = 0.0;
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i) {
    const double a = x[i + 1] - x[i] * x[i], b = 1.0 - x[i];
    sum += 100.0 * a * a + b * b;
    gradient[i] += -400.0 * a * x[i] - 2.0 * b;
    gradient[i + 1] += 200.0 * a;
  }
  return sum;
}

TEST(Minimise, FindsTheEndOfAValley) {
  const Minimum found = minimise(valley, VectorXd::Zero(40), 2000, 1e-14, core::no_task());
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.place - VectorXd::Ones(40)).norm(), 1e-4);
  EXPECT_LT(found.iterations, 500);
  EXPECT_GE(found.evaluations, found.iterations);
}

TEST(Minimise, TellsWhenItWasStoppedAndStartsWhereItEnds) {
  const Minimum stopped = minimise(valley, VectorXd::Zero(40), 5, 1e-14, core::no_task());
  EXPECT_FALSE(stopped.converged);
  EXPECT_EQ(stopped.iterations, 5);
  const Minimum still = minimise(valley, VectorXd::Ones(40), 5, 1e-14, core::no_task());
  EXPECT_TRUE(still.converged);
  EXPECT_EQ(still.iterations, 0);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(minimise(valley, VectorXd::Zero(4), 5, 1e-14, task), Cancelled);
}

struct BothKinds : public ::testing::TestWithParam<DeformationKind> {
  Points control = scattered(60, 1.0, 4), points = scattered(25, 1.0, 5);
  KernelDeformation deformation{GetParam(), control, 0.4};
  KernelDeformation::Prepared cloud = deformation.prepared(points);
  VectorXd some() const {
    VectorXd x(deformation.unknowns());
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 0.1 * std::sin(static_cast<double>(7 * i));
    return x;
  }
};

TEST_P(BothKinds, ZeroMovesNothingAndTheGradientIsTransposed) {
  EXPECT_EQ(deformation.moved(cloud, VectorXd::Zero(deformation.unknowns())), coordinates(points));
  // Linear: <by, moved(x) - moved(0)> = <gradient(by), x>.
  const Coordinates by = coordinates(scattered(25, 1.0, 6)),
                    way = deformation.moved(cloud, some()) - cloud.points;
  EXPECT_GT(way.norm(), 0.1);
  EXPECT_NEAR((by.array() * way.array()).sum(), deformation.gradient(cloud, by).dot(some()), 1e-10);
}

TEST_P(BothKinds, BendingIsNeverNegativeAndHasItsGradient) {
  VectorXd gradient, other;
  const VectorXd x = some();
  EXPECT_GT(deformation.bending(x, gradient), 0.0);
  for (Eigen::Index i = 0; i < x.size(); i += 11) {
    VectorXd more = x, less = x;
    more[i] += 1e-4;
    less[i] -= 1e-4;
    EXPECT_NEAR(gradient[i], (deformation.bending(more, other) - deformation.bending(less, other)) / 2e-4,
                1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(KernelDeformation, BothKinds,
                         ::testing::Values(DeformationKind::thin_plate_spline,
                                           DeformationKind::gaussian_basis));

TEST(KernelDeformation, AffineMapsOfThinPlatesAreExactAndBendNothing) {
  const Points points = scattered(25, 1.0, 5);
  const KernelDeformation deformation(DeformationKind::thin_plate_spline, scattered(60, 1.0, 4), 1.0);
  VectorXd x = VectorXd::Zero(deformation.unknowns());
  const Eigen::Index rows = x.size() / 3;
  x[0] = 0.5;             // along x by 0.5
  x[rows + 2] = 0.25;     // y stretched by 1.25
  x[2 * rows + 1] = 0.1;  // z by a tenth of x
  const Coordinates moved = deformation.moved(deformation.prepared(points), x);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    const Vec3 truth(p.x() + 0.5, 1.25 * p.y(), p.z() + 0.1 * p.x());
    EXPECT_LT((moved.row(static_cast<Eigen::Index>(i)).transpose() - truth).norm(), 1e-12);
  }
  VectorXd gradient;
  EXPECT_NEAR(deformation.bending(x, gradient), 0.0, 1e-20);
}

TEST(MixtureDistance, IsZeroForEqualCloudsAndHasItsGradient) {
  const Points points = scattered(60, 1.0, 8);
  const WeightedCloud fixed = cloud_of(points);
  for (const MixtureCost cost : {MixtureCost::l2, MixtureCost::kernel_correlation}) {
    const MixtureDistance distance(cost, fixed.weights, fixed, 0.3);
    Coordinates by, other, at = coordinates(points);
    EXPECT_NEAR(distance(at, by), 0.0, 1e-12);
    EXPECT_NEAR(by.norm(), 0.0, 1e-12);
    at += 0.1 * coordinates(scattered(60, 1.0, 9));
    EXPECT_GT(distance(at, by), 0.01);
    for (Eigen::Index i = 0; i < at.rows(); i += 7)
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        Coordinates more = at, less = at;
        more(i, axis) += 1e-5;
        less(i, axis) -= 1e-5;
        EXPECT_NEAR(by(i, axis), (distance(more, other) - distance(less, other)) / 2e-5, 1e-6);
      }
  }
}

}  // namespace
}  // namespace ostia::experiments
