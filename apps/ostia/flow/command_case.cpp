#include "flow/case_continue.h"
#include "flow/solver_case.h"
#include "input/table_file.h"
#include "options/validators.h"
#include "output/output_aside.h"
#include "output/refusal.h"
#include "output/told.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/solver/openfoam_continue.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>

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
  flow.outlets = solver::outlet_model(c.outlets);
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

// What one solver alone is told.
void tell_solver(const CaseOptions& c, solver::OpenfoamCaseOptions& options) {
  options.total_compliance_ml_mmhg = c.compliance;
  options.processes = c.processes;
  options.iterations = c.iterations;
  options.cycles = c.cycles;
  options.time_step_s = c.time_step_s;
  if (c.courant) options.courant = *c.courant;
}

void tell_solver(const CaseOptions& c, solver::SvmultiphysicsCaseOptions& options) {
  if (c.time_step_s) throw UsageError("--time-step is for openfoam");
  if (c.courant) throw UsageError("--courant is for openfoam");
  options.total_compliance_ml_mmhg = c.compliance;
  options.cycles = c.cycles;
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
  std::string models;
  std::vector<std::string> names;
  for (const solver::OutletTraits& one : solver::outlet_models()) {
    names.emplace_back(one.name);
    models += (models.empty() ? "" : "; ") + names.back() + ": " + std::string(one.what);
  }
  app.add_option("--outlets", c.outlets, models)->check(CLI::IsMember(names));
  app.add_option("--split-exponent", c.split_exponent, "Flow goes as the diameter to this; Murray's is 3");
  app.add_option("--resistance", c.resistance,
                 "Of all outlets together, mmHg s / ml; left out: 90 mmHg over the mean flow")
      ->check(above_zero());
  app.add_option(
         "--compliance", c.compliance,
         "Of all outlets together, ml / mmHg: makes each resistance a Windkessel; openfoam wants a waveform")
      ->check(above_zero());
}

}  // namespace

pipeline::SolverCase solver_case(const CaseOptions& c) {
  pipeline::SolverCase made = pipeline::solver_case(pipeline::solver_kind(c.solver));
  std::visit(
      [&](auto& options) {
        tell_solver(c, options);
        options.flow = flow_options(c);
      },
      made);
  pipeline::validate(made);
  return made;
}

void tell_case(const pipeline::VolumeOptions& options, const std::filesystem::path& folder) {
  if (!options.solver_case) return;
  const pipeline::SolverTraits& solver = pipeline::traits_of(pipeline::kind_of(*options.solver_case));
  const std::filesystem::path place = folder / solver.folder;
  if (!solver.script.empty())
    core::log_info("run the case: " + (place / solver.script).string());
  else
    core::log_info("run the case in " + place.string() + ": " + std::string(solver.run));
}

namespace {

ExitCode made_case(const CaseCommand& c, const core::TaskContext& task) {
  if (solver::is_openfoam_case(c.mesh)) return continue_case(c);
  if (c.output.empty()) throw UsageError("`ostia case MESH` needs -o, the folder that is made");
  const pipeline::SolverCase asked = solver_case(c);  // refused before the mesh is read
  task.set_stage("reading");
  const geometry::MixedMesh mesh = io::read_volume_mesh(c.mesh);
  task.set_progress(0.2);
  task.set_stage("case");
  if (solver::is_openfoam_case(c.output)) {
    naming(c.mesh, [&] { continue_same_case(mesh, asked, c, task.sub(0.2, 1.0)); });
    return ExitCode::ok;
  }
  naming(c.mesh, [&] {
    const auto made = pipeline::write_solver_case(mesh, asked, c.output, task.sub(0.2, 1.0));
    for (const std::string& warning : made.warnings) core::log_warning(warning);
    print(made.flow, c.outlets != "zero");
    if (made.steps > 0.0)
      std::printf(
          "about %.2g steps, %.3g s the first%s: about %.2g hours on %d processes; more where a stenosis "
          "is faster than the ends\n",
          made.steps, made.time_step_s, c.time_step_s ? " as each" : "", made.hours, c.processes);
  });
  const pipeline::SolverTraits& solver = pipeline::traits_of(pipeline::kind_of(asked));
  const std::string script = c.output.string() + "/" + std::string(solver.script);
  if (!solver.script.empty())
    std::printf("run it: %s, or on %d processes %s %d\n", script.c_str(), c.processes, script.c_str(),
                c.processes);
  else
    std::printf("run it in %s: %s\n", c.output.c_str(), std::string(solver.run).c_str());
  return ExitCode::ok;
}

/// The record that is kept in the case's folder, where its solver has one.
void tell_record(const CaseCommand& c) {
  const std::filesystem::path record = (c.output.empty() ? c.mesh : c.output) / "flow-case.json";
  ToldJson facts{{"solver", c.solver}, {"record", nullptr}};
  if (std::filesystem::exists(record)) facts["record"] = ToldJson::parse(core::read_file(record));
  tell("solver-case", facts, "", true);
}

}  // namespace

