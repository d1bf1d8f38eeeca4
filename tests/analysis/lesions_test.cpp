// Narrowings and plaques that were made beforehand.

#include "ostia/analysis/lesions.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::analysis {
namespace {

using std::numbers::pi;

constexpr double made_length_mm = 60.0, made_lumen_mm = 1.5;  // radius

/// A round lumen of 3 mm that is narrowed by `share` at `at_mm`, within 4 mm of it.
double made_radius(double s, double at_mm, double share) {
  const double t = (s - at_mm) / 4.0;
  return made_lumen_mm * (1.0 - (std::abs(t) < 1.0 ? share * 0.5 * (1.0 + std::cos(pi * t)) : 0.0));
}

LumenProfile made_profile(double at_mm, double share) {
  LumenProfile profile;
  profile.vessel = 7;
  profile.length_mm = made_length_mm;
  for (double s = 0.0; s <= made_length_mm + 1e-9; s += 0.5) {
    SectionMeasures section;
    section.s_mm = s;
    section.found = true;
    section.diameter_mm = 2.0 * made_radius(s, at_mm, share);
    section.area_mm2 = 0.25 * pi * section.diameter_mm * section.diameter_mm;
    profile.sections.push_back(section);
  }
  return profile;
}

/// A wall of 0.4 mm, and of 1.2 mm on all sides from `from` to `to`.
PlaqueProfile made_plaque(double from, double to, double hu, double at_mm = 0.0, double share = 0.0) {
  geometry::Centerline line;
  for (double z = 0.0; z <= made_length_mm + 1e-9; z += 0.5) line.points.emplace_back(0.0, 0.0, z);
  geometry::complete(line, Vec3::UnitX());
  WallRadii walls;
  walls.to_mm = made_length_mm;
  walls.lumen_mm = [=](double s, double) { return made_radius(s, at_mm, share); };
  walls.outer_mm = [=](double s, double) { return made_lumen_mm + (s >= from && s <= to ? 1.2 : 0.4); };
  walls.calibre_mm = [](double) { return 2.0 * made_lumen_mm; };
  PlaqueOptions options;
  options.blur_sigma_mm = 0.0;
  return plaque_profile(
      geometry::AxisCurve(line), walls, [hu](const Vec3&) { return hu; }, options);
}

std::vector<Lesion> lesions_of(const LumenProfile& profile, const PlaqueProfile* plaque) {
  return find_lesions(profile, reference_line(profile, {}), plaque);
}

TEST(Lesions, AHealthyVesselHasNone) {
  const PlaqueProfile healthy = made_plaque(1.0, 0.0, 60.0);
  EXPECT_TRUE(lesions_of(made_profile(30.0, 0.0), &healthy).empty());
  EXPECT_TRUE(lesions_of(made_profile(30.0, 0.0), nullptr).empty());
  EXPECT_EQ(plaque_between(healthy, 0.0, 60.0).burden_percent(), 0.0);
}

TEST(Lesions, PlaqueWithoutNarrowingIsOneOfCategoryOne) {
  const PlaqueProfile plaque = made_plaque(20.0, 28.0, 60.0);
  const auto all = lesions_of(made_profile(30.0, 0.0), &plaque);
  ASSERT_EQ(all.size(), 1u);
  const Lesion& one = all.front();
  EXPECT_FALSE(one.narrows);
  EXPECT_EQ(one.stenosis.vessel, 7);
  EXPECT_NEAR(one.stenosis.from_mm, 20.0, 0.25);
  EXPECT_NEAR(one.stenosis.to_mm, 28.0, 0.25);
  EXPECT_NEAR(one.stenosis.diameter_percent, 0.0, 0.5);
  EXPECT_EQ(one.category(), CadRads::one);
  EXPECT_GE(one.graded_percent(), 1.0);
  ASSERT_TRUE(one.plaque);
  EXPECT_NEAR(one.plaque->plaque_mm3(), pi * (2.7 * 2.7 - 1.5 * 1.5) * 8.0, 6.0);
  EXPECT_EQ(plaque_type(*one.plaque), PlaqueType::non_calcified);
}

TEST(Lesions, ANarrowingOfAFewPercentIsOneWhereThereIsPlaque) {
  const LumenProfile profile = made_profile(24.0, 0.12);
  EXPECT_TRUE(lesions_of(profile, nullptr).empty());
  const PlaqueProfile plaque = made_plaque(20.0, 28.0, 800.0, 24.0, 0.12);
  const auto all = lesions_of(profile, &plaque);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all.front().stenosis.diameter_percent, 12.0, 1.0);
  EXPECT_NEAR(all.front().stenosis.throat_mm, 24.0, 0.5);
  EXPECT_EQ(all.front().category(), CadRads::one);
  EXPECT_EQ(plaque_type(*all.front().plaque), PlaqueType::calcified);
}

