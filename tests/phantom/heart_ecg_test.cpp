#include "ostia/phantom/heart_ecg.h"

#include "ostia/core/error.h"
#include "ostia/motion/r_peaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

TEST(HeartEcg, EveryRPeakIsFoundWhereItIsSaidToBe) {
  for (const double rate : {48.0, 60.0, 72.0, 110.0}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const HeartEcg ecg = draw_ecg(rate, seed);
      ASSERT_EQ(ecg.record.leads.size(), 2u);
      ASSERT_EQ(ecg.record.samples(), 60u * 360u);
      for (const geometry::EcgLead& lead : ecg.record.leads) {
        const std::vector<std::size_t> found = motion::r_peaks(lead.values, ecg.record.samples_per_second);
        ASSERT_EQ(found.size(), ecg.beats.size()) << rate << " " << seed << " " << lead.name;
        for (std::size_t i = 0; i < found.size(); ++i)
          EXPECT_NEAR(static_cast<double>(found[i]), static_cast<double>(ecg.beats[i].sample), 2.0);
      }
    }
  }
}

TEST(HeartEcg, TheRateIsTheOneAskedForAndVaries) {
  const HeartEcg ecg = draw_ecg(60.0, 9, {.seconds = 300.0});
  const double n = static_cast<double>(ecg.beats.size() - 1);
  const double mean = static_cast<double>(ecg.beats.back().sample - ecg.beats.front().sample) / n / 360.0;
  EXPECT_NEAR(mean, 1.0, 0.01);
  double square = 0.0;
  for (std::size_t i = 1; i < ecg.beats.size(); ++i) {
    const double rr = static_cast<double>(ecg.beats[i].sample - ecg.beats[i - 1].sample) / 360.0;
    square += (rr - mean) * (rr - mean) / n;
  }
  // Two sines of 3 and 2 %, and 1 % by chance.
  EXPECT_NEAR(std::sqrt(square), std::sqrt(0.03 * 0.03 / 2 + 0.02 * 0.02 / 2 + 0.01 * 0.01), 0.005);
}

TEST(HeartEcg, HasItsWaves) {
  const HeartEcg ecg = draw_ecg(60.0, 2, {.noise_mv = 0.0});
  const std::vector<double>& lead = ecg.record.leads[0].values;
  const auto highest = [&](const geometry::EcgBeat& beat, double from_s, double to_s) {
    const auto at = lead.begin() + static_cast<std::ptrdiff_t>(beat.sample);
    return std::max_element(at + std::lround(from_s * 360), at + std::lround(to_s * 360)) - at;
  };
  for (std::size_t i = 1; i + 1 < ecg.beats.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(highest(ecg.beats[i], -0.25, -0.06)) / 360.0, -0.165, 0.02);  // P
    EXPECT_NEAR(static_cast<double>(highest(ecg.beats[i], -0.06, 0.06)), 0.0, 0.6);               // R
    EXPECT_NEAR(static_cast<double>(highest(ecg.beats[i], 0.1, 0.5)) / 360.0, 0.29, 0.03);        // T
  }
}

TEST(HeartEcg, TheSameSeedGivesTheSameSamples) {
  EXPECT_EQ(draw_ecg(60.0, 5).record.leads[1].values, draw_ecg(60.0, 5).record.leads[1].values);
  EXPECT_NE(draw_ecg(60.0, 5).record.leads[1].values, draw_ecg(60.0, 6).record.leads[1].values);
}

TEST(HeartEcg, OptionsOutOfRangeAreRefused) {
  EXPECT_THROW(draw_ecg(5.0, 1), InvalidInput);
  EXPECT_THROW(draw_ecg(60.0, 1, {.seconds = 1e9}), InvalidInput);
  EXPECT_THROW(draw_ecg(60.0, 1, {.samples_per_second = 1.0}), InvalidInput);
  EXPECT_THROW(draw_ecg(60.0, 1, {.noise_mv = std::nan("")}), InvalidInput);
  EXPECT_THROW(draw_ecg(60.0, 1, {.breathing_per_min = 0.0}), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
