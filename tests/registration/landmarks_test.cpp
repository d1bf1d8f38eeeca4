#include "ostia/registration/landmarks.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::registration {
namespace {

const Mat3 turned = Eigen::AngleAxisd(0.26, Vec3(1, 2, -1).normalized()).toRotationMatrix();
const Vec3 shifted(20, -7, 11);

std::vector<LandmarkPair> pairs_of(const Mat3& by) {
  std::vector<LandmarkPair> pairs;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(30, 5, 2), Vec3(-12, 40, 8), Vec3(7, -9, 35), Vec3(-25, -30, -15),
                        Vec3(18, 22, -28)})
    pairs.push_back({"fork " + std::to_string(pairs.size()), p, by * p + shifted});
  return pairs;
}

TEST(Landmarks, TheMotionIsFoundExactly) {
  const LandmarkFit fit = rigid_from_landmarks(pairs_of(turned));
  EXPECT_LT((fit.transform.linear() - turned).norm(), 1e-12);
  EXPECT_LT((fit.transform.offset_mm() - shifted).norm(), 1e-11);
  EXPECT_LT(fit.max_mm, 1e-11);
}

TEST(Landmarks, AWrongPairIsLeftOut) {
  std::vector<LandmarkPair> pairs = pairs_of(turned);
  pairs[3].moving_mm += Vec3(0, 40, 0);
  const LandmarkFit fit = rigid_from_landmarks(pairs);
  EXPECT_LT((fit.transform(Vec3(30, 5, 2)) - pairs[1].moving_mm).norm(), 1e-10);
  EXPECT_THAT(fit.used, testing::ElementsAre(true, true, true, false, true, true));
  EXPECT_NEAR(fit.residuals_mm[3], 40.0, 1e-9);
  EXPECT_LT(fit.max_mm, 1e-10);
}

TEST(Landmarks, NoMoreThanAShareIsLeftOut) {
  std::vector<LandmarkPair> pairs = pairs_of(turned);
  for (int i = 0; i < 3; ++i) pairs[i].moving_mm += Vec3(30.0 * i - 20.0, 25.0, 15.0 * i);
  const LandmarkFit fit = rigid_from_landmarks(pairs);
  EXPECT_GE(std::count(fit.used.begin(), fit.used.end(), true), 4);
}

TEST(Landmarks, AMirroredScanIsTold) {
  try {
    rigid_from_landmarks(pairs_of(turned * Vec3(-1, 1, 1).asDiagonal()));
    FAIL() << "not refused";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("mirror"));
  }
}

TEST(Landmarks, TooFewOrOnALineAreRefused) {
  std::vector<LandmarkPair> pairs = pairs_of(turned);
  EXPECT_THROW(rigid_from_landmarks({pairs[0], pairs[1]}), InvalidInput);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].fixed_mm = Vec3(1, 2, 3) * static_cast<double>(i);
    pairs[i].moving_mm = pairs[i].fixed_mm + shifted;
  }
  EXPECT_THROW(rigid_from_landmarks(pairs), InvalidInput);
  pairs = pairs_of(turned);
  pairs[2].moving_mm.x() = NAN;
  EXPECT_THROW(rigid_from_landmarks(pairs), InvalidInput);
  EXPECT_THROW(rigid_from_landmarks(pairs_of(turned), {.outlier_mm = 0.0}), InvalidInput);
}

}  // namespace
}  // namespace ostia::registration
