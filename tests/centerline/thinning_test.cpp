#include "ostia/centerline/thinning.h"

#include "support/masks.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::centerline {
namespace {

using imaging::MaskVolume;
using test::grid_of;
using test::mask_of;
using test::topology_of;
using ::testing::HasSubstr;

std::string message_of(const MaskVolume& mask) {
  try {
    thinned(mask);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

MaskVolume shell(double outer, double inner) {
  const Vec3 middle = Vec3::Constant(12.0);
  return mask_of(grid_of(25, 25, 25), [=](const Vec3& p) {
    const double d = (p - middle).norm();
    return d <= outer && d > inner;
  });
}

TEST(Thinning, RandomBlobsKeepTheirTopology) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Vec3 spacing = seed % 2 == 0 ? Vec3(0.6, 0.6, 1.25) : Vec3(1.0, 1.0, 1.0);
    const MaskVolume mask = test::random_blobs(seed, 28, spacing);
    const Thinned thin = thinned(mask);
    EXPECT_EQ(topology_of(thin.mask), topology_of(mask)) << "seed " << seed;
    EXPECT_LT(thin.voxels.size(), static_cast<std::size_t>(thin.object_voxels));
  }
}

TEST(Thinning, RandomVoxelsKeepTheirTopology) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const MaskVolume mask = test::random_voxels(seed, 16, 0.1 * static_cast<double>(seed));
    EXPECT_EQ(topology_of(thinned(mask).mask), topology_of(mask)) << "seed " << seed;
    EXPECT_EQ(topology_of(thinned(mask, {.keep_ends = false}).mask), topology_of(mask)) << "seed " << seed;
  }
}

TEST(Thinning, ABallIsOneVoxelInItsMiddle) {
  for (const Vec3& spacing : {Vec3(1.0, 1.0, 1.0), Vec3(0.6, 0.6, 1.25)}) {
    const imaging::Geometry grid = grid_of(33, 33, 33, spacing);
    const Vec3 middle = grid.world(Vec3::Constant(16.0));
    const MaskVolume ball = mask_of(grid, [&](const Vec3& p) { return (p - middle).norm() <= 8.3; });
    const Thinned thin = thinned(ball);
    ASSERT_EQ(thin.voxels.size(), 1U);
    EXPECT_LE(std::abs(thin.voxels[0] - grid.offset(16, 16, 16)), 1);
    EXPECT_NEAR(thin.distance_mm[0], 8.3, spacing.maxCoeff());
  }
}

TEST(Thinning, AHollowShellStaysAClosedSurface) {
  const MaskVolume mask = shell(10.0, 6.0);
  const Thinned thin = thinned(mask);
  const test::Topology expected{1, 0, 1, 2};
  EXPECT_EQ(topology_of(mask), expected);
  EXPECT_EQ(topology_of(thin.mask), expected);
  EXPECT_EQ(thin.filled_cavity_voxels, 0);
}

TEST(Thinning, AFilledShellIsABall) {
  const MaskVolume mask = shell(10.0, 2.5);
  const Thinned thin = thinned(mask, {.fill_cavities = true});
  EXPECT_EQ(thin.voxels.size(), 1U);
  const std::vector<std::uint8_t> whole = shell(10.0, -1.0).voxels;
  EXPECT_EQ(thin.filled_cavity_voxels, std::count(whole.begin(), whole.end(), 1) -
                                           std::count(mask.voxels.begin(), mask.voxels.end(), 1));
}

