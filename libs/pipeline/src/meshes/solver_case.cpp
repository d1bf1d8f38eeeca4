#include "ostia/pipeline/solver_case.h"

#include "ostia/core/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace ostia::pipeline {
namespace {

using nlohmann::json;
using solver::OpenfoamCaseOptions;
using solver::SvmultiphysicsCaseOptions;

template <class Options>
SolverCase with_flow(const solver::BoundaryFlowOptions& flow) {
  Options options;
  options.flow = flow;
  return options;
}

SolverCaseResult write_openfoam(const geometry::MixedMesh& mesh, const SolverCase& options,
                                const std::filesystem::path& folder, const core::TaskContext& task) {
  auto made = solver::write_openfoam_case(mesh, std::get<OpenfoamCaseOptions>(options), folder, task);
  return {std::move(made.flow), made.time_step_s, made.steps, made.hours, std::move(made.warnings)};
}

SolverCaseResult write_svmultiphysics(const geometry::MixedMesh& mesh, const SolverCase& options,
                                      const std::filesystem::path& folder, const core::TaskContext& task) {
  auto made =
      solver::write_svmultiphysics_case(mesh, std::get<SvmultiphysicsCaseOptions>(options), folder, task);
  return {std::move(made.flow), 0.0, 0.0, 0.0, std::move(made.warnings)};
}

struct Solver {
  SolverTraits traits;
  SolverCase (*with_flow)(const solver::BoundaryFlowOptions&);
  SolverCaseResult (*write)(const geometry::MixedMesh&, const SolverCase&, const std::filesystem::path&,
                            const core::TaskContext&);
};

// Kind, name, title, suite, folder; mesh, prisms, shares; script, run.
constexpr std::array<Solver, solver_kinds.size()> solvers = {{
    {{SolverKind::openfoam, "openfoam", "OpenFOAM", "", "openfoam-case", io::MeshFormat::openfoam, true, true,
      "Allrun", "./Allrun"},
     with_flow<OpenfoamCaseOptions>,
     write_openfoam},
    {{SolverKind::svmultiphysics, "svmultiphysics", "svMultiPhysics", "SimVascular", "svmultiphysics-case",
      io::MeshFormat::mesh_complete, false, false, "", "svmultiphysics solver.xml"},
     with_flow<SvmultiphysicsCaseOptions>,
     write_svmultiphysics},
}};
static_assert(std::variant_size_v<SolverCase> == solvers.size());

const Solver& entry(SolverKind kind) {
  return *std::ranges::find(solvers, kind, [](const Solver& solver) { return solver.traits.kind; });
}

template <class T>
json given(const std::optional<T>& value) {
  return value ? json(*value) : json();
}

json waveform_json(const solver::FlowWaveform& w) {
  return {
      {"time_s", w.time_s}, {"flow_ml_s", w.flow_ml_s}, {"period_s", w.period_s}, {"relative", w.relative}};
}

json flow_json(const solver::BoundaryFlowOptions& o) {
  return {{"density_kg_m3", o.blood.density_kg_m3},
          {"viscosity_mpa_s", o.blood.viscosity_mpa_s},
          {"rheology", name_of(o.blood.rheology)},
          {"flow_ml_s", given(o.flow_ml_s)},
          {"mean_velocity_cm_s", given(o.mean_velocity_cm_s)},
          {"reynolds", given(o.reynolds)},
          {"inlet_flow_ml_s", o.inlet_flow_ml_s},
          {"waveform", o.waveform ? waveform_json(*o.waveform) : json()},
          {"harmonics", o.harmonics},
          {"outlets", name_of(o.outlets)},
          {"split_exponent", o.split_exponent},
          {"total_resistance_mmhg_s_ml", given(o.total_resistance_mmhg_s_ml)}};
}

json own_json(const OpenfoamCaseOptions& o) {
  return {{"processes", o.processes},
          {"iterations", o.iterations},
          {"tolerance", o.tolerance},
          {"cycles", o.cycles},
          {"total_compliance_ml_mmhg", given(o.total_compliance_ml_mmhg)},
          {"samples_per_cycle", o.samples_per_cycle},
          {"results_per_cycle", o.results_per_cycle},
          {"courant", o.courant},
          {"time_step_s", given(o.time_step_s)}};
}

json own_json(const SvmultiphysicsCaseOptions& o) {
  return {{"total_compliance_ml_mmhg", given(o.total_compliance_ml_mmhg)},
          {"cycles", o.cycles},
          {"steps_per_cycle", o.steps_per_cycle},
          {"results_per_cycle", o.results_per_cycle}};
}

}  // namespace

const SolverTraits& traits_of(SolverKind kind) {
  return entry(kind).traits;
}

SolverKind solver_kind(std::string_view name) {
  std::string known;
  for (const Solver& solver : solvers) {
    if (solver.traits.name == name) return solver.traits.kind;
    known += (known.empty() ? "" : ", ") + std::string(solver.traits.name);
  }
  throw InvalidInput("there is no solver \"" + std::string(name) + "\" to write a case for; there are " +
                     known);
}

SolverKind kind_of(const SolverCase& options) {
  return solver_kinds[options.index()];
}

SolverCase solver_case(SolverKind kind, const solver::BoundaryFlowOptions& flow) {
  return entry(kind).with_flow(flow);
}

const solver::BoundaryFlowOptions& flow_of(const SolverCase& options) {
  return std::visit([](const auto& one) -> const solver::BoundaryFlowOptions& { return one.flow; }, options);
}

void validate(const SolverCase& options) {
  std::visit([](const auto& one) { solver::validate(one); }, options);
}

void require_takes(const SolverCase& options, bool prisms, bool quadratic) {
  io::require_holds(traits_of(kind_of(options)).mesh, prisms, quadratic);
}

void require_inlets(const SolverCase& options, const std::vector<std::string>& ends) {
  for (const auto& [name, flow] : flow_of(options).inlet_flow_ml_s) {
    if (name.starts_with("inlet_") && std::ranges::find(ends, name) != ends.end()) continue;
    std::string all;
    for (const std::string& end : ends) all += (all.empty() ? "" : ", ") + end;
    throw InvalidInput("there is no inlet \"" + name + "\" to give a flow of its own; the ends are " + all);
  }
}

std::string name_in_folder(const SolverCase& options) {
  return std::string(traits_of(kind_of(options)).folder);
}

std::string parameters_json(const SolverCase& options) {
  json out = std::visit([](const auto& one) { return own_json(one); }, options);
  out["flow"] = flow_json(flow_of(options));
  out["solver"] = traits_of(kind_of(options)).name;
  return out.dump();
}

SolverCaseResult write_solver_case(const geometry::MixedMesh& mesh, const SolverCase& options,
                                   const std::filesystem::path& folder, const core::TaskContext& task) {
  return entry(kind_of(options)).write(mesh, options, folder, task);
}

}  // namespace ostia::pipeline
