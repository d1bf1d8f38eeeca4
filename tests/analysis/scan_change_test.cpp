// Lesions that grew, shrank, calcified, went, came, or did not change, by amounts that are known beforehand.

#include "two_scans.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

namespace ostia::analysis {
namespace {

using ::testing::Contains;
using testing::healthy_mm;
using testing::heart_tree;
using testing::HeartOptions;
using ::testing::IsEmpty;
using testing::known_motion;
using testing::MadeLesion;
using testing::moved_heart;
using testing::pi;
using testing::plaque_mm;
using testing::scanned;

Repeatability small_table() {
  Repeatability table;
  for (auto& scope : table.spreads)
    for (DifferenceSpread& one : scope) one.sd = 1.0 / 1.96;  // 1 mm, mm^2, mm^3, ... is told
  table.of(ChangeScope::lesion, ChangeMeasure::least_area).sd = 0.2 / 1.96;
  return table;
}

ScanChangeOptions with_table() {
  ScanChangeOptions options;
  options.repeatability = small_table();
  return options;
}

double made_area(double share) {
  const double diameter = healthy_mm * (1.0 - share);
  return 0.25 * pi * diameter * diameter;
}

const LesionChange& lesion_of(const ScanChange& change, const std::string& vessel) {
  for (const LesionChange& one : change.lesions)
    if (one.vessel_name == vessel) return one;
  throw InvalidInput("no lesion on " + vessel);
}

/// Of plaque between outer walls of 1.5 + 1.2 mm and a lumen of 3 mm, per mm.
constexpr double plaque_mm2 =
    pi * ((0.5 * healthy_mm + plaque_mm) * (0.5 * healthy_mm + plaque_mm) - 0.25 * healthy_mm * healthy_mm);

TEST(ScanChange, LesionsAreFollowed) {
  const MadeLesion grew{2, 45.0, 8.0, 0.3}, stays{3, 30.0, 8.0, 0.4}, went{4, 45.0, 6.0, 0.35},
      came{1, 30.0, 8.0, 0.5};
  MadeLesion larger = grew;
  larger.share = 0.5;
  larger.length_mm = 10.0;
  const ScanChange change = compare_scans(scanned(heart_tree(), {grew, stays, went}, false),
                                          scanned(heart_tree(moved_heart()), {came, larger, stays}, false),
                                          known_motion(), with_table());
  ASSERT_EQ(change.lesions.size(), 4u);
  EXPECT_THAT(change.unmatched, IsEmpty());
  const LesionChange& on_lad = lesion_of(change, "LAD");
  EXPECT_EQ(on_lad.fate, LesionFate::both);
  const Difference area = of(on_lad.change, ChangeMeasure::least_area);
  EXPECT_NEAR(*area.before, made_area(0.3), 0.01);
  EXPECT_NEAR(*area.after, made_area(0.5), 0.01);
  EXPECT_EQ(area.verdict(), ChangeVerdict::less);
  EXPECT_NEAR(*of(on_lad.change, ChangeMeasure::stenosis).change(), 20.0, 0.2);
  EXPECT_NEAR(*of(on_lad.change, ChangeMeasure::length).change(), 2.0, 1e-9);
  EXPECT_EQ(of(on_lad.change, ChangeMeasure::plaque).verdict(), ChangeVerdict::not_known);
  const LesionChange& on_lcx = lesion_of(change, "LCX");
  EXPECT_EQ(on_lcx.fate, LesionFate::both);
  for (const ChangeMeasure measure : {ChangeMeasure::least_diameter, ChangeMeasure::least_area,
                                      ChangeMeasure::stenosis, ChangeMeasure::length}) {
    EXPECT_EQ(of(on_lcx.change, measure).verdict(), ChangeVerdict::unchanged) << key_of(measure);
    EXPECT_NEAR(*of(on_lcx.change, measure).change(), 0.0, 0.02);
  }
  const LesionChange& on_d1 = lesion_of(change, "D1");
  EXPECT_EQ(on_d1.fate, LesionFate::gone);
  EXPECT_NEAR(*of(on_d1.change, ChangeMeasure::least_area).before, made_area(0.35), 0.02);
  EXPECT_NEAR(*of(on_d1.change, ChangeMeasure::least_area).after, made_area(0.0), 0.01)
      << "its place is measured where it was";
  const LesionChange& on_rca = lesion_of(change, "RCA");
  EXPECT_EQ(on_rca.fate, LesionFate::appeared);
  EXPECT_NEAR(*of(on_rca.change, ChangeMeasure::least_area).before, made_area(0.0), 0.01);
  EXPECT_NEAR(*of(on_rca.change, ChangeMeasure::stenosis).after, 50.0, 0.3);
}

TEST(ScanChange, PlaqueVolumesAreThoseThatWereMade) {
  MadeLesion before{2, 45.0, 8.0, 0.0, 40.0, 48.0, 60.0}, grown = before, calcified = before;
  grown.plaque_to_mm = 52.0;
  grown.length_mm = 8.0;
  calcified.hu = 500.0;
  const auto at_first = scanned(heart_tree(), {before});
  const auto grew =
      compare_scans(at_first, scanned(heart_tree(moved_heart()), {grown}), known_motion(), with_table());
  // The lesion's stretch ends at 49 mm: the vessel has what grew beyond it.
  const auto vessel = std::ranges::find(grew.vessels, std::string("LAD"), &PlacedChange::label);
  ASSERT_NE(vessel, grew.vessels.end());
  const Difference plaque = of(vessel->change, ChangeMeasure::plaque);
  EXPECT_NEAR(*plaque.before, 8.0 * plaque_mm2, 0.03 * 8.0 * plaque_mm2);
  EXPECT_NEAR(*plaque.change(), 4.0 * plaque_mm2, 0.05 * 4.0 * plaque_mm2);
  EXPECT_EQ(plaque.verdict(), ChangeVerdict::more);
  EXPECT_NEAR(*of(grew.patient, ChangeMeasure::plaque).change(), *plaque.change(), 0.5);
  EXPECT_EQ(of(grew.patient, ChangeMeasure::least_area).verdict(), ChangeVerdict::not_known);

  const auto hardened =
      compare_scans(at_first, scanned(heart_tree(moved_heart()), {calcified}), known_motion(), with_table());
  ASSERT_EQ(hardened.lesions.size(), 1u);
  const StretchChange& change = hardened.lesions[0].change;
  EXPECT_EQ(of(change, ChangeMeasure::plaque).verdict(), ChangeVerdict::unchanged);
  EXPECT_EQ(of(change, ChangeMeasure::calcified).verdict(), ChangeVerdict::more);
  EXPECT_EQ(of(change, ChangeMeasure::fibrofatty).verdict(), ChangeVerdict::less);
  EXPECT_NEAR(*of(change, ChangeMeasure::calcified).change(),
              -*of(change, ChangeMeasure::fibrofatty).change(), 0.5);
  EXPECT_EQ(of(change, ChangeMeasure::remodelling).verdict(), ChangeVerdict::unchanged);
  EXPECT_EQ(of(change, ChangeMeasure::burden).verdict(), ChangeVerdict::unchanged);
}

TEST(ScanChange, AnUnchangedPatientHasNoChange) {
  const std::vector<MadeLesion> made{{1, 40.0, 8.0, 0.4, 36.0, 44.0, 60.0}, {2, 20.0, 6.0, 0.3, 17.0, 23.0}};
  HeartOptions other = moved_heart();
  other.lad_mm = 74.0;  // followed less far
  const ScanChange change = compare_scans(scanned(heart_tree(), made), scanned(heart_tree(other), made),
                                          known_motion(), with_table());
  const auto unchanged = [](const StretchChange& one, const std::string& where) {
    for (const ChangeMeasure measure : change_measures)
      EXPECT_TRUE(of(one, measure).verdict() == ChangeVerdict::unchanged ||
                  of(one, measure).verdict() == ChangeVerdict::not_known)
          << where << ", " << key_of(measure) << " by " << of(one, measure).change().value_or(0.0);
  };
  ASSERT_EQ(change.lesions.size(), 2u);
  for (const LesionChange& one : change.lesions) {
    EXPECT_EQ(one.fate, LesionFate::both);
    unchanged(one.change, "lesion on " + one.vessel_name);
    EXPECT_TRUE(of(one.change, ChangeMeasure::plaque).change());
  }
  for (const PlacedChange& one : change.vessels) unchanged(one.change, one.label);
  unchanged(change.patient, "patient");
  const auto lad = std::ranges::find(change.vessels, std::string("LAD"), &PlacedChange::label);
  ASSERT_NE(lad, change.vessels.end());
  EXPECT_LT(lad->covered_share, 0.97);
  EXPECT_GT(lad->covered_share, 0.85);
}

TEST(ScanChange, TheLeftMainIsOneWhoeverOwnsIt) {
  HeartOptions other = moved_heart();
  other.circumflex_first = true;
  const MadeLesion before{2, 6.0, 4.0, 0.3};
  MadeLesion after = before;
  after.vessel = 3;
  const ScanChange change = compare_scans(scanned(heart_tree(), {before}),
                                          scanned(heart_tree(other), {after}), known_motion(), with_table());
  ASSERT_EQ(change.lesions.size(), 1u);
  EXPECT_EQ(change.lesions[0].fate, LesionFate::both);
  EXPECT_NEAR(*of(change.lesions[0].change, ChangeMeasure::least_area).change(), 0.0, 0.01);
}

TEST(ScanChange, WhatATreeDoesNotReachIsNeitherNewNorGone) {
  auto after = heart_tree(moved_heart());
  after.vessels.pop_back();
  after.segments.pop_back();
  after.nodes.pop_back();
  const ScanChange change = compare_scans(scanned(heart_tree(), {{4, 45.0, 6.0, 0.4}}, false),
                                          scanned(after, {}, false), known_motion(), with_table());
  ASSERT_EQ(change.lesions.size(), 1u);
  EXPECT_EQ(change.lesions[0].fate, LesionFate::after_unseen);
  EXPECT_FALSE(change.lesions[0].after_stretch);
  EXPECT_EQ(of(change.lesions[0].change, ChangeMeasure::least_area).verdict(), ChangeVerdict::not_known);
  EXPECT_THAT(change.unmatched, Contains("D1 is in the former tree alone"));
}

TEST(ScanChange, TwoLesionsThatGrewTogetherAreOneChange) {
  const std::vector<MadeLesion> two{{2, 44.0, 6.0, 0.3}, {2, 52.0, 6.0, 0.3}};
  const ScanChange change =
      compare_scans(scanned(heart_tree(), two, false),
                    scanned(heart_tree(moved_heart()), {{2, 48.0, 14.0, 0.5}}, false), known_motion());
  ASSERT_EQ(change.lesions.size(), 1u);
  EXPECT_EQ(change.lesions[0].before.size(), 2u);
  EXPECT_NEAR(change.lesions[0].before_stretch->from_mm, 41.0, 0.1);
  EXPECT_NEAR(change.lesions[0].before_stretch->to_mm, 55.0, 0.1);
}

TEST(Repeatability, TheSmallestRealDifferenceGrowsWithTheSize) {
  Repeatability table;
  table.of(ChangeScope::lesion, ChangeMeasure::plaque) = {3.0, 0.04};
  EXPECT_NEAR(*table.smallest_real(ChangeScope::lesion, ChangeMeasure::plaque, 100.0), 1.96 * 5.0, 1e-12);
  EXPECT_FALSE(table.smallest_real(ChangeScope::patient, ChangeMeasure::plaque, 100.0));
  const Difference within = difference(95.0, 104.0, ChangeScope::lesion, ChangeMeasure::plaque, table);
  EXPECT_EQ(within.verdict(), ChangeVerdict::unchanged);
  EXPECT_EQ(difference(95.0, 115.0, ChangeScope::lesion, ChangeMeasure::plaque, table).verdict(),
            ChangeVerdict::more);
  EXPECT_EQ(difference(95.0, {}, ChangeScope::lesion, ChangeMeasure::plaque, table).verdict(),
            ChangeVerdict::not_known);
}

TEST(ScanChange, BadOptionsAreRefused) {
  ScanChangeOptions options;
  options.least_covered = 0.0;
  EXPECT_THROW(validate(options), InvalidInput);
  options = {};
  options.repeatability.of(ChangeScope::lesion, ChangeMeasure::plaque).sd = -1.0;
  EXPECT_THROW(validate(options), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
