#include "ostia/segmentation/level_set.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace ostia::segmentation {
namespace {

imaging::FloatVolume field(const std::array<std::int64_t, 3>& size, const Vec3& spacing,
                           const std::function<double(const Vec3&)>& f) {
  imaging::FloatVolume out;
  out.geometry.size = size;
  out.geometry.spacing = spacing;
  out.geometry.origin = Vec3(-0.5 * spacing[0] * (size[0] - 1.0), -0.5 * spacing[1] * (size[1] - 1.0),
                             -0.5 * spacing[2] * (size[2] - 1.0));
  out.voxels.resize(static_cast<std::size_t>(out.geometry.voxels()));
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        out(i, j, k) = static_cast<float>(f(out.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))));
  return out;
}

imaging::FloatVolume sphere(double radius, const std::array<std::int64_t, 3>& size, const Vec3& spacing) {
  return field(size, spacing, [&](const Vec3& p) { return p.norm() - radius; });
}

/// Radius of the ball of the same volume, by the part of each voxel that is inside.
double radius_of(const imaging::FloatVolume& phi) {
  const double h = phi.geometry.spacing.maxCoeff();
  double volume = 0.0;
  for (const float value : phi.voxels) volume += std::clamp(0.5 - value / h, 0.0, 1.0);
  return std::cbrt(volume * phi.geometry.spacing.prod() * 3.0 / (4.0 * 3.14159265358979));
}

const std::array<std::int64_t, 3> kLevelSetSize{44, 44, 44};
const Vec3 kLevelSetSpacing = Vec3::Constant(0.5);

TEST(LevelSet, WithoutForcesTheSurfaceStays) {
  const auto initial = sphere(6.0, kLevelSetSize, kLevelSetSpacing);
  LevelSetOptions options;
  options.curvature = 0.0;
  const auto flat = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3&) { return 1.0; });
  const LevelSetResult result = level_set(initial, flat, options);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(radius_of(result.level_set), 6.0, 0.03);
  for (std::size_t n = 0; n < initial.voxels.size(); ++n) {
    EXPECT_EQ(initial.voxels[n] < 0.0F, result.level_set.voxels[n] < 0.0F);
  }
}

TEST(LevelSet, CurvatureShrinksASphereAtItsRate) {
  // r^2 = r0^2 - 4 w2 h^2 t for curvature 2/r, t = steps * 0.4.
  LevelSetOptions options;
  options.advection = 0.0;
  options.curvature = 0.3;
  options.iterations_max = 150;
  options.rms_tolerance_voxels = 0.0;
  const auto flat = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3&) { return 1.0; });
  const LevelSetResult result = level_set(sphere(8.0, kLevelSetSize, kLevelSetSpacing), flat, options);
  const double expected = std::sqrt(64.0 - 4.0 * 0.3 * 0.25 * 0.4 * 150);
  EXPECT_NEAR(radius_of(result.level_set), expected, 0.1);
}

class LevelSetOnRidge : public ::testing::TestWithParam<std::pair<double, Vec3>> {};

TEST_P(LevelSetOnRidge, RestsOnTheRidgeOfTheFeature) {
  const auto& [start, spacing] = GetParam();
  const std::array<std::int64_t, 3> size{static_cast<std::int64_t>(22.0 / spacing[0]),
                                         static_cast<std::int64_t>(22.0 / spacing[1]),
                                         static_cast<std::int64_t>(22.0 / spacing[2])};
  const auto feature =
      field(size, spacing, [](const Vec3& p) { return std::exp(-std::pow(p.norm() - 7.0, 2) / 2.0); });
  LevelSetOptions options;
  options.curvature = 0.0;
  options.iterations_max = 400;
  const LevelSetResult result = level_set(sphere(start, size, spacing), feature, options);
  EXPECT_NEAR(radius_of(result.level_set), 7.0, 0.06);
}

INSTANTIATE_TEST_SUITE_P(FromBothSides, LevelSetOnRidge,
                         ::testing::Values(std::pair{5.5, Vec3(0.5, 0.5, 0.5)},
                                           std::pair{8.2, Vec3(0.5, 0.5, 0.5)},
                                           std::pair{6.0, Vec3(0.4, 0.4, 1.0)},
                                           std::pair{8.0, Vec3(0.4, 0.6, 0.8)}));

/// Mean radius of the sections of a level set about an axis: points of the axis, unit tangents there.
struct Station {
  Vec3 point, tangent;
};
double mean_radius(const imaging::FloatVolume& phi, const std::vector<Station>& axis) {
  double sum = 0.0;
  for (const Station& at : axis) {
    const Vec3 u = at.tangent.unitOrthogonal();
    const Vec3 v = at.tangent.cross(u);
    double area = 0.0;
    for (int ray = 0; ray < 32; ++ray) {
      const double angle = 2.0 * M_PI * ray / 32.0;
      const Vec3 out = std::cos(angle) * u + std::sin(angle) * v;
      double r = 0.0;
      while (r < 5.0 && imaging::sample(phi, at.point + r * out) < 0.0) r += 0.01;
      area += M_PI * r * r / 32.0;
    }
    sum += std::sqrt(area / M_PI);
  }
  return sum / static_cast<double>(axis.size());
}

