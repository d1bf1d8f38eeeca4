// The MIT-BIH record 100 with its 2,273 annotated beats, and twelve leads of the PTB database.

#include "shared_data.h"

#include "ostia/io/wfdb_file.h"
#include "ostia/motion/heart_phase.h"
#include "ostia/motion/r_peaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::motion {
namespace {

struct Score {
  std::size_t found = 0, missed = 0, invented = 0;
  double sensitivity() const { return static_cast<double>(found) / static_cast<double>(found + missed); }
  double predictive() const { return static_cast<double>(found) / static_cast<double>(found + invented); }
};

/// Beats that have a peak within 150 ms, each peak used once (ANSI/AAMI EC57).
Score score(const std::vector<geometry::EcgBeat>& beats, const std::vector<std::size_t>& peaks, double rate) {
  Score result;
  std::size_t k = 0;
  for (const geometry::EcgBeat& beat : beats) {
    const auto off = [&](std::size_t i) {
      return std::abs(static_cast<double>(peaks[i]) - static_cast<double>(beat.sample)) / rate;
    };
    while (k < peaks.size() && peaks[k] < beat.sample && off(k) > 0.15) ++k, ++result.invented;
    if (k < peaks.size() && off(k) <= 0.15) {
      ++result.found;
      ++k;
    } else {
      ++result.missed;
    }
  }
  result.invented += peaks.size() - k;
  return result;
}

TEST(EcgReal, FindsTheBeatsOfRecord100) {
  OSTIA_REQUIRE_SHARED(folder, "ecg");
  const auto record = io::read_wfdb(folder / "100.hea").record;
  const auto beats = io::read_wfdb_beats(folder / "100.atr");
  for (const geometry::EcgLead& lead : record.leads) {
    const Score s = score(beats, r_peaks(lead.values, record.samples_per_second), record.samples_per_second);
    std::printf("%s: %zu found, %zu missed, %zu invented\n", lead.name.c_str(), s.found, s.missed,
                s.invented);
    EXPECT_GE(s.sensitivity(), 0.998);
    EXPECT_GE(s.predictive(), 0.998);
  }
}

struct PhaseErrors {
  std::vector<double> all;
  double mean() const {
    double sum = 0.0;
    for (const double e : all) sum += e;
    return sum / static_cast<double>(all.size());
  }
  double p95() {
    std::sort(all.begin(), all.end());
    return all[all.size() * 95 / 100];
  }
};

/// Runs the record as a monitor would: each sample is taken, then the phase is asked for; errors against the
/// annotated beats around, as shares of the cycle. `beyond`: beats that are left out of the first ten.
std::pair<PhaseErrors, PhaseErrors> phase_errors(const geometry::EcgRecord& record,
                                                 const std::vector<geometry::EcgBeat>& beats) {
  const double rate = record.samples_per_second;
  RPeakDetector detector(rate);
  HeartPhase phase(detector.latency_s());
  PhaseErrors normal, ectopic;
  std::size_t k = 0;
  for (std::size_t i = 0; i < record.samples(); ++i) {
    if (const auto peak = detector.push(record.leads[0].values[i]))
      phase.beat(static_cast<double>(peak->sample) / rate);
    while (k + 1 < beats.size() && beats[k + 1].sample <= i) ++k;
    if (k < 10 || k + 1 >= beats.size() || i % 7 != 0) continue;
    const double truth =
        static_cast<double>(i - beats[k].sample) / static_cast<double>(beats[k + 1].sample - beats[k].sample);
    const double off = std::abs(phase.at(static_cast<double>(i) / rate).phase - truth);
    const bool strange = beats[k].ectopic() || beats[k + 1].ectopic();
    (strange ? ectopic : normal).all.push_back(std::min(off, 1.0 - off));
  }
  return {normal, ectopic};
}

TEST(EcgReal, FollowsThePhaseOfRecord100AsItRuns) {
  OSTIA_REQUIRE_SHARED(folder, "ecg");
  const auto record = io::read_wfdb(folder / "100.hea").record;
  auto [normal, ectopic] = phase_errors(record, io::read_wfdb_beats(folder / "100.atr"));
  std::printf(
      "normal beats: mean %.2f %%, p95 %.2f %%; ectopic and next to them: mean %.2f %%, p95 %.2f %%\n",
      100 * normal.mean(), 100 * normal.p95(), 100 * ectopic.mean(), 100 * ectopic.p95());
  EXPECT_LE(normal.mean(), 0.015);
  EXPECT_LE(normal.p95(), 0.05);
  EXPECT_LE(ectopic.mean(), 0.15);
}

TEST(EcgReal, FindsTheSameBeatsInAllClearLeads) {
  OSTIA_REQUIRE_SHARED(folder, "ecg");
  const auto record = io::read_wfdb(folder / "s0010_re.hea").record;
  const auto peaks = r_peaks(record.leads[clearest_lead(record)].values, record.samples_per_second);
  std::printf("%s: %zu beats\n", record.leads[clearest_lead(record)].name.c_str(), peaks.size());
  std::vector<geometry::EcgBeat> beats;
  for (const std::size_t peak : peaks) beats.push_back({peak, 'N'});
  std::size_t agree = 0;
  for (const geometry::EcgLead& lead : record.leads) {
    const Score s = score(beats, r_peaks(lead.values, record.samples_per_second), record.samples_per_second);
    std::printf("%s: %zu found, %zu missed, %zu invented\n", lead.name.c_str(), s.found, s.missed,
                s.invented);
    agree += s.missed + s.invented == 0 ? 1 : 0;
  }
  EXPECT_GE(agree, 12U);
}

}  // namespace
}  // namespace ostia::motion
