#include "ostia/geometry/carm_words.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::geometry {
namespace {

TEST(CarmWords, WhatIsWrittenIsReadAgain) {
  for (int lao = -180; lao <= 180; lao += 15)
    for (int cranial = -90; cranial <= 90; cranial += 10) {
      const CarmAngles angles{static_cast<double>(lao), static_cast<double>(cranial)};
      const CarmAngles again = carm_angles(text_of(angles));
      EXPECT_EQ(again.lao_deg, angles.lao_deg) << text_of(angles);
      EXPECT_EQ(again.cranial_deg, angles.cranial_deg) << text_of(angles);
    }
}

TEST(CarmWords, AreThoseOfTheLaboratory) {
  EXPECT_EQ(text_of({30.0, 20.0}), "LAO 30 CRA 20");
  EXPECT_EQ(text_of({-30.4, -24.6}), "RAO 30 CAU 25");
  EXPECT_EQ(text_of({0.0, -20.0}), "CAU 20");
  EXPECT_EQ(text_of({0.3, -0.3}), "AP");
  EXPECT_EQ(text_of({90.0, 0.0}), "LAO 90");
}

TEST(CarmWords, StandWhereTheySay) {
  EXPECT_LT((towards_receptor(carm_angles("LAO 90")) - Vec3::UnitX()).norm(), 1e-12) << "the patient's left";
  EXPECT_LT((towards_receptor(carm_angles("lat")) - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((towards_receptor(carm_angles("RAO90")) + Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((towards_receptor(carm_angles("AP")) + Vec3::UnitY()).norm(), 1e-12) << "in front";
  EXPECT_LT((towards_receptor(carm_angles("CRA 90")) - Vec3::UnitZ()).norm(), 1e-12) << "at the head";
  EXPECT_LT((towards_receptor(carm_angles("AP, CAU 90")) + Vec3::UnitZ()).norm(), 1e-12);
}

TEST(CarmWords, WhatIsNoAngleIsRefused) {
  for (const char* text : {"", "LAO", "LAO-30", "LAO 181", "CRA 91", "LAO 30 RAO 20", "30 20", "LAO 30x",
                           "CRA 20 LAO 30", "LAO nan", "LAO 1e2"})
    EXPECT_THROW(carm_angles(text), UsageError) << text;
}

}  // namespace
}  // namespace ostia::geometry
