#include "ostia/analysis/evaluability.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

namespace ostia::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double voxel_mm = 0.5, noise_hu = 25.0;

/// Forty millimetres of a good vessel of 3 mm.
std::vector<WallEvidence> good() {
  std::vector<WallEvidence> all;
  for (int i = 0; i <= 80; ++i) all.push_back({0.5 * i, true, 3.0, 400.0, 350.0, 0.95, 0.0, 0.4});
  return all;
}

/// Some of it made otherwise, from 15 to 25 mm.
template <class Spoil>
std::vector<WallEvidence> spoilt(const Spoil& spoil) {
  std::vector<WallEvidence> all = good();
  for (WallEvidence& one : all)
    if (one.s_mm >= 15.0 && one.s_mm <= 25.0) spoil(one);
  return all;
}

std::vector<EvaluableStretch> graded(const std::vector<WallEvidence>& evidence) {
  return evaluable_stretches(evidence, 0.0, 41.0, voxel_mm, noise_hu);
}

/// The grade in the middle of the spoilt part; the rest has to be good, and nothing may be missing.
EvaluableStretch middle(const std::vector<WallEvidence>& evidence) {
  const std::vector<EvaluableStretch> all = graded(evidence);
  EXPECT_EQ(all.front().from_mm, 0.0);
  EXPECT_EQ(all.back().to_mm, 41.0);
  EXPECT_EQ(all.front().grade, Evaluability::evaluable);
  EXPECT_EQ(all.back().grade, Evaluability::evaluable);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_EQ(all[i].from_mm, all[i - 1].to_mm);
  return worst_within(all, 19.9, 20.1).value();
}

TEST(Evaluability, AGoodVesselIsEvaluable) {
  const std::vector<EvaluableStretch> all = graded(good());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].grade, Evaluability::evaluable);
  EXPECT_THAT(all[0].reasons, IsEmpty());
  EXPECT_EQ(all[0].to_mm, 41.0);  // what lies behind the evidence is as its end
}

TEST(Evaluability, EachReasonIsNamed) {
  const auto clear = middle(spoilt([](WallEvidence& one) { one.clear_share = 0.2; }));
  EXPECT_EQ(clear.grade, Evaluability::not_evaluable);
  EXPECT_THAT(clear.reasons, ElementsAre(EvaluabilityReason::no_clear_edge));
  EXPECT_NEAR(clear.from_mm, 15.0, 0.5);
  EXPECT_NEAR(clear.to_mm, 25.0, 0.5);

  const auto faint = middle(spoilt([](WallEvidence& one) { one.contrast_hu = 100.0; }));
  EXPECT_EQ(faint.grade, Evaluability::limited);
  EXPECT_THAT(faint.reasons, ElementsAre(EvaluabilityReason::faint));

  const auto calcium =
      middle(spoilt([](WallEvidence& one) { one.calcium_share = 0.9, one.clear_share = 0.0; }));
  EXPECT_EQ(calcium.grade, Evaluability::not_evaluable);
  EXPECT_THAT(calcium.reasons, ElementsAre(EvaluabilityReason::calcium));

  auto moved = good();
  for (WallEvidence& one : moved)
    if (one.s_mm >= 10.0 && one.s_mm <= 30.0) one.blur_mm = 1.0;
  const auto blurred = middle(moved);
  EXPECT_EQ(blurred.grade, Evaluability::limited);
  EXPECT_THAT(blurred.reasons, ElementsAre(EvaluabilityReason::blurred));

  const auto outside = middle(spoilt([](WallEvidence& one) { one = {one.s_mm, false}; }));
  EXPECT_EQ(outside.grade, Evaluability::not_evaluable);
  EXPECT_THAT(outside.reasons, ElementsAre(EvaluabilityReason::outside_image));
}

TEST(Evaluability, CoarseVoxelsAreNoGroundForThinVessels) {
  const auto of = [](double voxel) {
    return evaluable_stretches(good(), 0.0, 40.0, voxel, noise_hu).front();
  };
  EXPECT_EQ(of(1.0).grade, Evaluability::evaluable);
  EXPECT_EQ(of(1.5).grade, Evaluability::limited);
  EXPECT_EQ(of(2.5).grade, Evaluability::not_evaluable);
  EXPECT_THAT(of(2.5).reasons, ElementsAre(EvaluabilityReason::coarse_voxels));
}