TEST(Thinning, DistancesAreThoseToTheNearestBackground) {
  const Vec3 spacing(0.6, 0.8, 1.25);
  const MaskVolume mask = test::random_blobs(77, 20, spacing);
  const Thinned thin = thinned(mask);
  const imaging::Geometry& grid = mask.geometry;
  ASSERT_FALSE(thin.voxels.empty());
  for (std::size_t n = 0; n < thin.voxels.size(); n += 3) {
    const std::int64_t v = thin.voxels[n];
    const Vec3 at(static_cast<double>(v % 20), static_cast<double>(v / 20 % 20),
                  static_cast<double>(v / 400));
    double best = std::numeric_limits<double>::infinity();
    for (std::int64_t k = -1; k <= 20; ++k)
      for (std::int64_t j = -1; j <= 20; ++j)
        for (std::int64_t i = -1; i <= 20; ++i) {
          const bool out = i < 0 || j < 0 || k < 0 || i > 19 || j > 19 || k > 19;
          if (!out && mask(i, j, k) != 0) continue;
          const Vec3 p(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
          best = std::min(best, grid.spacing.cwiseProduct(p - at).norm());
        }
    EXPECT_NEAR(thin.distance_mm[n], best, 1e-5);
  }
}

TEST(Thinning, ATubesSkeletonLiesOnItsAxis) {
  const Vec3 a(8.0, 8.0, 5.0), b(22.0, 20.0, 45.0);
  const MaskVolume tube = mask_of(grid_of(40, 36, 64, Vec3(0.8, 0.8, 0.8)),
                                  [&](const Vec3& p) { return test::in_tube(p, a, b, 3.0); });
  const Thinned thin = thinned(tube);
  const Vec3 axis = (b - a).normalized();
  std::size_t inner = 0;
  for (const std::int64_t v : thin.voxels) {
    const Vec3 p = tube.geometry.world(
        Vec3(static_cast<double>(v % 40), static_cast<double>(v / 40 % 36), static_cast<double>(v / 1440)));
    const double s = (p - a).dot(axis);
    if (s < 4.0 || s > (b - a).norm() - 4.0) continue;
    ++inner;
    EXPECT_LT((p - a - s * axis).norm(), 0.8 * std::sqrt(3.0));
  }
  EXPECT_GT(inner, 30U);
}

TEST(Thinning, EndsStayOnlyIfAsked) {
  const MaskVolume line =
      mask_of(grid_of(5, 5, 20), [](const Vec3& p) { return p.x() == 2.0 && p.y() == 2.0 && p.z() > 3.0; });
  EXPECT_EQ(thinned(line).mask.voxels, line.voxels);
  EXPECT_EQ(thinned(line, {.keep_ends = false}).voxels.size(), 1U);
}

TEST(Thinning, ABarOfEvenWidthIsNotEatenUp) {
  for (int axis = 0; axis < 3; ++axis) {
    const MaskVolume bar = mask_of(grid_of(30, 30, 30), [&](const Vec3& p) {
      for (int d = 0; d < 3; ++d)
        if (d != axis && (p[d] < 10.0 || p[d] > 11.0)) return false;
      return p[axis] > 2.0 && p[axis] < 27.0;
    });
    EXPECT_GE(thinned(bar).voxels.size(), 18U) << "axis " << axis;
  }
}

TEST(Thinning, TheSameForAnyNumberOfThreads) {
  const MaskVolume mask = test::random_blobs(5, 40, Vec3(0.5, 0.5, 0.7));
  core::set_max_threads(1);
  const Thinned one = thinned(mask);
  core::set_max_threads(4);
  const Thinned four = thinned(mask);
  core::set_max_threads(0);
  EXPECT_EQ(one.mask.voxels, four.mask.voxels);
  EXPECT_EQ(one.distance_mm, four.distance_mm);
}

TEST(Thinning, AnEmptyMaskHasNoSkeleton) {
  const Thinned thin = thinned(mask_of(grid_of(4, 4, 4), [](const Vec3&) { return false; }));
  EXPECT_TRUE(thin.voxels.empty());
  EXPECT_EQ(thin.mask.voxels.size(), 64U);
}

TEST(Thinning, RefusesBadImages) {
  MaskVolume mask = mask_of(grid_of(4, 4, 4), [](const Vec3&) { return true; });
  mask.voxels.pop_back();
  EXPECT_THAT(message_of(mask), HasSubstr("64 voxels, but it has 63"));
  mask.voxels.push_back(1);
  mask.geometry.spacing.y() = 0.0;
  EXPECT_THAT(message_of(mask), HasSubstr("spacing is 0"));
  EXPECT_THAT(message_of(MaskVolume{}), HasSubstr("0 voxels along an axis"));
}

TEST(Thinning, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(thinned(test::random_blobs(1, 20), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::centerline
