#include "disc_fit.h"

#include "made_image.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::coronary {
namespace {

using ostia::testing::made_image;
using ostia::testing::ramp;

constexpr double muscle_hu = 60.0, disc_fit_contrast_hu = 400.0;

double in_column(const Vec3& at, double x, double y, double radius_mm) {
  return ramp(std::hypot(at.x() - x, at.y() - y) - radius_mm);
}

TEST(DiscFit, MeasuresAColumnFromAPlaceOffItsMiddle) {
  for (const double radius : {9.0, 14.0, 21.0}) {
    SCOPED_TRACE(radius);
    const auto image = made_image(40.0, 10.0, 1.5, [&](const Vec3& at) {
      return muscle_hu + (disc_fit_contrast_hu - muscle_hu) * in_column(at, 3.0, -2.0, radius);
    });
    const Vec3 off(3.0 + 0.4 * radius, -2.0 - 0.3 * radius, 5.0);
    const auto disc = fit_disc(image, {off, Vec3::UnitX(), Vec3::UnitY()}, {});
    ASSERT_TRUE(disc);
    EXPECT_LT((disc->centre - Vec3(3.0, -2.0, 5.0)).norm(), 0.15);
    // An edge counts where a third of the contrast is gone, so the disc is a little smaller.
    EXPECT_NEAR(disc->radius_mm, radius - 0.2, 0.3);
    EXPECT_EQ(disc->round, 1.0);
    EXPECT_NEAR(disc->hu, disc_fit_contrast_hu, 1.0);
    EXPECT_LT(disc->sd_hu, 1.0);
  }
}

TEST(DiscFit, PassesOverAChamberThatTouches) {
  // A wider chamber as bright touches over a fifth of the circumference.
  const auto image = made_image(60.0, 6.0, 1.5, [&](const Vec3& at) {
    const double inside = std::max(in_column(at, 0.0, 0.0, 14.0), in_column(at, 37.0, 0.0, 25.0));
    return muscle_hu + (disc_fit_contrast_hu - muscle_hu) * inside;
  });
  const auto disc = fit_disc(image, {Vec3(-2.0, 1.0, 3.0), Vec3::UnitX(), Vec3::UnitY()}, {});
  ASSERT_TRUE(disc);
  EXPECT_LT((disc->centre - Vec3(0.0, 0.0, 3.0)).norm(), 0.4);
  EXPECT_NEAR(disc->radius_mm, 13.8, 0.4);
  EXPECT_LT(disc->round, 0.95);
}

TEST(DiscFit, FindsNothingInASlabOrWithoutContrast) {
  const auto slab = made_image(60.0, 6.0, 1.5, [&](const Vec3& at) {
    return muscle_hu + (disc_fit_contrast_hu - muscle_hu) * ramp(std::abs(at.x()) - 10.0);
  });
  EXPECT_FALSE(fit_disc(slab, {Vec3(0.0, 0.0, 3.0), Vec3::UnitX(), Vec3::UnitY()}, {}));
  const auto plain = made_image(30.0, 6.0, 1.5, [](const Vec3&) { return muscle_hu; });
  EXPECT_FALSE(fit_disc(plain, {Vec3(0.0, 0.0, 3.0), Vec3::UnitX(), Vec3::UnitY()}, {}));
  EXPECT_FALSE(fit_disc(plain, {Vec3(99.0, 0.0, 3.0), Vec3::UnitX(), Vec3::UnitY()}, {}));
}

}  // namespace
}  // namespace ostia::coronary
