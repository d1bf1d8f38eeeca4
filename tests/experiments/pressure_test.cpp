// The pressure experiment with made-up computations whose numbers are known, and one real one.

#include "ostia/experiments/pressure.h"

#include "pressure/pressure_compare.h"
#include "pressure/pressure_keep.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/hemodynamics/conditions.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <cmath>
#include <set>

namespace ostia::experiments {
namespace {

namespace fs = std::filesystem;
using hemodynamics::pa_of_mmhg;

constexpr double fall_pa_mm = 40.0;

/// Pressure falls by so much a millimetre from the root on, in every vessel.
PressureRun made_up(const PressureTask& task) {
  PressureRun run;
  run.converged = true;
  run.iterations = 100.0;
  run.cells = 1000;
  run.inlet_ml_s = task.flow_ml_s;
  const auto vessels = task.model.tree.vessels.size();
  for (std::size_t v = 0; v < vessels; ++v) {
    const auto& vessel = *task.model.vessels[v];
    run.outlets_ml_s[task.model.tree.vessels[v].name] = task.flow_ml_s / static_cast<double>(vessels);
    for (double s = vessel.own_from_mm; s <= vessel.axis->length(); s += 0.25)
      run.sections.push_back({vessel.vessel, s, -fall_pa_mm * s});
  }
  return run;
}

/// A runner that counts.
struct Fake {
  std::atomic<int> calls = 0;
  std::set<std::string> fails;
  PressureRunner runner() {
    return [this](const PressureTask& task, const fs::path& folder, const core::TaskContext& context) {
      context.throw_if_cancelled();
      EXPECT_TRUE(fs::is_directory(folder));
      ++calls;
      if (fails.contains(task.id)) throw NumericalError("it blew up in " + folder.string());
      return made_up(task);
    };
  }
};

PressureOptions few(const std::string& name) {
  PressureOptions options;
  options.plan = {1, 2, 0, 0, 0, 0, 1};
  options.keep = testing::temporary_folder(name) / "runs";
  options.other_edge_ratios.clear();
  return options;
}

TEST(Pressure, KnownNumbersComeThroughTheTable) {
  const PressureOptions options = few("pressure_table");
  Fake fake;
  const PressureResults results = run_pressure(options, fake.runner());
  EXPECT_EQ(fake.calls, 4);
  ASSERT_EQ(results.rows.size(), 4u);
  EXPECT_EQ(results.planned, 4u);
  for (const PressureRow& row : results.rows) {
    EXPECT_EQ(row.failure, "") << row.planned.id;
    ASSERT_EQ(row.readings.size(), row.planned.fork_mm > 0.0 ? 2u : 1u) << row.planned.id;
    // The first section that both have is a diameter behind the root's first; from there on it is a line.
    const PressureCurve& first = row.curves.front();
    const double pa = results.aortic_mmhg * pa_of_mmhg;
    for (const PressureReading& reading : row.readings) {
      EXPECT_NEAR(reading.ffr_3d, 1.0 - fall_pa_mm * (reading.s_mm - first.s_mm.front()) / pa,
                  fall_pa_mm * 0.6 / pa)
          << row.planned.id << " " << reading.vessel;
      EXPECT_LT(reading.ffr_1d, 1.0) << row.planned.id;
    }
    // Recomputed from the curves: of vessels with one branch.
    if (row.curves.size() == 1) {
      double squares = 0.0;
      for (std::size_t i = 0; i < first.s_mm.size(); ++i)
        squares += std::pow(first.mmhg_1d[i] - first.mmhg_3d[i], 2) / static_cast<double>(first.s_mm.size());
      EXPECT_NEAR(row.rms_mmhg, std::sqrt(squares), 1e-9);
      for (std::size_t i = 1; i < first.s_mm.size(); ++i)
        EXPECT_NEAR((first.mmhg_3d[i] - first.mmhg_3d[i - 1]) * pa_of_mmhg,
                    -fall_pa_mm * (first.s_mm[i] - first.s_mm[i - 1]), 1e-6);
      ASSERT_TRUE(row.readings.front().exact.has_value());
      EXPECT_NEAR(*row.readings.front().exact, row.readings.front().ffr_1d, 0.03) << row.planned.id;
    }
  }
  // In the tube one dimension is Poiseuille's law, and the made-up run is off by what is known.
  const double radius_m = 0.5e-3 * results.rows.front().planned.diameter_mm;
  const double theory =
      8.0 * 3.5e-3 * 1e-6 * results.rows.front().planned.flow_ml_s / (M_PI * std::pow(radius_m, 4)) * 1e-3;
  ASSERT_TRUE(poiseuille_error(results).has_value());
  EXPECT_NEAR(*poiseuille_error(results), fall_pa_mm / theory - 1.0, 1e-6 * fall_pa_mm / theory);
  const PressureCurve& tube = results.rows.front().curves.front();
  const double length = tube.s_mm.back() - tube.s_mm.front();
  EXPECT_NEAR((tube.mmhg_1d.front() - tube.mmhg_1d.back()) * pa_of_mmhg, theory * length,
              0.02 * theory * length);
}

TEST(Pressure, WhatIsKeptIsNotRunAgain) {
  PressureOptions options = few("pressure_resume");
  options.most = 2;
  options.jobs = 2;
  Fake fake;
  EXPECT_EQ(run_pressure(options, fake.runner()).rows.size(), 2u);
  EXPECT_EQ(fake.calls, 2);
  options.most = 0;
  const PressureResults whole = run_pressure(options, fake.runner());
  EXPECT_EQ(whole.rows.size(), 4u);
  EXPECT_EQ(fake.calls, 4);
  const PressureResults again = run_pressure(options, fake.runner());
  EXPECT_EQ(fake.calls, 4);
  EXPECT_EQ(pressure_json(again, options), pressure_json(whole, options));
  options.only = {"nothing-like-it"};
  EXPECT_THROW(run_pressure(options, fake.runner()), InvalidInput);
}

TEST(Pressure, ACaseThatFailsIsToldAndTriedAgainWhenAsked) {
  PressureOptions options = few("pressure_failed");
  options.only = {"concentric"};
  Fake fake;
  fake.fails = {"concentric-01"};
  const PressureResults results = run_pressure(options, fake.runner());
  ASSERT_EQ(results.rows.size(), 2u);
  EXPECT_EQ(results.rows[0].failure + results.rows[1].failure, "it blew up in concentric-01");
  EXPECT_NE(pressure_json(results, options).find("it blew up"), std::string::npos);
  run_pressure(options, fake.runner());
  EXPECT_EQ(fake.calls, 2);
  fake.fails.clear();
  options.again = true;
  const PressureResults mended = run_pressure(options, fake.runner());
  EXPECT_EQ(fake.calls, 3);
  EXPECT_EQ(mended.rows[0].failure + mended.rows[1].failure, "");
}

TEST(Pressure, AnotherPlansFolderIsRefused) {
  PressureOptions options = few("pressure_other");
  options.only = {"tube"};
  Fake fake;
  run_pressure(options, fake.runner());
  PressureOptions other = options;
  other.plan.first_seed = 7;
  EXPECT_THROW(run_pressure(other, fake.runner()), InvalidInput);
  other = options;
  other.mesh.edge_ratio = 0.3;
  EXPECT_THROW(run_pressure(other, fake.runner()), InvalidInput);
  EXPECT_EQ(fake.calls, 1);
  // One that holds something else, and a run that is no JSON.
  other = options;
  other.keep = testing::temporary_folder("pressure_foreign");
  core::write_file(other.keep / "letter.txt", "dear");
  EXPECT_THROW(run_pressure(other, fake.runner()), InvalidInput);
  for (const char* broken : {"{\"v\": 1", "{\"v\": 0}", "{}", "[1]"}) {
    core::write_file(options.keep / "tube.json", broken);
    EXPECT_THROW(run_pressure(options, fake.runner()), InvalidInput) << broken;
  }
}

TEST(Pressure, ARunIsKeptToWhatMatters) {
  PressureRun run;
  run.digest = "d";
  run.converged = true;
  run.iterations = 123.0;
  run.cells = 100000;
  run.seconds = 99.6;
  run.inlet_ml_s = 1.23456789;
  run.outlets_ml_s = {{"main", 0.7}, {"side", 0.53456789}};
  for (int vessel : {8, 9})
    for (int i = 0; i < 200; ++i)
      run.sections.push_back({vessel, 1.0 / 3.0 + 0.25 * i, 1000.0 / 3.0 - 7.7777777 * i});
  const std::string text = run_json(run);
  EXPECT_LT(text.size(), 8000u);
  const PressureRun read = run_of_json(text, "run");
  EXPECT_EQ(read.digest, run.digest);
  EXPECT_TRUE(read.converged);
  EXPECT_EQ(read.cells, run.cells);
  EXPECT_NEAR(read.inlet_ml_s, run.inlet_ml_s, 1e-7);
  EXPECT_NEAR(read.outlets_ml_s.at("side"), run.outlets_ml_s.at("side"), 1e-7);
  ASSERT_EQ(read.sections.size(), run.sections.size());
  for (std::size_t i = 0; i < read.sections.size(); ++i) {
    EXPECT_EQ(read.sections[i].vessel, run.sections[i].vessel);
    EXPECT_NEAR(read.sections[i].s_mm, run.sections[i].s_mm, 5.1e-4);
    EXPECT_NEAR(read.sections[i].pressure_pa, run.sections[i].pressure_pa, 5.1e-3);
  }
  EXPECT_EQ(run_json(read), text) << "nothing more is lost";
}

TEST(Pressure, JudgingRunsNothing) {
  PressureOptions options = few("pressure_judge");
  options.only = {"fit"};
  Fake fake;
  const std::size_t kept = run_pressure(options, fake.runner()).rows.size();
  EXPECT_EQ(fake.calls, static_cast<int>(kept));
  EXPECT_GT(kept, 0u);
  options.only.clear();
  options.judge = true;
  const PressureResults judged = run_pressure(options, fake.runner());
  EXPECT_EQ(fake.calls, static_cast<int>(kept));
  EXPECT_EQ(judged.rows.size(), kept);
  for (const PressureRow& row : judged.rows) EXPECT_EQ(half_of(row.planned), PressureHalf::fitting);
}

TEST(Pressure, ADigestIsOfAllThatIsComputed) {
  const PressureMesh mesh;
  PressureMesh finer = mesh;
  finer.edge_ratio = 0.1;
  const std::string digest = digest_of("wall", 1.0, mesh);
  EXPECT_EQ(digest, digest_of("wall", 1.0 + 1e-15, mesh)) << "last bits are a processor's own";
  EXPECT_NE(digest, digest_of("wall", 1.0 + 1e-6, mesh));
  EXPECT_NE(digest, digest_of("walls", 1.0, mesh));
  EXPECT_NE(digest, digest_of("wall", 1.0, finer));
}

TEST(Pressure, StopsWhenCancelledAndKeepsWhatIsDone) {
  PressureOptions options = few("pressure_cancel");
  const core::TaskContext task;
  Fake fake;
  const PressureRunner inner = fake.runner();
  const PressureRunner runner = [&](const PressureTask& one, const fs::path& folder,
                                    const core::TaskContext& context) {
    PressureRun run = inner(one, folder, context);
    if (fake.calls == 2) task.cancel();
    context.throw_if_cancelled();
    return run;
  };
  EXPECT_THROW(run_pressure(options, runner, task), Cancelled);
  EXPECT_EQ(fake.calls, 2);
  const auto left_of = [&](const std::string& name) {
    return std::distance(fs::directory_iterator(options.keep), {}) == 3 && fs::exists(options.keep / name);
  };
  EXPECT_TRUE(left_of("plan.json")) << "beside it the first run and its folder";
  run_pressure(options, fake.runner());
  EXPECT_EQ(fake.calls, 5) << "the first was kept, the second was not";
}

/// What ends a run from outside, or happens to it while it is being cancelled, is no failure of the case.
TEST(Pressure, ARunThatIsEndedFromOutsideLeavesNothing) {
  PressureOptions options = few("pressure_ended");
  options.only = {"tube"};
  const auto ended = [&](const auto& how, const core::TaskContext& task) {
    run_pressure(
        options,
        [&](const PressureTask& one, const fs::path& folder, const core::TaskContext&) {
          core::write_file(folder / "half", "written");
          how();
          return made_up(one);
        },
        task);
  };
  const core::TaskContext task, cancelled;
  EXPECT_THROW(ended([] { throw ResourceError("simpleFoam was told to stop"); }, task), ResourceError);
  EXPECT_THROW(ended(
                   [&] {
                     cancelled.cancel();
                     throw NumericalError("Allrun exited with code 143");
                   },
                   cancelled),
               Cancelled);
  EXPECT_EQ(std::distance(fs::directory_iterator(options.keep), {}), 1) << "plan.json";
  Fake fake;
  EXPECT_EQ(run_pressure(options, fake.runner()).rows.front().failure, "");
  EXPECT_EQ(fake.calls, 1);
}

TEST(Pressure, MeshesAreExtrapolatedWhereTheyFallInLine) {
  ConvergenceRow row;
  row.edge_ratios = {0.1, 0.2, 0.4};
  // 5 + 3 h^2
  for (const double h : row.edge_ratios) row.drops_mmhg.push_back(5.0 + 3.0 * h * h);
  extrapolate(row);
  ASSERT_TRUE(row.order.has_value());
  EXPECT_NEAR(*row.order, 2.0, 1e-9);
  EXPECT_NEAR(*row.richardson_mmhg, 5.0, 1e-9);
  ConvergenceRow wild;
  wild.edge_ratios = row.edge_ratios;
  wild.drops_mmhg = {5.0, 5.2, 5.1};
  extrapolate(wild);
  EXPECT_FALSE(wild.order.has_value());
}

TEST(Pressure, FiguresTogetherAreReckonedByHand) {
  PressureResults results;
  const auto add = [&](const std::string& id, bool judged, double one, double three, double rms) {
    PressureRow row;
    row.planned.id = id;
    row.planned.kind = PressureKind::concentric;
    row.planned.judged = judged;
    row.run.converged = true;
    row.rms_mmhg = rms;
    row.readings = {{"main", 40.0, one, three, three, {}}};
    results.rows.push_back(row);
  };
  add("a", true, 0.90, 0.91, 1.0);
  add("b", true, 0.80, 0.81, 2.0);
  add("c", true, 0.62, 0.60, 2.0);
  add("d", false, 0.50, 0.90, 9.0);
  results.rows.push_back(results.rows.front());
  results.rows.back().run.converged = false;
  const PressureSummary s = summarize(results, PressureHalf::judging);
  EXPECT_EQ(s.cases, 3u);
  EXPECT_NEAR(s.bias, 0.0, 1e-12);
  EXPECT_NEAR(s.sd, std::sqrt((1e-4 + 1e-4 + 4e-4) / 2.0), 1e-12);
  EXPECT_NEAR(s.alike, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(s.worst, 0.02, 1e-12);
  EXPECT_EQ(s.worst_id, "c");
  EXPECT_NEAR(s.rms_mmhg, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(s.worst_rms_mmhg, 2.0, 1e-12);
  EXPECT_NEAR(summarize(results, PressureHalf::judging, true).sd, 0.0, 1e-12);
  EXPECT_EQ(summarize(results, PressureHalf::fitting).cases, 1u);
  EXPECT_EQ(summarize(results, PressureHalf::patients).readings, 0u);
}

TEST(Pressure, WritesItsReport) {
  PressureOptions options = few("pressure_report");
  Fake fake;
  const PressureResults results = run_pressure(options, fake.runner());
  const fs::path out = testing::temporary_folder("pressure_out");
  write_pressure_report(out, results, options);
  for (const char* name : {"cases.csv", "curves.csv", "tables.md", "agreement.png", "report.html"})
    EXPECT_TRUE(fs::is_regular_file(out / name)) << name;
  EXPECT_NE(core::read_file(out / "tables.md").find("\n| concentric-01 | fit |"), std::string::npos);
  const auto json = nlohmann::json::parse(pressure_json(results, options));
  EXPECT_EQ(json["kind"], "pressure");
  EXPECT_EQ(json["cases"].size(), 4u);
  EXPECT_EQ(json["summary"]["judging"]["model"]["cases"], 1);
  EXPECT_EQ(pressure_json(results, options).find("nan"), std::string::npos);
}

TEST(Pressure, FindsTheConstantsThatAMadeUpFlowHas) {
  // Three dimensions that are one with other constants: they come back, and all readings agree.
  PressureOptions options = few("pressure_fit");
  options.plan = {1, 10, 0, 0, 0, 0, 0};
  hemodynamics::FlowModel hidden = compared_model();
  hidden.development *= 1.6;
  std::vector<PressureProblem> problems;
  for (const PressureCase& one : plan_pressure(options.plan)) {
    if (one.kind == PressureKind::tube) continue;
    PressureRun run;
    run.converged = true;
    run.outlets_ml_s["main"] = run.inlet_ml_s = one.flow_ml_s;
    PressureProblem problem = problem_of(one, *exact_network(one), run);
    const auto pa = pressures_1d(problem, hidden);
    const hemodynamics::Branch& branch = problem.network.branches.front();
    for (std::size_t i = 0; i < branch.stations.size(); ++i)
      problem.run.sections.push_back({branch.vessel, branch.stations[i].s_mm, pa.front()[i]});
    problems.push_back(problem);
  }
  const auto fit = fit_pressure(problems);
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit->readings, 5u) << "the fitting half alone";
  EXPECT_LT(fit->rms_after, 0.3 * fit->rms_before);
  EXPECT_NEAR(fit->development, hidden.development, 0.25 * hidden.development);
}

TEST(Pressure, RefusesOptions) {
  PressureOptions options = few("pressure_bad");
  options.keep.clear();
  EXPECT_THROW(validate(options), InvalidInput);
  options = few("pressure_bad");
  options.jobs = 0;
  EXPECT_THROW(validate(options), InvalidInput);
  options = few("pressure_bad");
  options.mesh.edge_ratio = 0.01;
  EXPECT_THROW(validate(options), InvalidInput);
  OpenfoamRunnerOptions runner;
  runner.timeout_s = 0.0;
  EXPECT_THROW(openfoam_runner(runner), InvalidInput);
}

TEST(PressureOpenfoam, ATubeIsPoiseuilles) {
  if (!openfoam_is_there()) GTEST_SKIP() << "openfoam is not installed";
  PressureOptions options = few("pressure_openfoam");
  options.only = {"tube"};
  options.mesh.edge_ratio = 0.35;
  const PressureResults results = run_pressure(options, openfoam_runner());
  ASSERT_EQ(results.rows.size(), 1u);
  const PressureRow& row = results.rows.front();
  ASSERT_EQ(row.failure, "");
  EXPECT_TRUE(row.run.converged);
  EXPECT_GT(row.run.cells, 3000u);
  EXPECT_NEAR(row.run.inlet_ml_s, row.planned.flow_ml_s, 1e-6);
  EXPECT_NEAR(row.run.outlets_ml_s.at("main"), row.planned.flow_ml_s, 1e-4 * row.planned.flow_ml_s);
  EXPECT_LT(std::abs(*poiseuille_error(results)), 0.05);
  EXPECT_LT(row.rms_mmhg, 0.1);
  EXPECT_TRUE(fs::is_regular_file(options.keep / "tube" / "speed.png"));
  EXPECT_FALSE(fs::exists(options.keep / "tube" / "mesh"));
}

TEST(PressureOpenfoam, ARunThatTakesTooLongIsEnded) {
  if (!openfoam_is_there()) GTEST_SKIP() << "openfoam is not installed";
  PressureOptions options = few("pressure_timeout");
  options.only = {"tube"};
  options.mesh.edge_ratio = 0.35;
  options.mesh.tolerance = 1e-9;
  options.mesh.iterations = 100000;
  OpenfoamRunnerOptions runner;
  runner.timeout_s = 0.3;
  const PressureResults results = run_pressure(options, openfoam_runner(runner));
  ASSERT_EQ(results.rows.size(), 1u);
  EXPECT_NE(results.rows.front().failure.find("has not ended"), std::string::npos)
      << results.rows.front().failure;
}

}  // namespace
}  // namespace ostia::experiments
