#include "ostia/geometry/carm_angles.h"

#include <gtest/gtest.h>

namespace ostia::geometry {
namespace {

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT((a - b).norm(), 1e-12) << a.transpose() << " | " << b.transpose();
}

TEST(CarmAngles, StandWhereTheLaboratorySays) {
  expect_near(towards_receptor({0, 0}), -Vec3::UnitY());  // in front of the patient
  expect_near(towards_receptor({90, 0}), Vec3::UnitX());  // at the patient's left
  expect_near(towards_receptor({-90, 0}), -Vec3::UnitX());
  expect_near(towards_receptor({0, 90}), Vec3::UnitZ());  // at the head
  expect_near(receptor_up({35, 0}), Vec3::UnitZ());
  expect_near(receptor_up({0, 90}), Vec3::UnitY());
}

TEST(CarmAngles, MakeAFrameAtAnyAngle) {
  for (const double lao : {-170.0, -30.0, 0.0, 45.0, 120.0})
    for (const double cranial : {-90.0, -25.0, 10.0, 89.0}) {
      const Vec3 towards = towards_receptor({lao, cranial}), up = receptor_up({lao, cranial});
      EXPECT_NEAR(towards.norm(), 1.0, 1e-12);
      EXPECT_NEAR(up.norm(), 1.0, 1e-12);
      EXPECT_NEAR(towards.dot(up), 0.0, 1e-12);
      EXPECT_GE(up.z(), -1e-12);
    }
}

}  // namespace
}  // namespace ostia::geometry
