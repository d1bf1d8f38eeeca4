#include "ostia/segmentation/colliding_fronts.h"

#include "tube_images.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::segmentation {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using testing::Tube;

const Vec3 kSpacing(0.4, 0.4, 0.5);
const std::array<std::int64_t, 3> kSize{50, 50, 60};
const Tube kStraight{{10, 10, 4}, {10, 10, 26}, 1.6};

bool inside(const InitialRegion& region, const Vec3& point) {
  const Vec3 index = region.level_set.geometry.index(point);
  std::array<std::int64_t, 3> v{};
  for (int d = 0; d < 3; ++d) {
    v[d] = std::llround(index[d]);
    if (v[d] < 0 || v[d] >= region.level_set.geometry.size[d]) return false;
  }
  return region.level_set(v[0], v[1], v[2]) < 0.0F;
}

double volume_of(const InitialRegion& region) {
  return static_cast<double>(region.voxels) * region.level_set.geometry.spacing.prod();
}

TEST(CollidingFronts, FillATubeBetweenItsSeeds) {
  const auto image = testing::tube_image({kStraight}, kSize, kSpacing, 0.3);
  const InitialRegion region = colliding_fronts(image, {kStraight.from, std::nullopt, kStraight.to});
  const double exact = 3.14159 * 1.6 * 1.6 * 22.0;
  EXPECT_NEAR(volume_of(region), exact, 0.25 * exact);
  EXPECT_TRUE(inside(region, {10, 10, 15}));
  EXPECT_FALSE(inside(region, {10, 10, 2.0}));
  EXPECT_FALSE(inside(region, {10, 10, 28.0}));
  EXPECT_FALSE(region.touches_border);
  ASSERT_EQ(region.outward.size(), 2U);
  EXPECT_LT(region.outward[0].z(), -0.95);
  EXPECT_GT(region.outward[1].z(), 0.95);
}

TEST(CollidingFronts, LeaveSideBranchesOut) {
  const Tube side{{10, 10, 15}, {19, 10, 19}, 1.2, true};
  const auto image = testing::tube_image({kStraight, side}, kSize, kSpacing, 0.3);
  const InitialRegion region = colliding_fronts(image, {kStraight.from, std::nullopt, kStraight.to});
  EXPECT_TRUE(inside(region, {10, 10, 15}));
  EXPECT_FALSE(inside(region, {14, 10, 16.8}));
  EXPECT_FALSE(inside(region, {17, 10, 18.1}));
}

TEST(CollidingFronts, APointBetweenChoosesTheWayAndLeavesNoGap) {
  // Two ways round: straight up, or out and back.
  const Tube out{{10, 10, 4}, {17, 10, 15}, 1.2, true};
  const Tube back{{17, 10, 15}, {10, 10, 26}, 1.2, true};
  Tube middle = kStraight;
  middle.finite = true;
  middle.radius = 1.2;
  const auto image = testing::tube_image({middle, out, back}, kSize, kSpacing, 0.3);
  const InitialRegion region = colliding_fronts(image, {{10, 10, 4}, Vec3(17, 10, 15), {10, 10, 26}});
  for (double t = 0.1; t < 0.95; t += 0.05) {
    EXPECT_TRUE(inside(region, (1 - t) * out.from + t * out.to)) << t;
    EXPECT_TRUE(inside(region, (1 - t) * back.from + t * back.to)) << t;
  }
  EXPECT_TRUE(inside(region, {16.9, 10, 15}));
  EXPECT_FALSE(inside(region, {10, 10, 15}));
}

TEST(CollidingFronts, TwoVoxelVesselsAreJoinedToo) {
  const Tube thin{{5.1, 6.3, 3}, {14.7, 13.1, 26}, 0.4};
  const auto image = testing::tube_image({thin}, kSize, Vec3(0.4, 0.4, 0.4), 0.25);
  const InitialRegion region =
      colliding_fronts(image, {thin.from, std::nullopt, thin.from + 0.7 * (thin.to - thin.from)});
  EXPECT_TRUE(inside(region, thin.from + 0.35 * (thin.to - thin.from)));
}

