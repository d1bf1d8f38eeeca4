#include "ostia/coronary/aorta.h"

#include "made_image.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/coronary/ostia.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::coronary {
namespace {

using ostia::testing::made_image;
using ostia::testing::ramp;
using ::testing::HasSubstr;

constexpr double fat_hu = -80.0, contrast_hu = 400.0;
constexpr double aorta_radius = 14.0;

/// An aorta that leans over as a quarter of a circle of 60 mm radius in the plane x = 0 (up, then to the
/// back), and two arteries of 1.6 mm radius that leave it 25 mm up, to the left and to the front.
struct BentAorta {
  double bend_mm = 60.0;
  Vec3 centre(double s) const {
    const double angle = s / bend_mm;
    return {0.0, bend_mm * (1.0 - std::cos(angle)) - 20.0, 5.0 + bend_mm * std::sin(angle)};
  }
  double distance(const Vec3& at) const {
    const double y = at.y() + 20.0 - bend_mm, z = at.z() - 5.0;
    const double ring = std::hypot(y, z);
    return std::hypot(ring - bend_mm, at.x()) - aorta_radius;
  }
  /// Straight tubes of 40 mm from the axis outwards.
  static double artery(const Vec3& at, const Vec3& from, const Vec3& direction) {
    const double s = std::clamp((at - from).dot(direction), 0.0, 40.0);
    return (at - from - s * direction).norm() - 1.6;
  }
  Vec3 left_from() const { return centre(25.0); }
  Vec3 left_direction() const { return Vec3(0.9, 0.0, 0.43).normalized(); }
  Vec3 right_from() const { return centre(22.0); }
  Vec3 right_direction() const { return Vec3(-0.4, -0.9, 0.1).normalized(); }
  double hu(const Vec3& at) const {
    const double d = std::min({distance(at), artery(at, left_from(), left_direction()),
                               artery(at, right_from(), right_direction())});
    return fat_hu + (contrast_hu - fat_hu) * ramp(d, 1.0);
  }
};

imaging::ImageVolume bent_image(double spacing_mm = 0.8) {
  const BentAorta aorta;
  return made_image(50.0, 80.0, spacing_mm, [&](const Vec3& at) { return aorta.hu(at); });
}

TEST(Aorta, IsFollowedAroundABend) {
  const BentAorta truth;
  const Aorta aorta = find_aorta(bent_image());
  ASSERT_GT(aorta.stations.size(), 30U);
  EXPECT_NEAR(aorta.lumen_hu, contrast_hu, 5.0);
  for (const AortaStation& station : aorta.stations) {
    EXPECT_LT(std::abs(truth.distance(station.centre) + aorta_radius), 1.0) << station.centre.transpose();
    EXPECT_NEAR(station.radius_mm, aorta_radius, 1.0);
    EXPECT_GT(station.tangent.z() + station.tangent.y(), 0.7) << "away from the heart";
  }
  double length = 0.0;
  for (std::size_t i = 1; i < aorta.stations.size(); ++i)
    length += (aorta.stations[i].centre - aorta.stations[i - 1].centre).norm();
  EXPECT_GT(length, 60.0);  // of 94, of which the image's border cuts off both ends
}

TEST(Ostia, AreWhereTheArteriesPassTheWall) {
  const BentAorta truth;
  const imaging::ImageVolume image = bent_image(0.6);
  const std::vector<Ostium> ostia = find_ostia(image, find_aorta(image));
  ASSERT_EQ(ostia.size(), 2U);
  for (const Ostium& ostium : ostia) {
    const bool left = ostium.place.x() > 0.0;
    const Vec3 from = left ? truth.left_from() : truth.right_from();
    const Vec3 direction = left ? truth.left_direction() : truth.right_direction();
    const Vec3 away = ostium.place - from;
    EXPECT_LT((away - away.dot(direction) * direction).norm(), 0.8) << (left ? "left" : "right");
    EXPECT_NEAR(truth.distance(ostium.place), 0.0, 0.7);
    EXPECT_GT(ostium.direction.dot(direction), 0.95);
    EXPECT_NEAR(ostium.radius_mm, 1.6, 0.5);
    EXPECT_GT(ostium.reach_mm, 18.0);
    EXPECT_NEAR(ostium.section_mm2, 8.0, 3.0);  // pi 1.6^2
  }
  EXPECT_NE(ostia[0].place.x() > 0.0, ostia[1].place.x() > 0.0);
}

TEST(Ostia, AChamberThatTouchesIsNone) {
  const BentAorta aorta;
  const auto image = made_image(50.0, 80.0, 0.8, [&](const Vec3& at) {
    const double chamber = (at - aorta.centre(25.0) - Vec3(31.0, 0.0, 0.0)).norm() - 18.0;
    return fat_hu + (contrast_hu - fat_hu) * ramp(std::min(aorta.distance(at), chamber), 1.0);
  });
  EXPECT_TRUE(find_ostia(image, find_aorta(image)).empty());
}

TEST(Aorta, TheDescendingOneIsNotTakenForIt) {
  // Alone in the image, with the left lung on its left and behind it.
  const auto image = made_image(40.0, 60.0, 1.0, [](const Vec3& at) {
    const double around = at.x() > -10.0 && at.y() > -10.0 ? -850.0 : 40.0;
    return around + (contrast_hu - around) * ramp(std::hypot(at.x(), at.y()) - 11.0);
  });
  try {
    find_aorta(image);
    FAIL() << "found one";
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), HasSubstr("descending"));
    EXPECT_THAT(error.what(), HasSubstr("by its two ends"));
  }
}

TEST(Aorta, ThereIsNoneInNoiseOrWithoutContrast) {
  std::mt19937 random(7);
  std::normal_distribution<double> hu(100.0, 300.0);
  const auto noise = made_image(60.0, 60.0, 1.5, [&](const Vec3&) { return hu(random); });
  EXPECT_THROW(find_aorta(noise), GeometryError);
  const BentAorta aorta;
  const auto native = made_image(50.0, 80.0, 1.5, [&](const Vec3& at) { return 0.1 * aorta.hu(at); });
  try {
    find_aorta(native);
    FAIL() << "found one";
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no upright tube of contrast"));
  }
}

TEST(Aorta, TheSameForAnyNumberOfThreads) {
  const imaging::ImageVolume image = bent_image(1.0);
  core::set_max_threads(1);
  const Aorta alone = find_aorta(image);
  core::set_max_threads(3);
  const Aorta together = find_aorta(image);
  core::set_max_threads(0);
  ASSERT_EQ(alone.stations.size(), together.stations.size());
  for (std::size_t i = 0; i < alone.stations.size(); ++i)
    EXPECT_EQ(alone.stations[i].centre, together.stations[i].centre);
}

TEST(Aorta, RefusesOptionsOutOfRangeAndStopsWhenTold) {
  const imaging::ImageVolume image = bent_image(2.0);
  AortaOptions options;
  options.smallest_radius_mm = 30.0;
  EXPECT_THROW(find_aorta(image, options), InvalidInput);
  OstiaOptions ostia;
  ostia.level = 0.9;
  EXPECT_THROW(find_ostia(image, find_aorta(image), ostia), InvalidInput);
  EXPECT_THROW(find_ostia(image, Aorta{}), InvalidInput);
  EXPECT_THROW(find_aorta(imaging::ImageVolume{}), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(find_aorta(image, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::coronary
