#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"

#include <gtest/gtest.h>

#include <random>

namespace ostia::geometry {
namespace {

AnalyticShape random_chain(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  AnalyticShape shape;
  for (int t = 0; t < 3; ++t) {
    AnalyticTube tube;
    Vec3 p(5 * unit(random), 5 * unit(random), 5 * unit(random));
    for (int i = 0; i < 12; ++i) {
      tube.axis.points.push_back(p);
      tube.axis.radius.push_back(1.0 + 0.8 * unit(random));  // some pieces widen faster than they are long
      p += Vec3(unit(random), unit(random), unit(random));
    }
    complete(tube.axis);
    shape.tubes.push_back(tube);
  }
  return shape;
}

double by_sampling(const AnalyticShape& shape, const Vec3& p) {
  double best = 1e300;
  for (const AnalyticTube& tube : shape.tubes) {
    for (std::size_t i = 0; i + 1 < tube.axis.size(); ++i) {
      for (int k = 0; k <= 2000; ++k) {
        const double t = k / 2000.0;
        const Vec3 c = (1 - t) * tube.axis.points[i] + t * tube.axis.points[i + 1];
        best = std::min(best, (p - c).norm() - (1 - t) * tube.axis.radius[i] - t * tube.axis.radius[i + 1]);
      }
    }
  }
  return best;
}

TEST(TubeDistance, IsTheMinimumOverBallsOfAllPieces) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const AnalyticShape shape = random_chain(seed);
    const TubeDistance f(shape);
    for (int i = 0; i < 50; ++i) {
      const Vec3 p(place(random), place(random), place(random));
      const double expected = by_sampling(shape, p);
      EXPECT_LE(f(p), expected + 1e-12);
      EXPECT_NEAR(f(p), expected, 1e-5);
    }
  }
}

TEST(TubeDistance, ConeHasItsClosedForm) {
  // The side of a cone-sphere is a cone whose half angle has sine k; distances from it are along its normals.
  const AnalyticShape cone = tapered_tube(20.0, 3.0, 1.0);
  const TubeDistance f(cone);
  const double k = -0.1, z = 9.0, rho = 4.0;
  EXPECT_NEAR(f(Vec3(rho, 0, z)), rho * std::sqrt(1 - k * k) - (3.0 + k * z), 1e-12);
  EXPECT_NEAR(f(Vec3(0, 0, 10.0)), -(3.0 + k * 10.0), 1e-2);  // on the axis: about the local radius
}

TEST(TubeDistance, NearestTellsTubeAbscissaAndRadius) {
  AnalyticShape shape = straight_tube(10.0, 1.0);
  AnalyticShape other = tapered_tube(10.0, 2.0, 1.0);
  for (Vec3& p : other.tubes[0].axis.points) p.x() += 8.0;
  shape.tubes.push_back(other.tubes[0]);
  const TubeDistance f(shape);
  const TubeDistance::Nearest first = f.nearest(Vec3(1.5, 0, 4.03));
  EXPECT_EQ(first.tube, 0u);
  EXPECT_NEAR(first.abscissa, 4.03, 1e-12);
  EXPECT_NEAR(first.distance, 0.5, 1e-12);
  const TubeDistance::Nearest second = f.nearest(Vec3(8, 5, 4.0));
  EXPECT_EQ(second.tube, 1u);
  EXPECT_NEAR(second.radius, 2.0 - 0.1 * second.abscissa, 1e-9);
}

TEST(TubeDistance, ChangesNoFasterThanOneStepAStep) {
  const AnalyticShape shape = coronary_like_tree(0.5);
  const TubeDistance f(shape);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const auto point = [&] {
      return Vec3(shape.box.min() +
                  shape.box.sizes().cwiseProduct(Vec3(unit(random), unit(random), unit(random))));
    };
    const Vec3 p = point(), q = point();
    EXPECT_LE(std::abs(f(p) - f(q)), (p - q).norm() + 1e-12);
  }
}

TEST(TubeDistance, RefusesShapesWithoutTubes) {
  EXPECT_THROW(TubeDistance(AnalyticShape{}), InvalidInput);
  AnalyticShape shape = straight_tube(5, 1);
  shape.tubes[0].axis.radius.pop_back();
  EXPECT_THROW(TubeDistance{shape}, InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
