#include "ostia/evaluation/stenosis_detection.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace ostia::evaluation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Lesion lesion(const std::string& vessel, double from, double to, double grade) {
  return {vessel, from, to, 0.5 * (from + to), grade};
}

TEST(LesionDetection, TheSameLesionsAgree) {
  const std::vector<Lesion> lesions{lesion("LAD", 10, 20, 0.6), lesion("RCA", 5, 9, 0.3),
                                    lesion("RCA", 40, 52, 0.8)};
  const LesionDetection d = detect_lesions(lesions, lesions);
  EXPECT_EQ(d.all.true_positive, 2u) << "the 30 % lesion is below the threshold";
  EXPECT_EQ(d.all.false_negative + d.all.false_positive, 0u);
  EXPECT_EQ(d.all.sensitivity(), 1.0);
  EXPECT_EQ(d.all.ppv(), 1.0);
  EXPECT_EQ(d.mean_grade_difference, 0.0);
  EXPECT_EQ(d.mean_throat_distance_mm, 0.0);
  EXPECT_EQ(d.weighted_kappa, 1.0);
  EXPECT_EQ(d.pairs.size(), 3u);
}

TEST(LesionDetection, EveryLesionCountsOnce) {
  const std::vector<Lesion> reference{lesion("LAD", 10, 20, 0.60), lesion("LAD", 30, 40, 0.70),
                                      lesion("RCA", 5, 15, 0.48), lesion("LCX", 0, 10, 0.90)};
  const std::vector<Lesion> found{lesion("LAD", 12, 22, 0.55), lesion("RCA", 6, 14, 0.52),
                                  lesion("LCX", 20, 30, 0.90), lesion("LAD", 31, 41, 0.40)};
  const LesionDetection d = detect_lesions(reference, found);
  EXPECT_EQ(d.all.true_positive, 1u);   // LAD 10
  EXPECT_EQ(d.all.false_negative, 2u);  // LAD 30 graded 40 %, LCX elsewhere
  EXPECT_EQ(d.all.false_positive, 2u);  // RCA 48 -> 52 %, LCX 20
  EXPECT_DOUBLE_EQ(d.all.sensitivity(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(d.all.ppv(), 1.0 / 3.0);
  EXPECT_THAT(d.missed, ElementsAre(3u));
  EXPECT_THAT(d.unexplained, ElementsAre(2u));
  ASSERT_EQ(d.pairs.size(), 3u);
  EXPECT_DOUBLE_EQ(d.pairs[0].overlap_mm, 8.0);
  EXPECT_EQ(d.pairs[1].found, 3u);
  EXPECT_NEAR(d.mean_grade_difference, (0.05 + 0.30 + 0.04) / 3.0, 1e-12);
  EXPECT_NEAR(d.rms_grade_difference, std::sqrt((0.0025 + 0.09 + 0.0016) / 3.0), 1e-12);
  EXPECT_NEAR(d.mean_throat_distance_mm, (2.0 + 1.0 + 0.0) / 3.0, 1e-12);
  EXPECT_EQ(d.by_vessel.at("LAD").true_positive, 1u);
  EXPECT_EQ(d.by_vessel.at("LCX").false_negative, 1u);
  EXPECT_EQ(d.by_vessel.at("LCX").false_positive, 1u);
  EXPECT_TRUE(std::isnan(d.by_vessel.at("RCA").sensitivity())) << "nothing to find there";
  EXPECT_EQ(d.by_vessel.at("RCA").ppv(), 0.0);
}

TEST(LesionDetection, PairsAreOneToOneByTheLargestShare) {
  // One long found lesion covers two; it goes to the one it shares more with.
  const std::vector<Lesion> reference{lesion("LAD", 10, 14, 0.6), lesion("LAD", 15, 25, 0.6)};
  const LesionDetection d = detect_lesions(reference, {lesion("LAD", 10, 25, 0.6)});
  ASSERT_EQ(d.pairs.size(), 1u);
  EXPECT_EQ(d.pairs[0].reference, 1u);
  EXPECT_THAT(d.missed, ElementsAre(0u));
  EXPECT_EQ(d.all.false_negative, 1u);
  const LesionDetection touching = detect_lesions({lesion("LAD", 10, 20, 0.6)}, {lesion("LAD", 20, 30, 0.6)});
  EXPECT_THAT(touching.pairs, IsEmpty()) << "lesions that only touch do not overlap";
}

TEST(LesionDetection, AHealthyHeartHasNoSensitivity) {
  const LesionDetection none = detect_lesions({}, {});
  EXPECT_TRUE(std::isnan(none.all.sensitivity()));
  EXPECT_TRUE(std::isnan(none.weighted_kappa));
  EXPECT_TRUE(std::isnan(none.mean_grade_difference));
  const LesionDetection alarm = detect_lesions({}, {lesion("LAD", 0, 1, 0.7)});
  EXPECT_TRUE(std::isnan(alarm.all.sensitivity()));
  EXPECT_EQ(alarm.all.ppv(), 0.0);
}

TEST(LesionDetection, BadInputIsNamed) {
  const auto refused = [](const Lesion& bad, const std::string& why) {
    try {
      detect_lesions({lesion("LAD", 10, 20, 0.6)}, {bad});
      ADD_FAILURE() << "taken: " << why;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("found lesion 0"));
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  };
  refused(lesion("", 1, 2, 0.5), "names no vessel");
  refused(lesion("LAD", 2, 2, 0.5), "must lie behind its start");
  refused(lesion("LAD", std::numeric_limits<double>::quiet_NaN(), 2, 0.5), "must lie behind its start");
  refused({"LAD", 1, 2, 3, 0.5}, "outside its stretch");
  refused(lesion("LAD", 1, 2, 60.0), "share in [0, 1]");
  EXPECT_THROW(detect_lesions({}, {}, 0.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
