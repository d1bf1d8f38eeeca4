#include "ostia/analysis/stenosis.h"
#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::analysis {
namespace {

TEST(CadRads, FollowsTheTableForOneStenosis) {
  const std::pair<double, CadRads> table[] = {
      {0.0, CadRads::zero},    {-4.0, CadRads::zero},  {0.4, CadRads::zero},    {1.0, CadRads::one},
      {24.4, CadRads::one},    {25.0, CadRads::two},   {49.0, CadRads::two},    {49.6, CadRads::three},
      {50.0, CadRads::three},  {69.4, CadRads::three}, {70.0, CadRads::four_a}, {99.0, CadRads::four_a},
      {99.9, CadRads::four_a}, {100.0, CadRads::five}};
  for (const auto& [percent, category] : table) EXPECT_EQ(cad_rads(percent), category) << percent;
  EXPECT_THROW(cad_rads(101.0), InvalidInput);
  EXPECT_THROW(cad_rads(std::nan("")), InvalidInput);
}

TEST(CadRads, OfAPatientCountsLeftMainAndThreeVessels) {
  using All = std::vector<GradedStenosis>;
  EXPECT_EQ(cad_rads(All{}), CadRads::zero);
  EXPECT_EQ(cad_rads(All{{"LAD", 30.0}, {"RCA", 55.0}}), CadRads::three);
  EXPECT_EQ(cad_rads(All{{"LM", 49.0}}), CadRads::two);
  EXPECT_EQ(cad_rads(All{{"LM", 50.0}}), CadRads::four_b);
  EXPECT_EQ(cad_rads(All{{"LAD", 75.0}, {"LCX", 71.0}}), CadRads::four_a);
  EXPECT_EQ(cad_rads(All{{"LAD", 75.0}, {"LAD", 80.0}, {"LCX", 71.0}}), CadRads::four_a);
  EXPECT_EQ(cad_rads(All{{"LAD", 75.0}, {"LCX", 71.0}, {"RCA", 70.0}}), CadRads::four_b);
  EXPECT_EQ(cad_rads(All{{"LAD", 75.0}, {"LCX", 71.0}, {"RCA", 69.0}}), CadRads::four_a);
  EXPECT_EQ(cad_rads(All{{"LM", 60.0}, {"RCA", 100.0}}), CadRads::five);
}

TEST(CadRads, WithWhatCannotBeJudgedIsNOrHasN) {
  const auto shown = [](const std::vector<GradedStenosis>& stenoses, bool all_judged) {
    return to_string(patient_category(stenoses, all_judged));
  };
  EXPECT_EQ(shown({}, true), "0");
  EXPECT_EQ(shown({{"LAD", 30.0}}, true), "2");
  EXPECT_EQ(shown({}, false), "N");
  EXPECT_EQ(shown({{"LAD", 49.0}}, false), "N");  // there may be worse
  EXPECT_EQ(shown({{"LAD", 50.0}}, false), "3/N");
  EXPECT_EQ(shown({{"LM", 60.0}}, false), "4B/N");
  EXPECT_EQ(shown({{"RCA", 100.0}}, false), "5/N");
  EXPECT_EQ(description(patient_category({}, false)), "Not diagnostic: obstructive disease is not excluded");
  EXPECT_EQ(description(patient_category({{"LAD", 30.0}}, true)), description(CadRads::two));
}

TEST(CadRads, HasWords) {
  EXPECT_EQ(to_string(CadRads::zero), "0");
  EXPECT_EQ(to_string(CadRads::four_a), "4A");
  EXPECT_EQ(to_string(CadRads::four_b), "4B");
  EXPECT_EQ(to_string(CadRads::five), "5");
  EXPECT_EQ(description(CadRads::two), "Mild stenosis (25-49 %)");
  EXPECT_THROW(to_string(static_cast<CadRads>(17)), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