TEST(Lesions, PlaqueBelongsToItsNarrowingAndLongPlaqueBesideItIsOneMore) {
  const LumenProfile profile = made_profile(24.0, 0.6);
  const PlaqueProfile near_it = made_plaque(20.0, 28.0, 60.0, 24.0, 0.6);
  auto all = lesions_of(profile, &near_it);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all.front().narrows);
  EXPECT_NEAR(all.front().stenosis.diameter_percent, 60.0, 1.5);
  EXPECT_GT(all.front().plaque->plaque_mm3(), 50.0);

  const PlaqueProfile longer = made_plaque(20.0, 45.0, 60.0, 24.0, 0.6);
  all = lesions_of(profile, &longer);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(all[0].narrows);
  EXPECT_FALSE(all[1].narrows);
  EXPECT_NEAR(all[1].stenosis.from_mm, all[0].stenosis.to_mm, 1e-9);
  EXPECT_NEAR(all[1].stenosis.to_mm, 45.0, 0.25);
  EXPECT_EQ(all[1].category(), CadRads::one);
}

TEST(Lesions, AreStretchesOfPlaqueWithoutShortGapsAndSpots) {
  PlaqueProfile plaque = made_plaque(20.0, 28.0, 60.0);
  for (PlaqueSlab& slab : plaque.slabs)
    if (slab.s_mm > 23.5 && slab.s_mm < 24.25) slab.plaque_mm2 = 0.0;
  EXPECT_EQ(plaque_stretches(plaque).size(), 1u) << "a gap of 0.75 mm";
  for (PlaqueSlab& slab : plaque.slabs)
    if (slab.s_mm > 23.0 && slab.s_mm < 25.0) slab.plaque_mm2 = 0.9;  // too little to be one
  EXPECT_EQ(plaque_stretches(plaque).size(), 2u);
  const PlaqueProfile spot = made_plaque(20.0, 21.5, 60.0);
  EXPECT_TRUE(plaque_stretches(spot).empty());
  EXPECT_TRUE(plaque_stretches(PlaqueProfile{}).empty());
}

TEST(Lesions, AreNotMadeOfWhatCouldNotBeMeasured) {
  LumenProfile profile = made_profile(24.0, 0.0);
  for (SectionMeasures& section : profile.sections)
    if (section.s_mm > 19.0 && section.s_mm < 29.0) {
      section.found = false;
      section.open = true;
    }
  const PlaqueProfile plaque = made_plaque(20.0, 28.0, 60.0);
  EXPECT_TRUE(find_lesions(profile, reference_line(made_profile(24.0, 0.0), {}), &plaque).empty());
  EXPECT_THROW(find_lesions(profile, ReferenceLine{{3.0}}, &plaque), InvalidInput);
  PlaqueStretchOptions bad;
  bad.least_area_mm2 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plaque_stretches(plaque, bad), InvalidInput);
  bad = {};
  bad.gap_mm = -1.0;
  EXPECT_THROW(plaque_stretches(plaque, bad), InvalidInput);
  bad = {};
  bad.least_beside_mm = 100.0;
  EXPECT_THROW(plaque_stretches(plaque, bad), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
