#include "ostia/phantom/sections.h"

#include "hand_made_tree.h"

#include "ostia/core/error.h"
#include "ostia/phantom/phantom_case.h"

#include <gmock/gmock.h>

#include <cmath>

namespace ostia::phantom {
namespace {

using geometry::Health;
using testing::hand_made_tree;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

SectionOptions wanted(int healthy, double healthy_mm, int diseased, double diseased_mm) {
  SectionOptions options;
  options.quota = {healthy, diseased, healthy_mm, diseased_mm};
  return options;
}

TEST(Sections, FreeStretchesEndWhereVesselsMeet) {
  const CoronaryTree tree = hand_made_tree();
  const std::vector<Stretch> main = free_stretches(tree, 0);
  ASSERT_THAT(main, SizeIs(2));
  EXPECT_NEAR(main[0].from_mm, 3.0, 1e-9) << "clear of the ostium";
  // The branch leaves at 60 degrees: outer walls of 2.25 and 1.6 mm part where the axes are 3.85 mm apart.
  EXPECT_NEAR(main[0].to_mm, 50.0 - 3.9, 0.6);
  EXPECT_NEAR(main[1].from_mm, 52.2 + 3.1, 2.0);
  EXPECT_NEAR(main[1].to_mm, 118.0, 1e-9);
  const std::vector<Stretch> branch = free_stretches(tree, 1);
  ASSERT_THAT(branch, SizeIs(1));
  EXPECT_NEAR(branch[0].from_mm, 3.85 / std::sin(60.0 * std::numbers::pi / 180.0), 0.6);
}

TEST(Sections, TheImageCutsThem) {
  const CoronaryTree tree = hand_made_tree();
  imaging::Geometry image;
  image.size = {200, 80, 80};
  image.spacing = Vec3::Constant(0.5);
  image.origin = Vec3(-20.0, -20.0, -20.0);  // to x = 79.5
  const std::vector<Stretch> main = free_stretches(tree, 0, image, 1.0);
  ASSERT_THAT(main, SizeIs(2));
  EXPECT_NEAR(main[1].to_mm, 79.5 - 1.0 - tree.vessels[0].wall.max_at(76.0), 0.3);
}

TEST(Sections, QuotaIsMetAndKeptApart) {
  const CoronaryTree tree = hand_made_tree();
  const SectionPlan plan = plan_sections(tree, wanted(3, 80.0, 1, 24.0));
  EXPECT_THAT(plan.warnings, IsEmpty());
  ASSERT_THAT(plan.sections, SizeIs(4));
  double healthy = 0.0, diseased = 0.0;
  for (std::size_t i = 0; i < plan.sections.size(); ++i) {
    const AnnotatedSection& one = plan.sections[i];
    EXPECT_EQ(one.key, "s0" + std::to_string(i + 1));
    (one.health == Health::healthy ? healthy : diseased) += one.length_mm();
    bool inside = false;
    for (const Stretch& free : free_stretches(tree, one.vessel))
      inside = inside || (one.s_from_mm >= free.from_mm - 1e-9 && one.s_to_mm <= free.to_mm + 1e-9);
    EXPECT_TRUE(inside) << one.key;
    if (i > 0 && plan.sections[i - 1].vessel == one.vessel) {
      EXPECT_GE(one.s_from_mm, plan.sections[i - 1].s_to_mm);
    }
    if (one.health == Health::diseased) {
      EXPECT_LE(one.s_from_mm, 80.0);
      EXPECT_GE(one.s_to_mm, 100.0);
    } else {
      EXPECT_EQ(
          disease_at(tree.vessels[static_cast<std::size_t>(one.vessel)], 0.5 * (one.s_from_mm + one.s_to_mm)),
          0.0);
    }
  }
  EXPECT_NEAR(healthy, 80.0, 1e-6);
  EXPECT_NEAR(diseased, 24.0, 1e-6);
}

TEST(Sections, WhatTheTreeCannotGiveIsSaid) {
  const SectionPlan plan = plan_sections(hand_made_tree(), wanted(3, 900.0, 2, 60.0));
  ASSERT_THAT(plan.warnings, SizeIs(2));
  EXPECT_THAT(plan.warnings[0], HasSubstr("900.0 mm"));
  EXPECT_THAT(plan.warnings[1], HasSubstr("diseased sections: 1"));
}

TEST(Sections, MissingLesionsAreAskedForWhereSectionsFit) {
  const CoronaryTree tree = hand_made_tree();
  EXPECT_THAT(missing_lesions(tree, wanted(2, 60.0, 1, 24.0)), IsEmpty());
  const std::vector<LesionSite> sites = missing_lesions(tree, wanted(1, 20.0, 2, 48.0));
  ASSERT_THAT(sites, SizeIs(1));
  EXPECT_NEAR(sites[0].length_mm, 0.75 * 24.0, 1e-9);
  CoronaryTree healed = tree;
  healed.vessels[0].stenoses.clear();
  EXPECT_THAT(missing_lesions(healed, wanted(1, 20.0, 2, 48.0)), SizeIs(2));
}

TEST(Sections, SuiteQuotasAddUp) {
  for (const std::uint64_t first : {0ull, 1ull, 7ull, 1000ull}) {
    int count = 0;
    double healthy = 0.0, diseased = 0.0;
    for (std::uint64_t seed = first; seed < first + 18; ++seed) {
      const SectionQuota quota = section_quota(seed);
      count += quota.healthy + quota.diseased;
      healthy += quota.healthy_mm;
      diseased += quota.diseased_mm;
    }
    EXPECT_EQ(count, 78);
    EXPECT_NEAR(healthy, 1880.0, 1e-6);
    EXPECT_NEAR(diseased, 670.0, 1e-6);
  }
}

TEST(Sections, SuiteOfEighteenHasTheLengthsOfTheExperiment) {
  int count = 0;
  double healthy = 0.0, diseased = 0.0;
  for (std::uint64_t seed = 1; seed <= 18; ++seed) {
    CaseOptions options;
    options.seed = seed;
    const CasePlan plan = plan_case(options);
    count += static_cast<int>(plan.sections.sections.size());
    for (const AnnotatedSection& one : plan.sections.sections)
      (one.health == Health::healthy ? healthy : diseased) += one.length_mm();
  }
  EXPECT_EQ(count, 78);
  EXPECT_NEAR(healthy, 1880.0, 0.03 * 1880.0);
  EXPECT_NEAR(diseased, 670.0, 0.03 * 670.0);
}

TEST(Sections, BadOptionsAreRefused) {
  EXPECT_THROW(plan_sections(hand_made_tree(), wanted(-1, 0.0, 0, 0.0)), InvalidInput);
  EXPECT_THROW(plan_sections(hand_made_tree(), wanted(1, -3.0, 0, 0.0)), InvalidInput);
  SectionOptions options = wanted(1, 10.0, 0, 0.0);
  options.least_length_mm = 0.0;
  EXPECT_THROW(plan_sections(hand_made_tree(), options), InvalidInput);
  EXPECT_THROW(vessel_of(hand_made_tree(), 99), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
