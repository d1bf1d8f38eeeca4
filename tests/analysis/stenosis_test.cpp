// Narrowings that were put in beforehand.

#include "ostia/analysis/stenosis.h"

#include "walls.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::analysis {
namespace {

using testing::bump;
using testing::circle_from;
using testing::pi;
using testing::profile_of;

std::vector<Stenosis> found(const LumenProfile& profile, const std::vector<double>& branches = {},
                            const StenosisOptions& options = {}) {
  return find_stenoses(profile, reference_line(profile, branches), options);
}

double taper(double s) {
  return 1.9 - 0.008 * s;
}

TEST(FindStenoses, MeasuresAConcentricNarrowingOfASolvedWall) {
  for (const double severity : {0.3, 0.55, 0.75}) {
    const auto vessel = testing::straight(
        70.0, [&](double s, double) { return taper(s) * (1.0 - severity * bump(s, 35.0, 14.0)); });
    const auto all = found(vessel.profile());
    ASSERT_EQ(all.size(), 1u) << severity;
    const Stenosis& one = all.front();
    EXPECT_EQ(one.vessel, vessel.first());
    EXPECT_NEAR(one.diameter_percent, 100.0 * severity, 3.0);
    EXPECT_NEAR(one.area_percent, 100.0 * (1.0 - std::pow(1.0 - severity, 2)), 3.5);
    EXPECT_NEAR(one.throat_mm, 35.0, 0.6);
    EXPECT_NEAR(one.least_diameter_mm, 2.0 * taper(35.0) * (1.0 - severity), 0.06);
    EXPECT_NEAR(one.least_area_mm2, 0.25 * pi * std::pow(one.least_diameter_mm, 2), 1e-9);
    EXPECT_NEAR(one.reference_diameter_mm, 2.0 * taper(35.0), 0.08);
    // A cosine of 14 mm is narrower than a tenth over 14 (1 - 2 / pi asin(sqrt(0.1 / severity))).
    const double length = 14.0 * (1.0 - 2.0 / pi * std::asin(std::sqrt(0.1 / severity)));
    EXPECT_NEAR(one.length_mm(), length, 1.0) << severity;
    EXPECT_LT(one.proximal_mm, one.from_mm + 0.5);
    EXPECT_GT(one.distal_mm, one.to_mm - 0.5);
    EXPECT_NEAR(one.proximal_mm, 29.0, 2.5);
    EXPECT_NEAR(one.distal_mm, 41.0, 2.5);
  }
}

TEST(FindStenoses, MeasuresAnEccentricNarrowingByItsArea) {
  // Circles that move away from theta = 180 degrees as they shrink: the far wall stays where it was.
  const double severity = 0.6;
  const auto vessel = testing::straight(60.0, [&](double s, double theta) {
    const double w = severity * bump(s, 30.0, 12.0);
    return circle_from(1.6 * (1.0 - w), 1.6 * w * 0.6, theta);
  });
  const auto all = found(vessel.profile());
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all.front().diameter_percent, 60.0, 3.5);
  EXPECT_NEAR(all.front().area_percent, 84.0, 3.5);
}

TEST(FindStenoses, AgreesWithPlacesChosenByHand) {
  const auto vessel =
      testing::straight(60.0, [&](double s, double) { return taper(s) * (1.0 - 0.5 * bump(s, 30.0, 12.0)); });
  const LumenProfile profile = vessel.profile();
  const Stenosis automatic = found(profile).at(0);
  const Stenosis by_hand = stenosis_between(profile, automatic.proximal_mm, automatic.distal_mm);
  EXPECT_NEAR(by_hand.diameter_percent, automatic.diameter_percent, 2.5);
  EXPECT_NEAR(by_hand.length_mm(), automatic.length_mm(), 1.5);
  EXPECT_EQ(by_hand.throat_mm, automatic.throat_mm);
}

TEST(FindStenoses, NeitherTaperNorStepsNorEctasiasAreNarrowings) {
  EXPECT_TRUE(
      found(testing::straight(60.0, [](double s, double) { return 2.2 - 0.022 * s; }).profile()).empty());
  EXPECT_TRUE(found(profile_of(100.0, 0.5, [](double s) { return s < 30.0 ? 4.2 : 3.1; }), {30.0}).empty());
  EXPECT_TRUE(found(profile_of(100.0, 0.5, [](double s) {
                return 3.2 - 0.01 * s + 1.5 * bump(s, 50.0, 15.0);
              })).empty());
}

TEST(FindStenoses, FindsLesionsAtTheVesselsEnds) {
  const LumenProfile profile = profile_of(
      90.0, 0.5, [](double s) { return 3.5 * (1.0 - 0.6 * bump(s, 0.5, 9.0) - 0.45 * bump(s, 90.0, 10.0)); });
  const auto all = found(profile);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].from_mm, 0.0);
  EXPECT_EQ(all[0].proximal_mm, 0.0);
  EXPECT_NEAR(all[0].diameter_percent, 60.0, 3.0);
  EXPECT_EQ(all[1].to_mm, 90.0);
  EXPECT_EQ(all[1].distal_mm, 90.0);
  EXPECT_NEAR(all[1].diameter_percent, 45.0, 3.0);
}