ExitCode run_case(const CaseCommand& c, const core::TaskContext& task) {
  std::optional<OutputAside> aside(c.json);
  const ExitCode code = made_case(c, task);
  aside.reset();
  if (c.json) tell_record(c);
  return code;
}

std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const pipeline::SolverKind kind : pipeline::solver_kinds)
    names.emplace_back(pipeline::traits_of(kind).name);
  return names;
}

std::string of_all_solvers(std::string_view pipeline::SolverTraits::*text, const std::string& between) {
  std::string all;
  for (const pipeline::SolverKind kind : pipeline::solver_kinds)
    all += (all.empty() ? "" : between) + std::string(pipeline::traits_of(kind).*text);
  return all;
}

void add_case_options(CLI::App& app, CaseOptions& c, const std::string& iterations) {
  add_flow_options(app, c);
  app.add_option("--density", c.density, "Of blood, kg/m3");
  app.add_option("--viscosity", c.viscosity, "Of blood, mPa s");
  app.add_option("--rheology", c.rheology, "newton, or carreau: shear-thinning")
      ->check(CLI::IsMember({"newton", "carreau"}));
  app.add_option("--cycles", c.cycles, "Of a pulsatile flow");
  app.add_option("--time-step", c.time_step_s,
                 "s, of each step; left out: it follows the flow, for --courant")
      ->check(above_zero());
  app.add_option("--courant", c.courant, "Largest Courant number of a pulsatile flow (openfoam)")
      ->check(above_zero());
  app.add_option(iterations, c.iterations, "Of a steady flow, at most");
  app.add_option("--processes", c.processes, "That the decomposed run is prepared for");
}

void define_case(CLI::App& app, CaseCommand& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* sub = app.add_subcommand("case", "A blood flow case, ready to run by a solver");
  sub->footer(
      "Example:\n  ostia case mesh/mesh.vtu -o flow --outlets split\n"
      "  ostia case mesh/mesh.vtu -o pulse --waveform coronary-left --flow 0.8 && pulse/Allrun 4\n"
      "  ostia case flow --iterations 4000 && flow/Allrun");
  sub->fallthrough();
  sub->add_option("MESH", c.mesh,
                  "Volume mesh with inlets, outlets and walls (.vtu); or the folder of a case, which goes on "
                  "for as long as --iterations or --cycles say")
      ->required();
  sub->add_option("-o,--output", c.output, "Folder that is made");
  sub->add_option("--solver", c.solver, of_all_solvers(&pipeline::SolverTraits::name, " or "))
      ->check(CLI::IsMember(solver_names()));
  add_case_options(*sub, c, "--iterations");
  sub->add_flag("--json", c.json, "One JSON object on standard output");
  sub->callback([&, sub] {
    c.given.clear();
    for (const CLI::Option* option : sub->get_options())
      if (option->count() > 0 && option->get_name() != "--json") c.given.push_back(option->get_name());
    run = [&](const core::TaskContext& task) { return run_case(c, task); };
  });
}

}  // namespace ostia::app
