#include "ostia/phantom/builtin_case.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::phantom {
namespace {

using geometry::Vec3;

const BuiltinCase& builtin() {
  static const BuiltinCase instance = make_builtin_case();
  return instance;
}

TEST(BuiltinCase, VesselIsSurroundedByTheImage) {
  for (const auto& tube : builtin().truth.tubes) {
    for (std::size_t i = 0; i < tube.axis.size(); ++i) {
      const Vec3 reach = Vec3::Constant(tube.axis.radius[i] + 5.0);
      EXPECT_TRUE(builtin().image.geometry.contains(tube.axis.points[i] - reach));
      EXPECT_TRUE(builtin().image.geometry.contains(tube.axis.points[i] + reach));
    }
  }
}

TEST(BuiltinCase, LumenIsBrightAlongItsAxes) {
  for (const auto& tube : builtin().truth.tubes) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 60; i + 60 < tube.axis.size(); i += 20, ++count)
      sum += imaging::sample(builtin().image, tube.axis.points[i]);
    EXPECT_NEAR(sum / count, 380.0, 12.0);
  }
}

TEST(BuiltinCase, WallIsHalfWayBetweenLumenAndFat) {
  // Across the parent, far from stenosis and bifurcation, the mean profile passes the middle at the radius.
  const geometry::Centerline& axis = builtin().truth.tubes[0].axis;
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 80; i < 160; i += 4) {
    for (int a = 0; a < 24; ++a, ++count) {
      const double angle = a * std::acos(-1.0) / 12.0;
      const Vec3 direction =
          std::cos(angle) * axis.frames[i].normal + std::sin(angle) * axis.frames[i].binormal;
      sum += imaging::sample(builtin().image, axis.points[i] + axis.radius[i] * direction);
    }
  }
  EXPECT_NEAR(sum / count, 0.5 * (380.0 - 80.0), 25.0);
}

TEST(BuiltinCase, NoiseHasItsDeviation) {
  const auto& image = builtin().image;
  double sum = 0.0, square = 0.0, n = 0.0;
  for (std::int64_t k = 0; k < 12; ++k) {
    for (std::int64_t j = 0; j < 12; ++j) {
      for (std::int64_t i = image.geometry.size[0] - 12; i < image.geometry.size[0]; ++i, ++n) {
        const double v = image(i, j, k);
        sum += v;
        square += v * v;
      }
    }
  }
  const double mean = sum / n;
  EXPECT_NEAR(mean, -80.0, 6.0);
  EXPECT_NEAR(std::sqrt(square / n - mean * mean), 20.0, 4.0);
}

TEST(BuiltinCase, StenosisIsWhereItIsSaidToBe) {
  const BuiltinStenosis& s = builtin().stenosis;
  const geometry::Centerline& axis = builtin().truth.tubes[s.tube].axis;
  double least = 100.0, at = 0.0;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (axis.radius[i] < least) {
      least = axis.radius[i];
      at = axis.abscissa[i];
    }
  }
  EXPECT_NEAR(at, s.centre_mm, 0.2);
  EXPECT_NEAR(least, s.throat_radius_mm, 0.01);
  EXPECT_NEAR(s.diameter_stenosis, 0.5, 0.021);
}

TEST(BuiltinCase, SeedsLieInTheLumen) {
  const geometry::TubeDistance distance(builtin().truth);
  ASSERT_EQ(builtin().branches.size(), 2u);
  for (const auto& [from, to] : builtin().branches) {
    EXPECT_LT(distance(from), -1.0);
    EXPECT_LT(distance(to), -1.0);
  }
}

TEST(BuiltinCase, IsTheSameForTheSameSeedAndAnyThreads) {
  core::set_max_threads(1);
  const BuiltinCase again = make_builtin_case();
  core::set_max_threads(0);
  EXPECT_EQ(again.image.voxels, builtin().image.voxels);
  BuiltinOptions other;
  other.seed = 2;
  EXPECT_NE(make_builtin_case(other).image.voxels, builtin().image.voxels);
}

TEST(BuiltinCase, RefusesNonsenseAndCanBeCancelled) {
  BuiltinOptions bad;
  bad.spacing_mm = 0.0;
  EXPECT_THROW(make_builtin_case(bad), InvalidInput);
  bad = {};
  bad.noise_hu = -1.0;
  EXPECT_THROW(make_builtin_case(bad), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(make_builtin_case({}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::phantom
