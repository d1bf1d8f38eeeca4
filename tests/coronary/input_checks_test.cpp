#include "input_checks.h"

#include "made_image.h"

#include "ostia/core/error.h"
#include "ostia/coronary/extract.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace ostia::coronary {
namespace {

using ostia::testing::made_image;
using ostia::testing::ramp;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What the search says of an image in which it must find nothing.
std::string input_checks_refusal_of(const imaging::ImageVolume& image) {
  try {
    extract(image);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::bad_input) << error.what();
    return error.what();
  }
  return "found something";
}

/// A chest without a heart: lungs, chest wall and air about it, muscle between.
double chest_hu(const geometry::Vec3& at) {
  const double body = std::hypot(at.x() / 75.0, at.y() / 65.0) - 1.0;
  if (body > 0.0) return -1000.0;
  if (body > -0.1) return -100.0;
  return std::abs(at.x()) > 30.0 ? -850.0 : 45.0;
}
imaging::ImageVolume chest() {
  return made_image(80.0, 60.0, 2.0, chest_hu);
}

imaging::ImageVolume changed(imaging::ImageVolume image, double factor, double shift) {
  for (std::int16_t& voxel : image.voxels)
    voxel = static_cast<std::int16_t>(std::lround(factor * voxel + shift));
  return image;
}

TEST(InputChecks, AChestInHounsfieldUnitsPasses) {
  EXPECT_THAT(check_input(made_image(40.0, 60.0, 0.9, chest_hu)).warnings, IsEmpty());
}

TEST(InputChecks, WrongUnitsAreNamed) {
  EXPECT_THAT(input_checks_refusal_of(changed(chest(), 1.0, 1024.0)),
              HasSubstr("1024 may not have been subtracted"));
  EXPECT_THAT(input_checks_refusal_of(changed(chest(), 1.0, -1024.0)), HasSubstr("subtracted twice"));
  EXPECT_THAT(input_checks_refusal_of(changed(chest(), 1.0 / 1045.0, 1000.0 / 1045.0)),
              HasSubstr("convert it back to HU"));
  EXPECT_THAT(input_checks_refusal_of(changed(chest(), 255.0 / 1045.0, 244.0)), HasSubstr("256 grey levels"));
  EXPECT_THAT(input_checks_refusal_of(changed(chest(), 10.0, 0.0)), HasSubstr("far beyond CT numbers"));
  EXPECT_THAT(input_checks_refusal_of(changed(chest(), 0.1, 0.0)), HasSubstr("scaled"));
}

TEST(InputChecks, NoiseAndNothingAreNamed) {
  std::mt19937 random(11);
  std::normal_distribution<double> hu(100.0, 300.0);
  EXPECT_THAT(
      input_checks_refusal_of(made_image(60.0, 60.0, 1.5, [&](const geometry::Vec3&) { return hu(random); })),
      HasSubstr("the image is noise"));
  EXPECT_THAT(
      input_checks_refusal_of(made_image(60.0, 60.0, 1.5, [](const geometry::Vec3&) { return 60.0; })),
      HasSubstr("every voxel is 60"));
}

TEST(InputChecks, TooFewAndTooWideVoxelsAreNamed) {
  imaging::ImageVolume three;
  three.geometry.size = {3, 3, 3};
  three.voxels = std::vector<std::int16_t>(27, 100);
  EXPECT_THAT(input_checks_refusal_of(three), AllOf(HasSubstr("3 x 3 x 3 voxels"), HasSubstr("too small")));
  imaging::ImageVolume thick = chest();
  thick.geometry.spacing.z() = 5.0;
  EXPECT_THAT(input_checks_refusal_of(thick),
              AllOf(HasSubstr("voxels of 5.0 mm"), HasSubstr("thinner slices")));
  EXPECT_THAT(check_input(chest()).warnings, ::testing::ElementsAre(HasSubstr("voxels of 2.0 mm are wide")));
}

TEST(InputChecks, LungsThatAreTooBrightAreNoneInHounsfieldUnits) {
  EXPECT_THAT(input_checks_refusal_of(changed(chest(), 0.5, 0.0)),
              AllOf(HasSubstr("nothing in the image is darker than -500"), HasSubstr("scaled")));
}

