#include "flow/flow_result.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/solver/flow_files.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// What the result depends on: the case, its log and the fields of its last time.
pipeline::JobKey job_of(const ResultCommand& o) {
  const nlohmann::json parameters = {{"low_shear_pa", o.low_shear_pa}, {"high_shear_pa", o.high_shear_pa}};
  pipeline::JobKey job{"result", {}, parameters.dump()};
  const auto add = [&](const std::string& role, const fs::path& file) {
    std::error_code error;
    if (fs::is_regular_file(file, error)) job.inputs[role] = core::sha256_file(file);
  };
  add("case", o.flow_case / "flow-case.json");
  add("mesh", o.mesh.empty() ? o.flow_case / "mesh.vtu" : o.mesh);
  for (const char* program : {"simpleFoam", "pimpleFoam", "pisoFoam"})
    add(program, o.flow_case / (std::string("log.") + program));
  const fs::path last = solver::result_time(o.flow_case);
  for (const char* field : {"U", "pressureInPascal", "wallShearStress"}) add(field, last / field);
  return job;
}

void print(const solver::FlowResult& result, const solver::FlowReport& report) {
  std::printf("%s, %g %s, %s\n", result.run.program.c_str(), result.run.last,
              result.record.pulsatile() ? "s" : "iterations",
              result.run.converged ? "converged" : "not converged");
  for (const solver::EndFlow& end : result.ends)
    std::printf("%s: %.4g ml/s, %.4g Pa (%.3g mmHg)\n", end.name.c_str(), end.flow_ml_s, end.pressure_pa,
                end.pressure_pa / 133.322387415);
  const char* kind = result.record.pulsatile() ? "time-averaged wall shear stress" : "wall shear stress";
  for (const solver::WallFigures& wall : report.walls)
    std::printf(
        "%s: %s %.3g Pa in the mean, %.3g to %.3g Pa; %.3g %% of the area below %g Pa, %.3g %% "
        "above %g Pa\n",
        wall.name.c_str(), kind, wall.mean_pa, wall.least_pa, wall.greatest_pa, 100.0 * wall.low_share,
        report.limits.low_pa, 100.0 * wall.high_share, report.limits.high_pa);
  std::printf("mass balance off by %.2g %%\n", 100.0 * result.mass_balance_error());
}

void make(const ResultCommand& o, const solver::FlowResult& result, const solver::FlowReport& report,
          const pipeline::JobKey& job, const Clock::time_point& start, ExitCode code,
          const core::TaskContext& task) {
  core::StagedFolder staged(o.output);
  solver::write_flow_files(result, report, staged.temporary(), task);
  pipeline::ManifestRecord record;
  record.key = job;
  record.exit_code = code;
  record.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  record.warnings = report.reasons;
  pipeline::write_manifest(staged.temporary(), record);
  staged.commit();
}

}  // namespace

ExitCode run_result(const ResultCommand& o, const core::TaskContext& task) {
  const Clock::time_point start = Clock::now();
  const solver::ShearLimits limits{o.low_shear_pa, o.high_shear_pa};
  solver::validate(limits);
  solver::read_case_record(o.flow_case);  // refuses what is no case before anything is made
  pipeline::require_free_folder(o.output);
  task.set_stage("reading");
  const pipeline::JobKey job = job_of(o);
  std::optional<ExitCode> code = pipeline::already_done(o.output, job);
  if (code) {
    core::log_info("done already with the same results and parameters; nothing to do");
  } else {
    const solver::FlowResult result = solver::read_flow_result(o.flow_case, o.mesh, task.sub(0.0, 0.5));
    const solver::FlowReport report = solver::flow_report(result, limits);
    code = report.passed() ? ExitCode::ok : ExitCode::quality_failed;
    task.set_stage("writing");
    make(o, result, report, job, start, *code, task.sub(0.5, 1.0));
    for (const std::string& reason : report.reasons) core::log_warning(reason);
    if (!o.json) print(result, report);
  }
  if (o.json) std::fputs(core::read_file(o.output / "result.json").c_str(), stdout);
  task.set_progress(1.0);
  return *code;
}

void define_result(CLI::App& app, ResultCommand& o, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* sub =
      app.add_subcommand("result", "What a solver has computed: fields, wall shear stress, flows");
  sub->footer(
      "Example:\n  ostia case mesh/mesh.vtu -o flow --outlets split && flow/Allrun\n"
      "  ostia result flow -o flow-result");
  sub->fallthrough();
  sub->add_option("CASE", o.flow_case, "Folder of `ostia case --solver openfoam`, after its ./Allrun")
      ->required();
  sub->add_option("-o,--output", o.output, "Folder that is made")->required();
  sub->add_option("--mesh", o.mesh, "The mesh that the case was made of, where its own mesh.vtu is gone");
  sub->add_option("--low-shear", o.low_shear_pa, "Below this the shear stress counts as low, Pa");
  sub->add_option("--high-shear", o.high_shear_pa, "Above this it counts as high, Pa");
  sub->add_flag("--json", o.json, "One JSON object on standard output");
  sub->callback([&] { run = [&](const core::TaskContext& task) { return run_result(o, task); }; });
}

}  // namespace ostia::app