TEST(CollidingFronts, StayNearTheVesselUnlessToldOtherwise) {
  const Tube other{{15, 10, 10}, {4, 10, 20}, 1.0};
  const auto image = testing::tube_image({kStraight, other}, {50, 50, 120}, kSpacing, 0.3);
  CollidingFrontsOptions options;
  const auto sparse = colliding_fronts(image, {kStraight.from, std::nullopt, kStraight.to}, options);
  options.domain = FrontDomain::whole_volume;
  const auto whole = colliding_fronts(image, {kStraight.from, std::nullopt, kStraight.to}, options);
  EXPECT_LT(2 * sparse.visited, whole.visited + sparse.visited);
  EXPECT_NEAR(static_cast<double>(sparse.voxels), static_cast<double>(whole.voxels), 0.02 * whole.voxels);
}

TEST(CollidingFronts, SayWhatIsWrong) {
  const Tube apart{{16, 10, 4}, {16, 10, 26}, 1.2};
  const auto image = testing::tube_image({kStraight, apart}, kSize, kSpacing, 0.3);
  EXPECT_THAT(
      [&] {
        colliding_fronts(image, {kStraight.from, std::nullopt, apart.to});
      },
      ThrowsMessage<GeometryError>(::testing::AllOf(HasSubstr("never meet"), HasSubstr("came as far as (11."),
                                                    HasSubstr("mm before the other seed"))));
  CollidingFrontsOptions narrow;
  narrow.lower_hu = 400.0;
  narrow.upper_hu = 600.0;
  EXPECT_THAT(
      [&] {
        colliding_fronts(image, {kStraight.from, std::nullopt, kStraight.to}, narrow);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("outside the intensity range: 350 HU there")));
  EXPECT_THAT(
      [&] {
        colliding_fronts(image, {kStraight.from, std::nullopt, kStraight.from});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("the same voxel")));
  EXPECT_THROW(colliding_fronts(image, {kStraight.from, std::nullopt, Vec3(10, 10, 400)}), InvalidInput);
  narrow.slowest = 0.0;
  EXPECT_THROW(validate(narrow), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  const Tube wide{{10, 10, 4}, {10, 10, 26}, 6.0};
  const auto large = testing::tube_image({wide}, kSize, kSpacing, 0.3);
  EXPECT_THROW(colliding_fronts(large, {wide.from, std::nullopt, wide.to}, {}, task), Cancelled);
}

TEST(CollidingFronts, AVesselThatLeavesTheImageIsFlagged) {
  const auto image = testing::tube_image({kStraight}, kSize, kSpacing, 0.3);
  EXPECT_TRUE(colliding_fronts(image, {{10, 10, 0.1}, std::nullopt, kStraight.to}).touches_border);
}

TEST(CollidingFronts, DoNotDependOnTheNumberOfThreads) {
  const auto image = testing::tube_image({kStraight}, kSize, kSpacing, 0.3, 25.0);
  core::set_max_threads(1);
  const auto one = colliding_fronts(image, {kStraight.from, std::nullopt, kStraight.to});
  core::set_max_threads(0);
  const auto many = colliding_fronts(image, {kStraight.from, std::nullopt, kStraight.to});
  EXPECT_EQ(one.level_set.voxels, many.level_set.voxels);
}

TEST(FastMarchingInitialisation, IsTheFrontAtTheFirstTarget) {
  const auto image = testing::tube_image({kStraight}, kSize, kSpacing, 0.3);
  const InitialRegion region =
      fast_marching_initialisation(image, {Vec3(10, 10, 15)}, {Vec3(10, 10, 21), Vec3(10, 10, 5)});
  EXPECT_TRUE(inside(region, {10, 10, 20}));
  EXPECT_TRUE(inside(region, {10, 10, 10}));  // as far the other way
  EXPECT_FALSE(inside(region, {10, 10, 22.5}));
  EXPECT_FALSE(inside(region, {10, 10, 7.5}));
  EXPECT_THROW(fast_marching_initialisation(image, {}, {Vec3(10, 10, 21)}), InvalidInput);
  EXPECT_THROW(fast_marching_initialisation(image, {Vec3(10, 10, 15)}, {}), InvalidInput);
}

}  // namespace
}  // namespace ostia::segmentation