TEST(InputChecks, LungsInFrontAndBehindAreTold) {
  EXPECT_FALSE(check_input(made_image(80.0, 60.0, 0.9, chest_hu)).turned);
  const InputNotes notes = check_input(made_image(80.0, 60.0, 0.9, [](const geometry::Vec3& at) {
    return chest_hu({at.y(), at.x(), at.z()});
  }));
  EXPECT_TRUE(notes.turned);
  EXPECT_THAT(notes.warnings, ::testing::ElementsAre(HasSubstr("x and y may be exchanged")));
}

TEST(InputChecks, MetalIsTold) {
  imaging::ImageVolume image = made_image(40.0, 60.0, 0.9, [](const geometry::Vec3& at) {
    return std::hypot(at.x() - 5.0, at.y()) < 3.0 ? 3000.0 : chest_hu(at);
  });
  EXPECT_THAT(check_input(image).warnings, ::testing::ElementsAre(HasSubstr("ml of metal")));
}

TEST(InputChecks, ARefusalSaysWhatElseIsOdd) {
  const imaging::ImageVolume image = made_image(40.0, 60.0, 0.9, [](const geometry::Vec3& at) {
    return std::hypot(at.x() - 5.0, at.y()) < 3.0 ? 3000.0 : chest_hu(at);
  });
  try {
    extract(image);
    FAIL() << "a chest without an aorta";
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no "), HasSubstr("; besides, "), HasSubstr("ml of metal")));
  }
}

/// An upright vessel with three large branches before a spine, in muscle and fat, without lungs.
double abdomen_hu(const geometry::Vec3& at) {
  if (std::hypot(at.x() / 76.0, at.y() / 66.0) > 1.0) return -1000.0;
  if (std::hypot(at.x() / 70.0, at.y() / 60.0) > 1.0) return -100.0;
  double hu = at.y() < -15.0 ? -100.0 : 50.0;
  const auto bright = [&](double distance) { hu = std::max(hu, hu + (380.0 - hu) * ramp(distance)); };
  bright(std::hypot(at.x(), at.y() - 10.0) - 10.0);
  for (const double z : {40.0, 52.0, 64.0})
    if (at.y() < 10.0) bright(std::hypot(at.x() - 0.3 * (at.y() - 10.0), at.z() - z) - 2.5);
  return hu;
}

TEST(InputChecks, AnAbdomenIsNoChestAndItsAortaNotOneOfAHeart) {
  EXPECT_THAT(input_checks_refusal_of(made_image(80.0, 90.0, 1.2, abdomen_hu)),
              AllOf(HasSubstr("no chest"), HasSubstr("draw a first vessel by its two ends")));
  // Cut so close that no lung could be expected, it has an aorta and arteries that leave it, but no heart.
  EXPECT_THAT(input_checks_refusal_of(made_image(45.0, 90.0, 1.0, abdomen_hu)),
              AllOf(HasSubstr("no heart was found below the aorta"), HasSubstr("first vessel")));
}

TEST(InputChecks, WithoutContrastItSaysWhatWasSeen) {
  const std::string said = input_checks_refusal_of(made_image(70.0, 70.0, 2.0, chest_hu));
  EXPECT_THAT(said, AllOf(HasSubstr("has 45 HU, as blood without contrast agent"),
                          HasSubstr("draw a first vessel by its two ends")));
}

TEST(InputChecks, AScanForTheCalciumScoreIsKnownByItsMissingContrast) {
  EXPECT_THAT(input_checks_refusal_of(made_image(120.0, 100.0, 3.0, chest_hu)),
              AllOf(HasSubstr("wider than coronary arteries"), HasSubstr("without contrast agent")));
  const auto bright = [](const geometry::Vec3& at) { return chest_hu(at) > 0.0 ? 300.0 : -850.0; };
  EXPECT_THAT(input_checks_refusal_of(made_image(120.0, 100.0, 3.0, bright)),
              AllOf(HasSubstr("wider than coronary arteries"), ::testing::Not(HasSubstr("contrast"))));
}

}  // namespace
}  // namespace ostia::coronary
