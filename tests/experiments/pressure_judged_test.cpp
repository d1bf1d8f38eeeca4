// The model against the three-dimensional runs that are kept with the source (data/pressure): what a change
// of the model does to them is seen without OpenFOAM.

#include "pressure/pressure_keep.h"

#include "ostia/core/parallel.h"
#include "ostia/experiments/pressure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>

namespace ostia::experiments {
namespace {

namespace fs = std::filesystem;

// As docs/experiments/pressure.md states them.
constexpr double most_bias = 0.02, most_sd = 0.03, most_off = 0.05, most_rms_mmhg = 2.5;

const PressureOptions& kept_options() {
  static const PressureOptions options = [] {
    PressureOptions o;
    o.keep = OSTIA_PRESSURE_RUNS;
    return o;
  }();
  return options;
}

/// The judging half, compared anew.
const PressureResults& judged() {
  static const PressureResults results = [] {
    const PressureKeep keep(kept_options());
    PressureResults all;
    for (const PressureCase& one : plan_pressure(kept_options().plan)) {
      if (half_of(one) != PressureHalf::judging) continue;
      const auto run = keep.find(one.id, digest_of(text_of(one), one.flow_ml_s, kept_options().mesh));
      if (!run) continue;
      PressureRow row;
      row.planned = one;
      row.run = *run;
      row.failure = run->failure;
      all.rows.push_back(row);
    }
    core::parallel_for(all.rows.size(), 1, [&](std::size_t i) {
      PressureRow& row = all.rows[i];
      if (row.failure.empty()) row = compare_pressure(row.planned, pressure_model(row.planned), row.run);
    });
    return all;
  }();
  return results;
}

TEST(PressureJudged, EveryRunThatIsKeptIsOfThePlan) {
  std::set<std::string> names{"plan"};
  const PressureKeep keep(kept_options());
  for (const PressureCase& one : plan_pressure(kept_options().plan)) {
    names.insert(one.id);
    for (const double ratio : kept_options().other_edge_ratios)
      names.insert(one.id + "-edges-" + std::to_string(std::lround(1000.0 * ratio)));
    if (!fs::exists(kept_options().keep / (one.id + ".json"))) continue;
    EXPECT_TRUE(keep.find(one.id, digest_of(text_of(one), one.flow_ml_s, kept_options().mesh)))
        << one.id << " is of another wall, flow or mesh than the plan's: run it again";
  }
  for (const std::string& patient : kept_options().patients) names.insert(patient);
  for (const auto& entry : fs::directory_iterator(kept_options().keep))
    EXPECT_TRUE(entry.path().extension() != ".json" || names.contains(entry.path().stem().string()))
        << entry.path();
}

TEST(PressureJudged, TheModelKeepsItsBounds) {
  const PressureSummary sum = summarize(judged(), PressureHalf::judging);
  if (sum.cases == 0)
    GTEST_SKIP() << "no run of the judging half is kept in " << OSTIA_PRESSURE_RUNS << " yet";
  std::printf("%zu cases, %zu readings: bias %+.4f, SD %.4f, worst %+.3f (%s), alike %.3f, RMS %.2f mmHg\n",
              sum.cases, sum.readings, sum.bias, sum.sd, sum.worst, sum.worst_id.c_str(), sum.alike,
              sum.rms_mmhg);
  std::size_t kept = 0;
  for (const PressureRow& row : judged().rows) kept += row.run.failure.empty() && row.run.converged ? 1 : 0;
  EXPECT_EQ(sum.cases, kept) << "the model refuses some";
  EXPECT_LE(std::abs(sum.bias), most_bias);
  EXPECT_LE(sum.sd, most_sd);
  EXPECT_LE(std::abs(sum.worst), most_off) << sum.worst_id;
  EXPECT_LE(sum.rms_mmhg, most_rms_mmhg);
}

}  // namespace
}  // namespace ostia::experiments
