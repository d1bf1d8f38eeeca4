#include "ostia/motion/r_peaks.h"

#include "made_ecg.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::motion {
namespace {

/// Each beat found once, within `within_s`, and nothing else.
void expect_beats(const MadeEcg& ecg, const std::vector<std::size_t>& peaks, double within_s) {
  ASSERT_EQ(peaks.size(), ecg.r_times.size());
  for (std::size_t k = 0; k < peaks.size(); ++k)
    EXPECT_NEAR(static_cast<double>(peaks[k]) / ecg.rate, ecg.r_times[k], within_s) << "beat " << k;
}

TEST(RPeaks, AreFoundAtEveryRateOfBeatsAndSamples) {
  for (const double rate : {128.0, 250.0, 360.0, 1000.0, 2000.0})
    for (const double interval : {0.35, 0.6, 1.0, 1.6}) {
      SCOPED_TRACE(::testing::Message() << rate << " Hz, " << interval << " s");
      MadeEcg ecg;
      ecg.rate = rate;
      ecg.beats(40, [&](std::size_t) { return interval; });
      expect_beats(ecg, r_peaks(ecg.lead(), rate), 1.01 / rate);
    }
}

TEST(RPeaks, AreFoundAmongNoiseHumWanderAndTallTWaves) {
  MadeEcg ecg;
  ecg.noise_mv = 0.05;
  ecg.hum_mv = 0.05;
  ecg.wander_mv = 0.8;
  ecg.t_mv = 0.9;
  ecg.beats(120, [](std::size_t k) { return 0.8 + 0.1 * std::sin(static_cast<double>(k)); });
  expect_beats(ecg, r_peaks(ecg.lead(), ecg.rate), 0.01);
  ecg.r_mv = -1.0;  // the lead's poles exchanged
  ecg.t_mv = -0.4;
  expect_beats(ecg, r_peaks(ecg.lead(), ecg.rate), 0.01);
}

TEST(RPeaks, AreFollowedWhenTheSignalGetsSmaller) {
  MadeEcg ecg;
  ecg.beats(100, [](std::size_t) { return 0.9; });
  std::vector<double> lead = ecg.lead();
  for (std::size_t i = lead.size() / 2; i < lead.size(); ++i) lead[i] *= 0.4;
  expect_beats(ecg, r_peaks(lead, ecg.rate), 0.003);
}

TEST(RPeaks, AreTheMiddleOfWhatIsCutOff) {
  MadeEcg ecg;
  ecg.r_mv = 3.0;
  ecg.rate = 500.0;
  ecg.beats(60, [](std::size_t) { return 0.7; });
  std::vector<double> lead = ecg.lead();
  RPeakDetector detector(ecg.rate);
  bool clipped = false;
  for (double& value : lead) {
    value = std::min(value, 0.9);
    detector.push(value);
    clipped = clipped || detector.signal() == EcgSignal::clipped;
  }
  EXPECT_TRUE(clipped);
  expect_beats(ecg, r_peaks(lead, ecg.rate), 0.005);
}

TEST(RPeaks, NeitherGapsNorFlatLinesAreBeats) {
  for (const bool missing : {true, false}) {
    MadeEcg ecg;
    ecg.noise_mv = 0.01;
    ecg.beats(60, [](std::size_t) { return 0.8; });
    std::vector<double> lead = ecg.lead();
    const double from = ecg.r_times[20] + 0.4, to = ecg.r_times[30] + 0.4;
    EcgSignal said = EcgSignal::good;
    RPeakDetector detector(ecg.rate);
    for (std::size_t i = 0; i < lead.size(); ++i) {
      const double t = static_cast<double>(i) / ecg.rate;
      if (t > from && t < to) lead[i] = missing ? std::numeric_limits<double>::quiet_NaN() : -0.02;
      detector.push(lead[i]);
      if (t > to - 0.1 && t < to) said = detector.signal();
    }
    EXPECT_EQ(said, missing ? EcgSignal::missing : EcgSignal::flat);
    EXPECT_EQ(detector.signal(), EcgSignal::good);
    std::erase_if(ecg.r_times, [&](double t) { return t > from && t < to; });
    expect_beats(ecg, r_peaks(lead, ecg.rate), 0.003);
  }
}

TEST(RPeaks, AreFoundAfterABadStart) {
  for (const bool flat : {true, false}) {
    MadeEcg ecg;
    ecg.beats(75, [](std::size_t) { return 0.8; });
    std::vector<double> lead = ecg.lead();
    if (flat)
      std::fill_n(lead.begin(), 3 * 360, lead[0]);
    else  // plugged in after a second
      for (std::size_t i = 0; i < 360; ++i) lead[i] = -20.0;
    RPeakDetector detector(ecg.rate);
    std::vector<double> found;
    for (const double value : lead)
      if (const auto peak = detector.push(value))
        found.push_back(static_cast<double>(peak->sample) / ecg.rate);
    std::erase_if(found, [](double t) { return t < 12.0; });
    std::erase_if(ecg.r_times, [](double t) { return t < 12.0; });
    ASSERT_EQ(found.size(), ecg.r_times.size()) << flat;
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], ecg.r_times[k], 0.003);
  }
}

TEST(RPeaks, AreToldSoon) {
  MadeEcg ecg;
  ecg.beats(50, [](std::size_t) { return 0.8; });
  RPeakDetector detector(ecg.rate);
  std::size_t told = 0;
  const std::vector<double> lead = ecg.lead();
  for (std::size_t i = 0; i < lead.size(); ++i) {
    const auto peak = detector.push(lead[i]);
    if (!peak) continue;
    ++told;
    EXPECT_EQ(peak->told_at, i);
    EXPECT_LE(static_cast<double>(i - peak->sample) / ecg.rate, detector.latency_s());
  }
  EXPECT_GE(told, 47U);  // the first two seconds are for learning
  EXPECT_LT(detector.latency_s(), 0.1);
}

TEST(RPeaks, ASignalWithoutBeatsHasNone) {
  EXPECT_TRUE(r_peaks(std::vector<double>(10000, 0.3), 360.0).empty());
  EXPECT_TRUE(r_peaks({}, 360.0).empty());
  EXPECT_TRUE(r_peaks(std::vector<double>(5000, std::numeric_limits<double>::quiet_NaN()), 360.0).empty());
  EXPECT_THROW(RPeakDetector(20.0), InvalidInput);
  EXPECT_THROW(RPeakDetector(std::numeric_limits<double>::quiet_NaN()), InvalidInput);
  EXPECT_THROW(clearest_lead({}), InvalidInput);
}

TEST(RPeaks, TheClearestLeadIsTheOneWithTheLeastNoise) {
  geometry::EcgRecord record;
  record.samples_per_second = 360.0;
  for (const double noise : {0.2, 0.01, 0.1}) {
    MadeEcg ecg;
    ecg.noise_mv = noise;
    ecg.beats(40, [](std::size_t) { return 0.8; });
    record.leads.push_back({"", "mV", ecg.lead()});
  }
  EXPECT_EQ(clearest_lead(record), 1U);
}

}  // namespace
}  // namespace ostia::motion
