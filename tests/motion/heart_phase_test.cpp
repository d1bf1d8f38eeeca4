#include "ostia/motion/heart_phase.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ostia::motion {
namespace {

TEST(HeartPhase, OfARegularHeartIsTheShareOfTheInterval) {
  HeartPhase heart(0.05);
  EXPECT_EQ(heart.at(0.0).source, PhaseSource::waiting);
  heart.beat(1.0);
  EXPECT_EQ(heart.at(1.5).source, PhaseSource::waiting);
  for (int k = 1; k < 30; ++k) {
    heart.beat(1.0 + 0.8 * k);
    for (const double share : {0.0, 0.25, 0.75, 0.99}) {
      const HeartPhaseNow now = heart.at(1.0 + 0.8 * (k + share));
      EXPECT_NEAR(now.phase, share, 1e-9);
      EXPECT_EQ(now.source, PhaseSource::following);
      EXPECT_NEAR(now.interval_s, 0.8, 1e-9);
      EXPECT_TRUE(now.regular);
    }
  }
}

TEST(HeartPhase, RunsOnHoldsAndCoastsWithoutABeat) {
  HeartPhase heart(0.08);
  for (int k = 0; k < 20; ++k) heart.beat(k);
  const auto at = [&](double since) { return heart.at(19.0 + since); };
  EXPECT_NEAR(at(1.05).phase, 0.05, 1e-9);  // it may have come and is not told yet
  EXPECT_EQ(at(1.05).source, PhaseSource::following);
  EXPECT_NEAR(at(1.3).phase, 0.08, 1e-9);
  EXPECT_EQ(at(1.3).source, PhaseSource::holding);
  EXPECT_NEAR(at(1.7).phase, 0.7, 1e-9);
  EXPECT_EQ(at(1.7).source, PhaseSource::coasting);
  EXPECT_NEAR(at(9.25).phase, 0.25, 1e-9);

  heart.beat(28.0);  // after the gap, which is no interval
  EXPECT_NEAR(heart.at(28.5).phase, 0.5, 1e-9);
  EXPECT_EQ(heart.at(28.5).source, PhaseSource::following);
}

TEST(HeartPhase, IsContinuousWhenALateBeatIsTold) {
  HeartPhase heart(0.08);
  for (int k = 0; k < 20; ++k) heart.beat(k);
  const double before = heart.at(20.2 + 0.08).phase;
  heart.beat(20.2);
  EXPECT_NEAR(heart.at(20.2 + 0.08).phase, before, 1e-3);
}

TEST(HeartPhase, APrematureBeatChangesNoExpectation) {
  HeartPhase heart(0.0);
  double t = 0.0;
  for (int k = 0; k < 30; ++k) heart.beat(t += 0.8);
  heart.beat(t += 0.5);  // premature, and the pause after it
  EXPECT_FALSE(heart.at(t).regular);
  EXPECT_NEAR(heart.at(t).interval_s, 0.8, 1e-6);
  heart.beat(t += 1.1);
  EXPECT_NEAR(heart.at(t).interval_s, 0.8, 1e-6);
  heart.beat(t += 0.8);
  EXPECT_TRUE(heart.at(t).regular);
}

TEST(HeartPhase, FollowsANewRateAfterThreeBeats) {
  HeartPhase heart(0.0);
  double t = 0.0;
  for (int k = 0; k < 30; ++k) heart.beat(t += 1.0);
  for (int k = 0; k < 3; ++k) heart.beat(t += 0.6);
  EXPECT_NEAR(heart.at(t).interval_s, 0.6, 0.01);
}

TEST(HeartPhase, FollowsARateThatFallsAtOnce) {
  HeartPhase heart(0.0);
  double t = 0.0;
  for (int k = 0; k < 30; ++k) heart.beat(t += 0.33);
  for (int k = 0; k < 7; ++k) heart.beat(t += 0.92);
  EXPECT_NEAR(heart.at(t).interval_s, 0.92, 0.01);
}

// Alternating intervals tell a model of order 8 little: its covariance must stay one.
TEST(RrPredictor, StaysSoundWhereIntervalsTellLittle) {
  RrPredictor predictor;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.0005);
  double worst = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const double interval = 0.8 + (k % 2 == 0 ? 0.01 : -0.01) + noise(random);
    if (k > 500) worst = std::max(worst, std::abs(*predictor.next() - interval));
    predictor.add(interval);
  }
  EXPECT_LT(worst, 0.01);
}

TEST(RrPredictor, LearnsTheBreathsRhythm) {
  RrPredictor predictor;
  const auto interval = [](int k) { return 0.9 + 0.06 * std::sin(2.0 * 3.14159265 * k / 5.3); };
  double error = 0.0;
  int count = 0;
  for (int k = 0; k < 200; ++k) {
    if (k >= 60) {
      error += std::abs(*predictor.next() - interval(k));
      ++count;
    }
    predictor.add(interval(k));
  }
  EXPECT_LT(error / count, 0.038 / 8.0);  // the mean is off by 0.06 * 2 / pi = 0.038
}

TEST(HeartPhase, RefusesTimesThatCannotBe) {
  EXPECT_THROW(HeartPhase(-0.1), InvalidInput);
  EXPECT_THROW(HeartPhase(std::nan("")), InvalidInput);
  HeartPhase heart(0.0);
  heart.beat(1.0);
  EXPECT_THROW(heart.beat(1.0), InvalidInput);
  EXPECT_THROW(heart.beat(std::nan("")), InvalidInput);
  RrPredictor predictor;
  EXPECT_THROW(predictor.add(0.0), InvalidInput);
  EXPECT_FALSE(predictor.next());
}

}  // namespace
}  // namespace ostia::motion
