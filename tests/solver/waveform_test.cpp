#include "ostia/solver/waveform.h"

#include "solver_test_support.h"

namespace ostia::solver {
namespace {

FlowWaveform wave(int samples) {
  FlowWaveform w;
  w.period_s = 0.8;
  for (int i = 0; i < samples; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / samples;
    w.time_s.push_back(w.period_s * i / samples);
    w.flow_ml_s.push_back(1.5 + 0.6 * std::cos(angle) - 0.25 * std::sin(3.0 * angle));
  }
  return w;
}

TEST(Waveform, HarmonicsAreThoseOfTheCurve) {
  const FlowHarmonics harmonics = harmonics_of(wave(2000), 4);
  EXPECT_NEAR(harmonics.mean_ml_s, 1.5, 1e-9);
  EXPECT_LT(std::abs(harmonics.amplitude_ml_s[0] - 0.6), 1e-5);
  EXPECT_LT(std::abs(harmonics.amplitude_ml_s[1]), 1e-9);
  EXPECT_LT(std::abs(harmonics.amplitude_ml_s[2] - std::complex<double>(0.0, 0.25)), 1e-5);
  EXPECT_NEAR(harmonics.flow_ml_s(0.0), 2.1, 1e-4);
  EXPECT_NEAR(harmonics.flow_ml_s(0.8), 2.1, 1e-4);  // periodic
}

TEST(Waveform, UnevenSamplesAreJoinedStraight) {
  // A triangle of height 2 from 0.1 to 0.5 s with its top at 0.2 s.
  const FlowWaveform w{{0.0, 0.1, 0.2, 0.5}, {0.0, 0.0, 2.0, 0.0}, 1.0, false};
  EXPECT_NEAR(mean_flow(w), 0.4, 1e-12);
  const FlowHarmonics harmonics = harmonics_of(w, 60);
  EXPECT_NEAR(harmonics.flow_ml_s(0.35), 1.0, 0.01);
  EXPECT_NEAR(harmonics.flow_ml_s(0.8), 0.0, 0.01);
  EXPECT_NEAR(harmonics.largest_flow_ml_s(), 2.0, 0.06);
}

TEST(Waveform, TheModelCurvesHaveTheirMeanAndPeaks) {
  for (const auto& [name, ratio] : {std::pair("coronary-left", 2.0), std::pair("coronary-right", 1.2)}) {
    const FlowWaveform w = builtin_waveform(name);
    EXPECT_TRUE(w.relative);
    EXPECT_NEAR(mean_flow(w), 1.0, 1e-12);
    double systole = 0.0, diastole = 0.0;
    for (std::size_t i = 0; i < w.time_s.size(); ++i)
      (w.time_s[i] < 0.36 * w.period_s ? systole : diastole) =
          std::max(w.time_s[i] < 0.36 * w.period_s ? systole : diastole, w.flow_ml_s[i]);
    EXPECT_NEAR(diastole / systole, ratio, 0.02) << name;
    // Twelve harmonics are enough.
    const FlowHarmonics harmonics = harmonics_of(w, 12);
    for (std::size_t i = 0; i < w.time_s.size(); ++i)
      EXPECT_NEAR(harmonics.flow_ml_s(w.time_s[i]), w.flow_ml_s[i], 0.01);
  }
  expect_refusal([] { builtin_waveform("aorta"); }, {"aorta", "coronary-left", "coronary-right"});
}

TEST(Waveform, RefusesWhatIsNoCycle) {
  const auto refused = [](const FlowWaveform& w, const std::string& part) {
    expect_refusal([&] { validate(w); }, {part});
  };
  refused({{0.0, 0.1}, {1.0, 1.0}, 1.0, false}, "three samples");
  refused({{0.0, 0.2, 0.1}, {1.0, 1.0, 1.0}, 1.0, false}, "sample 3");
  refused({{0.0, 0.1, 1.0}, {1.0, 1.0, 1.0}, 1.0, false}, "within one period");
  refused({{0.0, 0.1, 0.2}, {1.0, -1.0, -1.0}, 1.0, false}, "mean flow");
  refused({{0.0, 0.1, 0.2}, {1.0, NAN, 1.0}, 1.0, false}, "not finite");
  refused({{0.0, 0.1, 0.2}, {1.0, 1.0, 1.0}, 0.0, false}, "period");
  expect_refusal([] { harmonics_of(wave(10), 0); }, {"harmonics"});
}

}  // namespace
}  // namespace ostia::solver