struct Channel {
  const char* name;
  imaging::FloatVolume initial;
  std::vector<Station> axis;  ///< far from the grid's border, where curvature closes the ends
};

constexpr double kTubeRadius = 1.5;

Channel straight_channel() {
  const Vec3 along = Vec3(0.35, 0.2, 1.0).normalized();  // oblique to the grid
  Channel c{"straight",
            field({56, 50, 90}, Vec3::Constant(0.4),
                  [&](const Vec3& p) { return p.cross(along).norm() - kTubeRadius; }),
            {}};
  for (double s = -6.0; s <= 6.0; s += 0.5) c.axis.push_back({s * along, along});
  return c;
}

Channel bent_channel() {
  // Half a turn about y of radius 12 mm.
  constexpr double bend = 12.0;
  const Vec3 centre(0.0, 0.1, -8.05);
  Channel c{"bent",
            field({76, 24, 70}, Vec3::Constant(0.4),
                  [&](const Vec3& p) {
                    const Vec3 q = p - centre;
                    return std::hypot(std::hypot(q.x(), q.z()) - bend, q.y()) - kTubeRadius;
                  }),
            {}};
  for (double a = -0.6; a <= 0.6; a += 0.05)
    c.axis.push_back(
        {centre + bend * Vec3(std::sin(a), 0.0, std::cos(a)), Vec3(std::cos(a), 0.0, -std::sin(a))});
  return c;
}

TEST(LevelSet, MinimalCurvatureKeepsATubesRadiusWhereMeanCurvatureShrinksIt) {
  for (const Channel& channel : {straight_channel(), bent_channel()}) {
    SCOPED_TRACE(channel.name);
    const auto flat =
        field(channel.initial.geometry.size, Vec3::Constant(0.4), [](const Vec3&) { return 1.0; });
    LevelSetOptions options;
    options.advection = 0.0;
    options.curvature = 0.3;
    options.iterations_max = 25;
    options.rms_tolerance_voxels = 0.0;
    const double before = mean_radius(channel.initial, channel.axis);
    EXPECT_NEAR(before, kTubeRadius, 0.02);
    const double by_mean = mean_radius(level_set(channel.initial, flat, options).level_set, channel.axis);
    // dr/dt = -1/r: r^2 falls by 2 w2 h^2 a unit of time, of 0.4 a step.
    const double expected = std::sqrt(kTubeRadius * kTubeRadius - 2.0 * 0.3 * 0.16 * 0.4 * 25);
    EXPECT_NEAR(by_mean, expected, 0.05);
    EXPECT_LT(by_mean, 0.8 * before);
    options.curvature_term = CurvatureTerm::minimal;
    const double by_minimal = mean_radius(level_set(channel.initial, flat, options).level_set, channel.axis);
    EXPECT_NEAR(by_minimal, before, 0.02 * before);
  }
}

TEST(LevelSet, MinimalCurvatureMovesATorusLikeTheCurveInIt) {
  // In the ring's plane the smaller curvature is 1/x outermost and -1/x innermost, x the distance from the
  // ring's centre: both circles shrink as curves do, x^2 = x0^2 - 2 w2 h^2 t. Mean curvature closes the tube
  // long before.
  constexpr double ring = 8.0;
  const auto initial = field({60, 60, 24}, Vec3::Constant(0.4), [&](const Vec3& p) {
    return std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()) - kTubeRadius;
  });
  const auto flat = field(initial.geometry.size, Vec3::Constant(0.4), [](const Vec3&) { return 1.0; });
  LevelSetOptions options;
  options.advection = 0.0;
  options.curvature = 0.3;
  options.curvature_term = CurvatureTerm::minimal;
  options.iterations_max = 300;
  options.rms_tolerance_voxels = 0.0;
  const auto moved = level_set(initial, flat, options).level_set;
  double outer = 0.0, inner = 0.0;  // where the surface crosses rays in the ring's plane
  for (int ray = 0; ray < 64; ++ray) {
    const double angle = 2.0 * M_PI * ray / 64.0;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    double r = ring;
    while (r < 11.5 && imaging::sample(moved, r * out) < 0.0) r += 0.01;
    outer += r / 64.0;
    r = ring - 0.5;
    while (r > 0.0 && imaging::sample(moved, r * out) < 0.0) r -= 0.01;
    inner += r / 64.0;
  }
  const double shrunk = 2.0 * 0.3 * 0.16 * 0.4 * 300;
  const double outer_way = ring + kTubeRadius - std::sqrt(std::pow(ring + kTubeRadius, 2) - shrunk);
  const double inner_way = ring - kTubeRadius - std::sqrt(std::pow(ring - kTubeRadius, 2) - shrunk);
  EXPECT_NEAR(ring + kTubeRadius - outer, outer_way, 0.25 * outer_way);
  EXPECT_NEAR(ring - kTubeRadius - inner, inner_way, 0.25 * inner_way);
  options.curvature_term = CurvatureTerm::mean;
  EXPECT_THROW(level_set(initial, flat, options), NumericalError);  // nothing is left
}

