#include "ostia/segmentation/rival_growth.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace ostia::segmentation {
namespace {

using imaging::ImageVolume;
using imaging::MaskVolume;
using ::testing::HasSubstr;

ImageVolume drawn(const std::function<double(const Vec3&)>& hu) {
  ImageVolume image;
  image.geometry.size = {40, 30, 20};
  image.geometry.spacing = Vec3(0.6, 0.6, 0.8);
  image.geometry.origin = Vec3(-3.0, 2.0, 10.0);
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (std::int64_t k = 0; k < 20; ++k)
    for (std::int64_t j = 0; j < 30; ++j)
      for (std::int64_t i = 0; i < 40; ++i)
        image(i, j, k) = static_cast<std::int16_t>(
            std::lround(hu(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))));
  return image;
}

bool in_artery(const Vec3& i) {
  return std::hypot(i.y() - 10.0, i.z() - 10.0) < 3.5;
}
bool in_vein(const Vec3& i) {
  return std::hypot(i.y() - 18.0, i.z() - 10.0) < 3.5;
}
/// Where the two touch: dimmer than both, but a vessel's brightness.
bool in_bridge(const Vec3& i) {
  return std::abs(i.y() - 14.0) < 1.0 && std::abs(i.z() - 10.0) < 2.0 && std::abs(i.x() - 20.0) < 4.0;
}
/// The artery narrows to a few dim voxels at x = 30 and goes on beyond.
double two_vessels(const Vec3& i) {
  if (in_artery(i) && std::abs(i.x() - 30.0) < 1.0) return 150.0;
  if (in_artery(i)) return 330.0;
  if (in_vein(i)) return 270.0;
  return in_bridge(i) ? 200.0 : -850.0;
}

Vec3 world(const ImageVolume& image, double i, double j, double k) {
  return image.geometry.world(Vec3(i, j, k));
}

std::int64_t count(const MaskVolume& owners, Owner owner, const std::function<bool(const Vec3&)>& where) {
  const auto& size = owners.geometry.size;
  std::int64_t sum = 0;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        sum += owners(i, j, k) == static_cast<std::uint8_t>(owner) &&
               where(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
  return sum;
}

TEST(RivalGrowth, VesselsThatTouchAreParted) {
  const ImageVolume image = drawn(two_vessels);
  const MaskVolume owners = grown_against(image, {world(image, 2, 10, 10)}, {world(image, 2, 18, 10)});
  // The artery's far part is reached through 150 HU from itself, and could be through 150 HU by the bridge:
  // it goes to whom it is linked with.
  EXPECT_EQ(count(owners, Owner::seeds, in_vein), 0);
  EXPECT_EQ(count(owners, Owner::rivals, in_artery), 0);
  EXPECT_EQ(count(owners, Owner::nobody, [](const Vec3& i) { return in_artery(i) || in_vein(i); }), 0);
  EXPECT_EQ(count(owners, Owner::nobody,
                  [](const Vec3& i) { return !in_artery(i) && !in_vein(i) && !in_bridge(i); }),
            std::count(owners.voxels.begin(), owners.voxels.end(), 0));
}

TEST(RivalGrowth, WithoutRivalsAllThatIsLinkedIsTaken) {
  const ImageVolume image = drawn(two_vessels);
  const MaskVolume owners = grown_against(image, {world(image, 2, 10, 10)}, {});
  EXPECT_EQ(count(owners, Owner::nobody, [](const Vec3& i) { return in_artery(i) || in_vein(i); }), 0);
  // Above 200 HU neither the bridge nor the artery beyond its narrow place is reached.
  const MaskVolume less = grown_against(image, {world(image, 2, 10, 10)}, {}, {.least_hu = 200.0});
  EXPECT_EQ(count(less, Owner::seeds, in_vein), 0);
  EXPECT_EQ(count(less, Owner::seeds, [](const Vec3& i) { return i.x() >= 29.5; }), 0);
  EXPECT_GT(count(less, Owner::seeds, [](const Vec3& i) { return i.x() < 29.5; }), 900);
}

TEST(RivalGrowth, APlaceBesideTheVesselMeansTheBrightestVoxelNearIt) {
  const ImageVolume image = drawn(two_vessels);
  const auto beside = [&](double snap) {
    return grown_against(image, {world(image, 2, 5.5, 10)}, {}, {.least_hu = 250.0, .snap_mm = snap});
  };
  EXPECT_EQ(beside(1.5).voxels,
            grown_against(image, {world(image, 2, 10, 10)}, {}, {.least_hu = 250.0}).voxels);
  EXPECT_THROW(beside(0.1), InvalidInput);
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no refusal";
}

TEST(RivalGrowth, RefusesWhatMakesNoSense) {
  const ImageVolume image = drawn(two_vessels);
  const Vec3 artery = world(image, 2, 10, 10), nowhere(900.0, 0.0, 0.0), air = world(image, 2, 27, 3);
  EXPECT_THAT(message_of([&] { grown_against(image, {}, {}); }), HasSubstr("no seed"));
  EXPECT_THAT(message_of([&] { grown_against(image, {nowhere}, {}); }), HasSubstr("(900.0, 0.0, 0.0)"));
  EXPECT_THAT(message_of([&] { grown_against(image, {air}, {}); }), HasSubstr("brighter than 100 HU"));
  EXPECT_THAT(message_of([&] { grown_against(image, {artery}, {Vec3(std::nan(""), 0, 0)}); }),
              HasSubstr("outside"));
  EXPECT_THAT(message_of([&] { grown_against(image, {artery}, {artery}); }), HasSubstr("same voxel"));
  EXPECT_THAT(message_of([&] { grown_against({}, {artery}, {}); }), HasSubstr("empty"));
  EXPECT_THAT(message_of([&] { grown_against(image, {artery}, {}, {.snap_mm = -1.0}); }),
              HasSubstr("snap_mm"));
}

TEST(RivalGrowth, CanBeCancelled) {
  const ImageVolume image = drawn(two_vessels);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(grown_against(image, {world(image, 2, 10, 10)}, {}, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::segmentation
