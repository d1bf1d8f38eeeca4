#include "ostia/pipeline/solver_case.h"

#include "ostia/core/error.h"
#include "ostia/io/mesh_export.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace ostia::pipeline {
namespace {

using nlohmann::json;
using solver::OpenfoamCaseOptions;

const OpenfoamCaseOptions* openfoam(const SolverCase& options) {
  return std::get_if<OpenfoamCaseOptions>(&options);
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

}  // namespace

const solver::BoundaryFlowOptions& flow_of(const SolverCase& options) {
  return std::visit([](const auto& one) -> const solver::BoundaryFlowOptions& { return one.flow; }, options);
}

void validate(const SolverCase& options) {
  std::visit([](const auto& one) { solver::validate(one); }, options);
}

void require_takes(const SolverCase& options, bool prisms, bool quadratic) {
  io::require_holds(openfoam(options) ? io::MeshFormat::openfoam : io::MeshFormat::mesh_complete, prisms,
                    quadratic);
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
  return openfoam(options) ? "openfoam-case" : "svmultiphysics-case";
}

std::string parameters_json(const SolverCase& options) {
  json out{{"flow", flow_json(flow_of(options))}};
  if (const OpenfoamCaseOptions* o = openfoam(options)) {
    out["solver"] = "openfoam";
    out["processes"] = o->processes;
    out["iterations"] = o->iterations;
    out["tolerance"] = o->tolerance;
    out["cycles"] = o->cycles;
    out["samples_per_cycle"] = o->samples_per_cycle;
    out["results_per_cycle"] = o->results_per_cycle;
    out["courant"] = o->courant;
    out["time_step_s"] = given(o->time_step_s);
  } else {
    const auto& sv = std::get<solver::SvmultiphysicsCaseOptions>(options);
    out["solver"] = "svmultiphysics";
    out["total_compliance_ml_mmhg"] = given(sv.total_compliance_ml_mmhg);
    out["cycles"] = sv.cycles;
    out["steps_per_cycle"] = sv.steps_per_cycle;
    out["results_per_cycle"] = sv.results_per_cycle;
  }
  return out.dump();
}

SolverCaseResult write_solver_case(const geometry::MixedMesh& mesh, const SolverCase& options,
                                   const std::filesystem::path& folder, const core::TaskContext& task) {
  SolverCaseResult result;
  if (const OpenfoamCaseOptions* o = openfoam(options)) {
    solver::OpenfoamCaseResult made = solver::write_openfoam_case(mesh, *o, folder, task);
    result = {std::move(made.flow), made.time_step_s, std::move(made.warnings)};
  } else {
    auto made = solver::write_svmultiphysics_case(mesh, std::get<solver::SvmultiphysicsCaseOptions>(options),
                                                  folder, task);
    result = {std::move(made.flow), 0.0, std::move(made.warnings)};
  }
  return result;
}

}  // namespace ostia::pipeline