TEST(LevelSet, KeptPointsStayInside) {
  // Curvature eats up a thin rod, but not the row of voxels that is to be kept.
  const auto rod = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3& p) {
    return std::hypot(p.x() - 0.25, p.y() - 0.25, std::max(0.0, std::abs(p.z()) - 6.0)) - 1.2;
  });
  const auto flat = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3&) { return 1.0; });
  LevelSetOptions options;
  options.advection = 0.0;
  options.curvature = 1.0;
  options.iterations_max = 400;
  std::vector<Vec3> row;
  for (double z = -5.75; z < 6.0; z += 0.5) row.push_back(Vec3(0.25, 0.25, z));
  const auto lost = [&] {
    const LevelSetResult result = level_set(rod, flat, options);
    std::size_t count = 0;
    for (const Vec3& point : row) {
      const Vec3 index = rod.geometry.index(point);
      const auto i = std::llround(index[0]), j = std::llround(index[1]), k = std::llround(index[2]);
      if (result.level_set(i, j, k) >= 0.0F) ++count;
    }
    return count;
  };
  EXPECT_GT(lost(), 2U);
  options.kept = row;
  options.kept.push_back(Vec3(0, 0, 1e9));  // beyond the grid
  options.kept.push_back(Vec3(9, 9, 0));    // outside of the initial surface
  EXPECT_EQ(lost(), 0U);
}

TEST(LevelSet, InflationMovesOutwardsAtItsSpeed) {
  LevelSetOptions options;
  options.inflation = 0.5;
  options.curvature = 0.0;
  options.advection = 0.0;
  options.iterations_max = 30;
  const auto flat = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3&) { return 0.0; });  // G = 1/(1 + 0)
  const double expected = 6.0 + 30 * 0.4 * 0.5 * 0.5;  // steps, step, w1, h
  EXPECT_NEAR(radius_of(level_set(sphere(6.0, kLevelSetSize, kLevelSetSpacing), flat, options).level_set),
              expected, 0.15);
  // An own speed image: nothing moves where it is 0.
  const auto still = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3&) { return 0.0; });
  EXPECT_NEAR(
      radius_of(level_set(sphere(6.0, kLevelSetSize, kLevelSetSpacing), flat, still, options).level_set), 6.0,
      0.03);
}

TEST(LevelSet, IsTheSameWhateverTheNumberOfThreads) {
  const auto feature = field(kLevelSetSize, kLevelSetSpacing,
                             [](const Vec3& p) { return std::sin(3 * p.x()) + std::cos(2 * p.y() * p.z()); });
  core::set_max_threads(1);
  const auto one = level_set(sphere(6.0, kLevelSetSize, kLevelSetSpacing), feature);
  core::set_max_threads(0);
  const auto many = level_set(sphere(6.0, kLevelSetSize, kLevelSetSpacing), feature);
  EXPECT_EQ(one.level_set.voxels, many.level_set.voxels);
  EXPECT_EQ(one.iterations, many.iterations);
}

TEST(LevelSet, RefusesWhatItCannotUse) {
  const auto initial = sphere(6.0, kLevelSetSize, kLevelSetSpacing);
  const auto feature = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3&) { return 1.0; });
  auto bad = feature;
  bad.voxels[17] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(level_set(initial, bad), InvalidInput);
  EXPECT_THROW(level_set(bad, feature), InvalidInput);
  auto elsewhere = feature;
  elsewhere.geometry.origin.x() += 0.1;
  EXPECT_THROW(level_set(initial, elsewhere), InvalidInput);
  EXPECT_THROW(level_set(feature, feature), InvalidInput);  // nothing inside
  LevelSetOptions options;
  options.curvature = -1.0;
  EXPECT_THROW(level_set(initial, feature, options), InvalidInput);
  options = {};
  options.ends = {{Vec3::Zero(), Vec3::Zero(), 1.0}};
  EXPECT_THROW(level_set(initial, feature, options), InvalidInput);
  imaging::ImageVolume image;
  image.geometry.size = {10, 10, 10};
  image.voxels.resize(1000);
  EXPECT_THROW(level_set(initial, image, EdgeFeature{}), InvalidInput);
}

TEST(LevelSet, ASurfaceThatVanishesIsAnError) {
  LevelSetOptions options;
  options.advection = 0.0;
  options.curvature = 1.0;
  options.iterations_max = 3000;
  options.rms_tolerance_voxels = 0.0;
  const auto flat = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3&) { return 1.0; });
  EXPECT_THROW(level_set(sphere(1.2, kLevelSetSize, kLevelSetSpacing), flat, options), NumericalError);
}

TEST(LevelSet, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  const auto feature = field(kLevelSetSize, kLevelSetSpacing, [](const Vec3&) { return 1.0; });
  EXPECT_THROW(level_set(sphere(6.0, kLevelSetSize, kLevelSetSpacing), feature, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::segmentation
