#include "refusal.h"
#include "solver_case.h"
#include "table_file.h"
#include "validators.h"

#include "ostia/core/log.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/solver/openfoam_case.h"
#include "ostia/solver/svmultiphysics_case.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace ostia::app {
namespace {

double number_of(const std::string& text, const std::string& where) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw InvalidInput(where + ": \"" + text + "\" is no number");
  return value;
}

/// A table with the columns time_s and flow_ml_s. Without a period it is as long as the samples, the last one
/// a step before the first comes again; a last sample that repeats the first ends the period.
solver::FlowWaveform waveform_from(const std::filesystem::path& file, const std::optional<double>& period_s) {
  const Table table = read_table(file);
  const auto column = [&](const std::string& name) {
    const auto found = std::ranges::find(table.columns, name);
    if (found == table.columns.end())
      throw InvalidInput(file.string() + " has no column " + name + "; a waveform has time_s and flow_ml_s");
    return static_cast<std::size_t>(found - table.columns.begin());
  };
  const std::size_t time = column("time_s"), flow = column("flow_ml_s");
  solver::FlowWaveform w;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string where = file.string() + ", line " + std::to_string(table.lines[i]);
    w.time_s.push_back(number_of(table.rows[i][time], where));
    w.flow_ml_s.push_back(number_of(table.rows[i][flow], where));
  }
  const std::size_t n = w.time_s.size();
  if (n < 3) throw InvalidInput(file.string() + ": a waveform has three samples at least");
  if (period_s) {
    w.period_s = *period_s;
  } else if (w.flow_ml_s.front() == w.flow_ml_s.back()) {
    w.period_s = w.time_s.back() - w.time_s.front();
  } else {
    w.period_s = w.time_s.back() - w.time_s.front() + (w.time_s[n - 1] - w.time_s[n - 2]);
  }
  if (w.flow_ml_s.front() == w.flow_ml_s.back() && w.time_s.back() - w.time_s.front() >= w.period_s) {
    w.time_s.pop_back();
    w.flow_ml_s.pop_back();
  }
  return w;
}

solver::FlowWaveform waveform_of(const CaseOptions& c) {
  if (c.waveform.ends_with(".csv")) {
    const std::filesystem::path file = c.waveform;
    return naming(file, [&] {
      solver::FlowWaveform w = waveform_from(file, c.period_s);
      solver::validate(w);
      return w;
    });
  }
  solver::FlowWaveform w = solver::builtin_waveform(c.waveform);
  if (c.period_s) {
    for (double& t : w.time_s) t *= *c.period_s / w.period_s;
    w.period_s = *c.period_s;
  }
  return w;
}

void add_flow(const std::string& text, solver::BoundaryFlowOptions& flow) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos) {
    flow.flow_ml_s = number_of(text, "--flow");
  } else {
    flow.inlet_flow_ml_s[text.substr(0, equals)] = number_of(text.substr(equals + 1), "--flow");
  }
}

solver::BoundaryFlowOptions flow_options(const CaseOptions& c) {
  solver::BoundaryFlowOptions flow;
  flow.blood.density_kg_m3 = c.density;
  flow.blood.viscosity_mpa_s = c.viscosity;
  if (c.rheology == "carreau") flow.blood.rheology = solver::Rheology::carreau;
  for (const std::string& text : c.flow) add_flow(text, flow);
  flow.mean_velocity_cm_s = c.velocity_cm_s;
  flow.reynolds = c.reynolds;
  if (c.outlets == "split") flow.outlets = solver::Outlets::split;
  if (c.outlets == "resistance") flow.outlets = solver::Outlets::resistance;
  flow.split_exponent = c.split_exponent;
  flow.total_resistance_mmhg_s_ml = c.resistance;
  if (!c.waveform.empty()) flow.waveform = waveform_of(c);
  if (c.waveform.empty() && c.period_s) throw UsageError("--period needs --waveform");
  return flow;
}

void print(const solver::BoundaryFlow& flow, bool shared) {
  for (const solver::Inlet& inlet : flow.inlets)
    std::printf("%s: %.3g mm wide, %.4g ml/s in the mean, Reynolds number %.3g at most\n", inlet.name.c_str(),
                inlet.section.diameter_mm(), inlet.mean_flow_ml_s, inlet.reynolds);
  constexpr double pa_s_m3_per_mmhg_s_ml = 133.322387415e6;
  for (const solver::Outlet& outlet : flow.outlets) {
    std::printf("%s: %.3g mm wide", outlet.name.c_str(), outlet.diameter_mm);
    if (shared) std::printf(", %.3g %% of the flow", 100.0 * outlet.share);
    if (outlet.resistance_pa_s_m3 > 0.0)
      std::printf(", %.4g mmHg s / ml", outlet.resistance_pa_s_m3 / pa_s_m3_per_mmhg_s_ml);
    std::printf("\n");
  }
}

pipeline::SolverCase openfoam(const CaseOptions& c) {
  if (c.compliance) throw UsageError("--compliance is for svmultiphysics");
  solver::OpenfoamCaseOptions options;
  options.flow = flow_options(c);
  options.processes = c.processes;
  options.iterations = c.iterations;
  options.cycles = c.cycles;
  options.time_step_s = c.time_step_s;
  return options;
}

