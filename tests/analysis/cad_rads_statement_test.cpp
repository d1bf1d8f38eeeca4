// The tables of CAD-RADS 2.0 (Cury et al. 2022), row by row.

#include "ostia/analysis/cad_rads.h"
#include "ostia/analysis/scct_segments.h"
#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ostia::analysis {
namespace {

TEST(PlaqueBurden, FollowsTheSegmentInvolvementScore) {
  const std::pair<std::pair<int, int>, PlaqueBurden> rows[] = {{{0, 0}, PlaqueBurden::none},
                                                               {{1, 2}, PlaqueBurden::p1},
                                                               {{3, 4}, PlaqueBurden::p2},
                                                               {{5, 7}, PlaqueBurden::p3},
                                                               {{8, 18}, PlaqueBurden::p4}};
  for (const auto& [range, burden] : rows)
    for (int n = range.first; n <= range.second; ++n) EXPECT_EQ(burden_by_segments(n), burden) << n;
  EXPECT_THROW(burden_by_segments(-1), InvalidInput);
  EXPECT_THROW(burden_by_segments(19), InvalidInput);
}

TEST(PlaqueBurden, FollowsTheCalciumScore) {
  const std::pair<double, PlaqueBurden> rows[] = {{0.0, PlaqueBurden::none},  {0.2, PlaqueBurden::p1},
                                                  {1.0, PlaqueBurden::p1},    {100.0, PlaqueBurden::p1},
                                                  {101.0, PlaqueBurden::p2},  {300.0, PlaqueBurden::p2},
                                                  {301.0, PlaqueBurden::p3},  {999.0, PlaqueBurden::p3},
                                                  {1000.0, PlaqueBurden::p4}, {5000.0, PlaqueBurden::p4}};
  for (const auto& [score, burden] : rows) EXPECT_EQ(burden_by_calcium(score), burden) << score;
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(burden_by_calcium(bad), InvalidInput) << bad;
}

TEST(PlaqueBurden, FollowsTheEye) {
  using enum PlaqueAmount;
  const std::pair<std::array<PlaqueAmount, 3>, PlaqueBurden> rows[] = {
      {{none, none, none}, PlaqueBurden::none},   {{mild, none, none}, PlaqueBurden::p1},
      {{mild, mild, none}, PlaqueBurden::p1},     {{mild, mild, mild}, PlaqueBurden::p2},
      {{none, moderate, none}, PlaqueBurden::p2}, {{moderate, moderate, none}, PlaqueBurden::p2},
      {{moderate, mild, mild}, PlaqueBurden::p2}, {{moderate, moderate, moderate}, PlaqueBurden::p3},
      {{severe, none, none}, PlaqueBurden::p3},   {{mild, severe, moderate}, PlaqueBurden::p3},
      {{severe, severe, none}, PlaqueBurden::p4}, {{severe, severe, severe}, PlaqueBurden::p4}};
  for (const auto& [amounts, burden] : rows)
    EXPECT_EQ(burden_by_sight(amounts), burden) << to_string(amounts[0]) << to_string(amounts[1]);
}

TEST(PlaqueBurden, HasWordsThatAreReadBack) {
  for (const PlaqueBurden one : {PlaqueBurden::none, PlaqueBurden::p1, PlaqueBurden::p4})
    EXPECT_EQ(plaque_burden(to_string(one)), one);
  EXPECT_EQ(description(PlaqueBurden::p4), "extensive");
  EXPECT_THROW(plaque_burden("P5"), InvalidInput);
  for (const PlaqueAmount one :
       {PlaqueAmount::none, PlaqueAmount::mild, PlaqueAmount::moderate, PlaqueAmount::severe})
    EXPECT_EQ(plaque_amount(to_string(one)), one);
  EXPECT_THROW(plaque_amount("much"), InvalidInput);
}

CadRadsStatement stated(CadRads category, bool not_diagnostic = false) {
  CadRadsStatement statement;
  statement.category = {category, not_diagnostic};
  return statement;
}

TEST(CadRadsStatement, IsWrittenInItsOrder) {
  EXPECT_EQ(to_string(stated(CadRads::zero)), "0");
  CadRadsStatement one = stated(CadRads::four_a);
  one.burden = PlaqueBurden::p3;
  one.high_risk_plaque = true;
  one.ischaemia = Ischaemia::positive;
  EXPECT_EQ(to_string(one), "4A/P3/HRP/I+");
  one.category.not_diagnostic = one.stent = one.graft = one.exception = true;
  one.ischaemia = Ischaemia::negative;
  EXPECT_EQ(to_string(one), "4A/P3/N/HRP/I-/S/G/E");
  one.category.category.reset();  // N is the category, and said once
  one.ischaemia = Ischaemia::borderline;
  EXPECT_EQ(to_string(one), "N/P3/HRP/I\u00b1/S/G/E");
}

TEST(CadRadsStatement, EveryModifierHasItsSign) {
  const std::pair<CadRadsStatement, const char*> rows[] = {
      {{{CadRads::two, false}, PlaqueBurden::p1, false, Ischaemia::not_tested, false, false, false}, "2/P1"},
      {{{CadRads::three, true}, PlaqueBurden::none, false, Ischaemia::not_tested, false, false, false},
       "3/N"},
      {{{CadRads::one, false}, PlaqueBurden::p2, true, Ischaemia::not_tested, false, false, false},
       "1/P2/HRP"},
      {{{CadRads::three, false}, PlaqueBurden::p1, false, Ischaemia::borderline, false, false, false},
       "3/P1/I\u00b1"},
      {{{CadRads::five, false}, PlaqueBurden::p2, false, Ischaemia::not_tested, true, false, false},
       "5/P2/S"},
      {{{CadRads::four_b, false}, PlaqueBurden::p4, false, Ischaemia::not_tested, false, true, false},
       "4B/P4/G"},
      {{{CadRads::zero, false}, PlaqueBurden::none, false, Ischaemia::not_tested, false, false, true},
       "0/E"}};
  for (const auto& [statement, text] : rows) EXPECT_EQ(to_string(statement), text);
}

TEST(CadRadsStatement, IschaemiaIsByTheFfr) {
  const std::pair<double, Ischaemia> rows[] = {{0.40, Ischaemia::positive},   {0.75, Ischaemia::positive},
                                               {0.76, Ischaemia::borderline}, {0.80, Ischaemia::borderline},
                                               {0.81, Ischaemia::negative},   {1.00, Ischaemia::negative}};
  for (const auto& [ffr, said] : rows) EXPECT_EQ(ischaemia_of_ffr(ffr), said) << ffr;
  for (const double bad : {-0.1, 1.3, std::nan("")}) EXPECT_THROW(ischaemia_of_ffr(bad), InvalidInput) << bad;
  for (const Ischaemia one :
       {Ischaemia::not_tested, Ischaemia::negative, Ischaemia::borderline, Ischaemia::positive})
    EXPECT_EQ(ischaemia(to_string(one)), one);
  EXPECT_THROW(ischaemia("yes"), InvalidInput);
}

TEST(CadRadsStatement, NamesTheNextInvestigationOfEachRow) {
  const std::pair<CadRads, const char*> rows[] = {
      {CadRads::zero, "none"},
      {CadRads::one, "none"},
      {CadRads::two, "none"},
      {CadRads::three, "functional assessment can be considered"},
      {CadRads::four_a, "invasive angiography or functional assessment can be considered"},
      {CadRads::four_b, "invasive angiography is recommended"},
      {CadRads::five,
       "invasive angiography, functional assessment or assessment of viability can be considered"}};
  for (const auto& [category, next] : rows) EXPECT_EQ(further_investigation({category, false}), next);
  EXPECT_EQ(further_investigation({std::nullopt, true}), "additional or other evaluation may be needed");
}

std::vector<VesselSegment> segments_numbered(const std::vector<int>& numbers) {
  std::vector<VesselSegment> all;
  for (const int number : numbers) {
    VesselSegment one;
    one.aha = aha_segments()[static_cast<std::size_t>(number - 1)];
    all.push_back(one);
  }
  return all;
}

TEST(Dominance, IsByTheArteryThatSuppliesTheBack) {
  const std::pair<std::vector<int>, Dominance> rows[] = {{{1, 2, 3, 4, 16, 6, 11}, Dominance::right},
                                                         {{1, 2, 3, 4, 6, 11, 18}, Dominance::codominant},
                                                         {{4, 15}, Dominance::codominant},
                                                         {{1, 6, 11, 13, 15, 18}, Dominance::left},
                                                         {{1, 2, 3, 6, 11}, Dominance::unknown},
                                                         {{}, Dominance::unknown}};
  for (const auto& [numbers, dominance] : rows)
    EXPECT_EQ(dominance_of(segments_numbered(numbers)), dominance) << to_string(dominance);
  for (const Dominance one : {Dominance::unknown, Dominance::right, Dominance::left, Dominance::codominant})
    EXPECT_EQ(dominance(to_string(one)), one);
  EXPECT_THROW(dominance("both"), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