TEST(FindStenoses, TellsTwoLesionsApart) {
  const auto two = [](double between) {
    return profile_of(100.0, 0.5, [=](double s) {
      return 3.4 *
             (1.0 - 0.5 * bump(s, 50.0 - 0.5 * between, 10.0) - 0.7 * bump(s, 50.0 + 0.5 * between, 10.0));
    });
  };
  const auto far = found(two(20.0)), near = found(two(8.0)), merged = found(two(3.5));
  ASSERT_EQ(far.size(), 2u);
  EXPECT_NEAR(far[0].diameter_percent, 50.0, 2.5);
  EXPECT_NEAR(far[1].diameter_percent, 70.0, 2.5);
  EXPECT_LT(far[0].to_mm, far[1].from_mm);
  ASSERT_EQ(near.size(), 2u);  // the lumen recovers to a fifth between them
  EXPECT_EQ(near[0].to_mm, near[1].from_mm);
  EXPECT_LT(near[0].proximal_mm, 43.0);
  EXPECT_GT(near[0].distal_mm, 57.0);
  ASSERT_EQ(merged.size(), 1u);
}

TEST(FindStenoses, AnOcclusionIsAHundredPercent) {
  const LumenProfile profile = profile_of(90.0, 0.5, [](double s) {
    const double d = 3.2 * (1.0 - 1.3 * bump(s, 40.0, 12.0));
    return d > 0.0 ? d : 0.0;
  });
  const auto all = found(profile);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].diameter_percent, 100.0);
  EXPECT_EQ(all[0].area_percent, 100.0);
  EXPECT_EQ(all[0].least_diameter_mm, 0.0);
  EXPECT_NEAR(all[0].throat_mm, 40.0, 0.5);
  EXPECT_EQ(cad_rads(all[0].diameter_percent), CadRads::five);
  EXPECT_NEAR(all[0].reference_diameter_mm, 3.2, 0.1);
  EXPECT_LT(all[0].from_mm, 36.0);
  EXPECT_GT(all[0].to_mm, 44.0);
}

TEST(FindStenoses, AWallThatDoesNotCloseIsNoOcclusion) {
  LumenProfile profile = profile_of(60.0, 0.5, [](double s) { return s > 20.0 && s < 25.0 ? 0.0 : 3.0; });
  EXPECT_EQ(found(profile).size(), 1u);
  for (SectionMeasures& section : profile.sections) section.open = !section.found;
  EXPECT_TRUE(found(profile).empty());
}

TEST(FindStenoses, LeavesOutWhatIsTooSlightOrTooShort) {
  const LumenProfile profile = profile_of(80.0, 0.25, [](double s) {
    return 3.0 * (1.0 - 0.3 * bump(s, 20.0, 12.0) - 0.4 * bump(s, 60.0, 1.2));
  });
  EXPECT_EQ(found(profile, {}, {.least_percent = 20.0, .least_length_mm = 1.0}).size(), 1u);
  EXPECT_EQ(found(profile, {}, {.least_percent = 20.0, .least_length_mm = 0.0}).size(), 2u);
  EXPECT_EQ(found(profile, {}, {.least_percent = 35.0, .least_length_mm = 0.0}).size(), 1u);
  EXPECT_TRUE(found(profile, {}, {.least_percent = 50.0}).empty());
  EXPECT_THROW(found(profile, {}, {.least_percent = 2.0}), InvalidInput);
  EXPECT_THROW(found(profile, {}, {.least_length_mm = -1.0}), InvalidInput);
  EXPECT_THROW(find_stenoses(profile, ReferenceLine{{3.0, 3.0}}), InvalidInput);
}

TEST(StenosisBetween, UsesTheTwoPlacesAlone) {
  const LumenProfile profile =
      profile_of(50.0, 0.5, [](double s) { return (4.0 - 0.02 * s) * (1.0 - 0.4 * bump(s, 25.0, 10.0)); });
  const Stenosis one = stenosis_between(profile, 15.0, 35.0);
  EXPECT_NEAR(one.reference_diameter_mm, 3.5, 1e-9);
  EXPECT_NEAR(one.diameter_percent, 40.0, 1e-6);
  const double a = std::pow(3.7, 2), b = std::pow(3.3, 2), least = std::pow(3.5 * 0.6, 2);
  EXPECT_NEAR(one.area_percent, 100.0 * (1.0 - least / (0.5 * (a + b))), 1e-6);
  EXPECT_NEAR(one.least_diameter_mm, 2.1, 1e-9);
  EXPECT_EQ(one.throat_mm, 25.0);
  EXPECT_EQ(one.proximal_mm, 15.0);
  EXPECT_EQ(one.distal_mm, 35.0);
  EXPECT_NEAR(one.length_mm(), 10.0 * (1.0 - 2.0 / pi * std::asin(std::sqrt(0.25))), 0.1);
}

TEST(StenosisBetween, HealthyPlacesHaveNone) {
  const Stenosis none =
      stenosis_between(profile_of(50.0, 0.5, [](double s) { return 4.0 - 0.02 * s; }), 10.0, 30.0);
  EXPECT_NEAR(none.diameter_percent, 0.0, 1e-6);
  EXPECT_EQ(cad_rads(none.diameter_percent), CadRads::zero);
}

TEST(StenosisBetween, RefusesWhatItCannotMeasure) {
  const LumenProfile profile =
      profile_of(50.0, 0.5, [](double s) { return s > 20.0 && s < 22.0 ? 0.0 : 3.0; });
  EXPECT_THROW(stenosis_between(profile, 10.0, 30.0), InvalidInput);
  EXPECT_THROW(stenosis_between(profile, 30.0, 29.0), InvalidInput);
  EXPECT_THROW(stenosis_between(profile, -1.0, 9.0), InvalidInput);
  EXPECT_THROW(stenosis_between(profile, 30.0, 51.0), InvalidInput);
  EXPECT_THROW(stenosis_between(profile, 30.1, 30.7), InvalidInput);
  EXPECT_THROW(stenosis_between(profile, std::nan(""), 30.7), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