pipeline::SolverCase svmultiphysics(const CaseOptions& c) {
  if (c.time_step_s) throw UsageError("--time-step is for openfoam");
  solver::SvmultiphysicsCaseOptions options;
  options.flow = flow_options(c);
  options.total_compliance_ml_mmhg = c.compliance;
  options.cycles = c.cycles;
  return options;
}

void add_flow_options(CLI::App& app, CaseOptions& c) {
  app.add_option(
         "--flow", c.flow,
         "Mean flow through each inlet, ml/s, or INLET=ml/s for one of them; repeat. Left out: 1.43 d^2.55 "
         "(SI) of its diameter")
      ->allow_extra_args(false);
  app.add_option("--velocity", c.velocity_cm_s, "Instead: mean velocity at each inlet, cm/s")
      ->check(above_zero());
  app.add_option("--reynolds", c.reynolds, "Instead: Reynolds number at each inlet")->check(above_zero());
  app.add_option(
      "--waveform", c.waveform,
      "Pulsatile: coronary-left, coronary-right, or a .csv with the columns time_s,flow_ml_s of one "
      "cycle; scaled to the mean flow where one is given");
  app.add_option("--period", c.period_s, "Of the waveform, s")->check(above_zero());
  app.add_option("--outlets", c.outlets,
                 "zero: the same pressure at each; split: a share of the flow each; resistance: pressure is "
                 "resistance times flow")
      ->check(CLI::IsMember({"zero", "split", "resistance"}));
  app.add_option("--split-exponent", c.split_exponent, "Flow goes as the diameter to this; Murray's is 3");
  app.add_option("--resistance", c.resistance,
                 "Of all outlets together, mmHg s / ml; left out: 90 mmHg over the mean flow")
      ->check(above_zero());
  app.add_option("--compliance", c.compliance, "Of all outlets together, ml / mmHg (svMultiPhysics alone)")
      ->check(above_zero());
}

}  // namespace

pipeline::SolverCase solver_case(const CaseOptions& c) {
  pipeline::SolverCase made = c.solver == "svmultiphysics" ? svmultiphysics(c) : openfoam(c);
  pipeline::validate(made);
  return made;
}

void tell_case(const pipeline::VolumeOptions& options, const std::filesystem::path& folder) {
  if (!options.solver_case) return;
  const std::filesystem::path place = folder / pipeline::name_in_folder(*options.solver_case);
  if (std::holds_alternative<solver::OpenfoamCaseOptions>(*options.solver_case))
    core::log_info("run the case: " + (place / "Allrun").string());
  else
    core::log_info("run the case in " + place.string() + ": svmultiphysics solver.xml");
}

ExitCode run_case(const CaseCommand& c, const core::TaskContext& task) {
  const pipeline::SolverCase asked = solver_case(c);  // refused before the mesh is read
  task.set_stage("reading");
  const geometry::MixedMesh mesh = io::read_volume_mesh(c.mesh);
  task.set_progress(0.2);
  task.set_stage("case");
  naming(c.mesh, [&] {
    const auto made = pipeline::write_solver_case(mesh, asked, c.output, task.sub(0.2, 1.0));
    for (const std::string& warning : made.warnings) core::log_warning(warning);
    print(made.flow, c.outlets != "zero");
    if (made.time_step_s > 0.0) std::printf("time step %.3g s\n", made.time_step_s);
  });
  if (c.solver == "openfoam")
    std::printf("run it: %s/Allrun, or on %d processes %s/Allrun %d\n", c.output.c_str(), c.processes,
                c.output.c_str(), c.processes);
  else
    std::printf("run it in %s: svmultiphysics solver.xml\n", c.output.c_str());
  return ExitCode::ok;
}

void add_case_options(CLI::App& app, CaseOptions& c, const std::string& iterations) {
  add_flow_options(app, c);
  app.add_option("--density", c.density, "Of blood, kg/m3");
  app.add_option("--viscosity", c.viscosity, "Of blood, mPa s");
  app.add_option("--rheology", c.rheology, "newton, or carreau: shear-thinning")
      ->check(CLI::IsMember({"newton", "carreau"}));
  app.add_option("--cycles", c.cycles, "Of a pulsatile flow");
  app.add_option("--time-step", c.time_step_s, "s; left out: from the mesh, for a Courant number of 0.5")
      ->check(above_zero());
  app.add_option(iterations, c.iterations, "Of a steady flow, at most");
  app.add_option("--processes", c.processes, "That the decomposed run is prepared for");
}

void define_case(CLI::App& app, CaseCommand& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* sub = app.add_subcommand("case", "A case of blood flow that a solver runs as it is");
  sub->footer(
      "Example:\n  ostia case mesh/mesh.vtu -o flow --outlets split\n"
      "  ostia case mesh/mesh.vtu -o flow --waveform coronary-left --flow 0.8 && flow/Allrun 4");
  sub->fallthrough();
  sub->add_option("MESH", c.mesh, "Volume mesh with inlets, outlets and walls (.vtu)")->required();
  sub->add_option("-o,--output", c.output, "Folder that is made")->required();
  sub->add_option("--solver", c.solver, "openfoam or svmultiphysics")
      ->check(CLI::IsMember({"openfoam", "svmultiphysics"}));
  add_case_options(*sub, c, "--iterations");
  sub->callback([&] { run = [&](const core::TaskContext& task) { return run_case(c, task); }; });
}

}  // namespace ostia::app