TEST(Evaluability, ANarrowingOrAnOcclusionIsNoReason) {
  // Four millimetres of lesion show less contrast, and one of occlusion nothing.
  std::vector<WallEvidence> all = good();
  for (WallEvidence& one : all) {
    if (one.s_mm >= 18.0 && one.s_mm <= 22.0) one = {one.s_mm, true, 0.8, 200.0, 80.0, 0.4, 0.0, 0.0};
    if (one.s_mm >= 19.5 && one.s_mm <= 20.5) one = {one.s_mm, true, 0.1, 60.0, 0.0, 0.0, 0.0, 0.0};
  }
  EXPECT_EQ(graded(all).size(), 1U);
  EXPECT_EQ(graded(all).front().grade, Evaluability::evaluable);
}

TEST(Evaluability, AFewRaysAreNoReason) {
  // A side branch leaves: a quarter of the rays have no edge over its calibre.
  std::vector<WallEvidence> all = good();
  for (WallEvidence& one : all)
    if (one.s_mm >= 19.0 && one.s_mm <= 21.0) one.clear_share = 0.65;
  EXPECT_EQ(graded(all).size(), 1U);
}

TEST(Evaluability, WithoutEvidenceThereAreNoStretches) {
  EXPECT_THAT(graded({}), IsEmpty());
}

TEST(Evaluability, APersonsWordIsOverThePrograms) {
  const auto all = graded(spoilt([](WallEvidence& one) { one.clear_share = 0.2; }));
  const auto now = overruled(all, {{10.0, 20.0, Evaluability::evaluable, {}, true},
                                   {38.0, 99.0, Evaluability::not_evaluable, {}, true}});
  ASSERT_EQ(now.size(), 5U);
  EXPECT_EQ(now[0].to_mm, 10.0);
  EXPECT_TRUE(now[1].by_person);
  EXPECT_EQ(now[1].grade, Evaluability::evaluable);
  EXPECT_EQ(now[2].from_mm, 20.0);
  EXPECT_EQ(now[2].grade, Evaluability::not_evaluable);
  EXPECT_FALSE(now[2].by_person);
  EXPECT_EQ(now[3].to_mm, 38.0);
  EXPECT_EQ(now[4].to_mm, 41.0);  // no farther than the vessel
  EXPECT_EQ(now[4].grade, Evaluability::not_evaluable);
  EXPECT_EQ(overruled(all, {{50.0, 60.0, Evaluability::limited, {}, true}}).size(), all.size());
}

TEST(Evaluability, TheWorstOfAPartAndShares) {
  const auto all = graded(spoilt([](WallEvidence& one) { one.clear_share = 0.2; }));
  EXPECT_EQ(worst_within(all, 0.0, 10.0)->grade, Evaluability::evaluable);
  EXPECT_EQ(worst_within(all, 0.0, 20.0)->grade, Evaluability::not_evaluable);
  EXPECT_FALSE(worst_within(all, 50.0, 60.0));
  EXPECT_NEAR(share_of(all, Evaluability::not_evaluable), 10.0 / 41.0, 0.03);
  EXPECT_EQ(share_of({}, Evaluability::evaluable), 0.0);
}

TEST(Evaluability, GradesHaveNamesAndOptionsBounds) {
  for (const Evaluability grade :
       {Evaluability::evaluable, Evaluability::limited, Evaluability::not_evaluable})
    EXPECT_EQ(evaluability(to_string(grade)), grade);
  EXPECT_THROW(evaluability("perhaps"), InvalidInput);
  EvaluabilityOptions options;
  options.least_cnr = 9.0;
  EXPECT_THROW(evaluable_stretches(good(), 0.0, 40.0, 0.5, 25.0, options), InvalidInput);
  options = {};
  options.window_mm = 0.0;
  EXPECT_THROW(validate(options), InvalidInput);
  EXPECT_THROW(evaluable_stretches(good(), 0.0, 40.0, 0.0, 25.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
