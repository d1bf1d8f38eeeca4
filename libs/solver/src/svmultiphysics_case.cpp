#include "ostia/solver/svmultiphysics_case.h"

#include "case_text.h"
#include "pressure_units.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/io/mesh_export.h"
#include "ostia/solver/case_record.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using core::shortest_text;
using Json = nlohmann::ordered_json;

constexpr double mm3_per_ml = 1e3;

constexpr int flow_samples = 200;

/// A steady flow is run for that long a "cycle".
double period_s(const SvmultiphysicsCaseOptions& o) {
  return o.flow.waveform ? o.flow.waveform->period_s : 1.0;
}

struct Samples {
  std::vector<double> time_s, flow_mm3_s;  // a whole cycle, both its ends
};

Samples samples_of(const Inlet& inlet, double period) {
  Samples samples;
  const int count = inlet.harmonics ? flow_samples : 1;
  for (int i = 0; i <= count; ++i) {
    samples.time_s.push_back(period * i / count);
    samples.flow_mm3_s.push_back(inlet.flow_ml_s(i == count ? 0.0 : samples.time_s.back()) * mm3_per_ml);
  }
  return samples;
}

/// Time and flow along the outward normal: into the vessel is negative.
std::string flow_file(const Samples& samples, int modes) {
  std::string text = std::to_string(samples.time_s.size()) + " " + std::to_string(modes) + "\n";
  for (std::size_t i = 0; i < samples.time_s.size(); ++i)
    text += shortest_text(samples.time_s[i]) + " " + shortest_text(-samples.flow_mm3_s[i]) + "\n";
  return text;
}

/// In Pa s / mm3 and mm3 / Pa.
struct WindkesselInMm {
  double resistance = 0.0, compliance = 0.0;
};

WindkesselInMm windkessel_in_mm(const Outlet& outlet, const SvmultiphysicsCaseOptions& o) {
  return {outlet.resistance_pa_s_m3 * 1e-9,
          o.total_compliance_ml_mmhg.value_or(0.0) * outlet.share * mm3_per_ml / pa_per_mmhg};
}

std::string tag(const std::string& name, const std::string& value) {
  return "<" + name + "> " + value + " </" + name + ">\n";
}

std::string mesh_part(const BoundaryFlow& flow) {
  std::string text =
      "<Add_mesh name=\"lumen\">\n  " + tag("Mesh_file_path", "mesh-complete/mesh-complete.mesh.vtu");
  const auto add = [&](const std::string& name) {
    text += "  <Add_face name=\"" + name + "\">\n    " +
            tag("Face_file_path", "mesh-complete/mesh-surfaces/" + name + ".vtp") + "  </Add_face>\n";
  };
  for (const Inlet& inlet : flow.inlets) add(inlet.name);
  for (const Outlet& outlet : flow.outlets) add(outlet.name);
  for (const std::string& wall : flow.walls) add(wall);
  return text + "</Add_mesh>\n\n";
}

std::string general_part(const SvmultiphysicsCaseOptions& o) {
  const int results = std::max(1, o.steps_per_cycle / o.results_per_cycle);
  return "<GeneralSimulationParameters>\n  " + tag("Continue_previous_simulation", "false") + "  " +
         tag("Number_of_spatial_dimensions", "3") + "  " +
         tag("Number_of_time_steps", std::to_string(o.cycles * o.steps_per_cycle)) + "  " +
         tag("Time_step_size", shortest_text(period_s(o) / o.steps_per_cycle)) + "  " +
         tag("Spectral_radius_of_infinite_time_step", "0.5") + "  " +
         tag("Searched_file_name_to_trigger_stop", "STOP_SIM") + "  " +
         tag("Save_results_to_VTK_format", "true") + "  " + tag("Name_prefix_of_saved_VTK_files", "result") +
         "  " + tag("Increment_in_saving_VTK_files", std::to_string(results)) + "  " +
         tag("Start_saving_after_time_step", "1") + "  " +
         tag("Increment_in_saving_restart_files", std::to_string(results)) + "  " +
         tag("Convert_BIN_to_VTK_format", "false") + "  " + tag("Verbose", "true") + "  " +
         tag("Warning", "false") + "  " + tag("Debug", "false") + "</GeneralSimulationParameters>\n\n";
}

std::string viscosity_part(const Blood& blood) {
  if (blood.rheology == Rheology::newtonian)
    return "  <Viscosity model=\"Constant\">\n    " +
           tag("Value", shortest_text(blood.viscosity_mpa_s * 1e-3)) + "  </Viscosity>\n";
  return "  <Viscosity model=\"Carreau-Yasuda\">\n    " +
         tag("Limiting_high_shear_rate_viscosity", shortest_text(CarreauLaw::at_speed_mpa_s * 1e-3)) +
         "    " + tag("Limiting_low_shear_rate_viscosity", shortest_text(CarreauLaw::at_rest_mpa_s * 1e-3)) +
         "    " + tag("Shear_rate_tensor_multiplier", shortest_text(CarreauLaw::relaxation_s)) + "    " +
         tag("Shear_rate_tensor_exponent", "2") + "    " +
         tag("Power_law_index", shortest_text(CarreauLaw::power)) + "  </Viscosity>\n";
}

std::string condition(const std::string& face, const std::string& entries) {
  return "  <Add_BC name=\"" + face + "\">\n" + entries + "  </Add_BC>\n";
}

std::string outlet_condition(const Outlet& outlet, const SvmultiphysicsCaseOptions& o) {
  const WindkesselInMm w = windkessel_in_mm(outlet, o);
  const std::string type = "    " + tag("Type", "Neu");
  if (o.flow.outlets == OutletModel::zero_pressure)
    return condition(outlet.name,
                     type + "    " + tag("Time_dependence", "Steady") + "    " + tag("Value", "0"));
  if (!o.total_compliance_ml_mmhg)
    return condition(outlet.name, type + "    " + tag("Time_dependence", "Resistance") + "    " +
                                      tag("Value", shortest_text(w.resistance)));
  return condition(
      outlet.name,
      type + "    " + tag("Time_dependence", "RCR") + "    <RCR_values>\n      " +
          tag("Capacitance", shortest_text(w.compliance)) + "      " +
          tag("Distal_resistance", shortest_text((1.0 - Windkessel::proximal_share) * w.resistance)) +
          "      " + tag("Proximal_resistance", shortest_text(Windkessel::proximal_share * w.resistance)) +
          "      " + tag("Distal_pressure", "0") + "      " + tag("Initial_pressure", "0") +
          "    </RCR_values>\n");
}

std::string equation_part(const BoundaryFlow& flow, const SvmultiphysicsCaseOptions& o) {
  std::string text = "<Add_equation type=\"fluid\">\n  " + tag("Coupled", "true") + "  " +
                     tag("Min_iterations", "3") + "  " + tag("Max_iterations", "10") + "  " +
                     tag("Tolerance", "1e-4") + "  " + tag("Backflow_stabilization_coefficient", "0.2") +
                     "  " + tag("Density", shortest_text(o.flow.blood.density_kg_m3 * 1e-6)) +
                     viscosity_part(o.flow.blood) + "  <Output type=\"Spatial\">\n";
  for (const char* field : {"Velocity", "Pressure", "Traction", "WSS"}) text += "    " + tag(field, "true");
  text += "  </Output>\n  <LS type=\"NS\">\n    " + tag("Max_iterations", "15") + "    " +
          tag("NS_GM_max_iterations", "10") + "    " + tag("NS_CG_max_iterations", "300") + "    " +
          tag("Tolerance", "1e-3") + "    " + tag("NS_GM_tolerance", "1e-3") + "    " +
          tag("NS_CG_tolerance", "1e-3") + "    " + tag("Krylov_space_dimension", "50") + "  </LS>\n";
  for (const Inlet& inlet : flow.inlets)
    text +=
        condition(inlet.name, "    " + tag("Type", "Dir") + "    " + tag("Time_dependence", "Unsteady") +
                                  "    " + tag("Temporal_values_file_path", inlet.name + ".flow") + "    " +
                                  tag("Profile", "Parabolic") + "    " + tag("Impose_flux", "true"));
  for (const Outlet& outlet : flow.outlets) text += outlet_condition(outlet, o);
  for (const std::string& wall : flow.walls)
    text += condition(wall, "    " + tag("Type", "Dir") + "    " + tag("Time_dependence", "Steady") + "    " +
                                tag("Value", "0"));
  return text + "</Add_equation>\n\n";
}

Json outlet_json(const Outlet& outlet, const SvmultiphysicsCaseOptions& o) {
  const WindkesselInMm w = windkessel_in_mm(outlet, o);
  if (o.flow.outlets == OutletModel::zero_pressure)
    return {{"bc_name", outlet.name},
            {"bc_type", "PRESSURE"},
            {"bc_values", {{"P", {0.0, 0.0}}, {"t", {0.0, period_s(o)}}}}};
  if (!o.total_compliance_ml_mmhg)
    return {{"bc_name", outlet.name},
            {"bc_type", "RESISTANCE"},
            {"bc_values", {{"R", w.resistance}, {"Pd", 0.0}}}};
  return {{"bc_name", outlet.name},
          {"bc_type", "RCR"},
          {"bc_values",
           {{"Rp", Windkessel::proximal_share * w.resistance},
            {"C", w.compliance},
            {"Rd", (1.0 - Windkessel::proximal_share) * w.resistance},
            {"Pd", 0.0}}}};
}

/// As svZeroDSolver names them; mm, g, s.
std::string conditions_json(const BoundaryFlow& flow, const SvmultiphysicsCaseOptions& o) {
  Json conditions = Json::array();
  for (const Inlet& inlet : flow.inlets) {
    const Samples samples = samples_of(inlet, period_s(o));
    conditions.push_back({{"bc_name", inlet.name},
                          {"bc_type", "FLOW"},
                          {"bc_values", {{"Q", samples.flow_mm3_s}, {"t", samples.time_s}}}});
  }
  for (const Outlet& outlet : flow.outlets) conditions.push_back(outlet_json(outlet, o));
  return Json{{"boundary_conditions", conditions}}.dump(2) + "\n";
}

void require_at_least(const char* what, int value, int least, int most) {
  if (value < least || value > most)
    throw InvalidInput(std::string(what) + " must be in [" + std::to_string(least) + ", " +
                       std::to_string(most) + "], not " + std::to_string(value));
}

}  // namespace

void validate(const SvmultiphysicsCaseOptions& o) {
  validate(o.flow);
  require_at_least("cycles", o.cycles, 1, 100);
  require_at_least("steps_per_cycle", o.steps_per_cycle, 10, 1000000);
  require_at_least("results_per_cycle", o.results_per_cycle, 1, o.steps_per_cycle);
  if (o.flow.outlets == OutletModel::split)
    throw InvalidInput(
        "svMultiPhysics takes no given flow at outlets; take resistances, which share it alike");
  if (!o.total_compliance_ml_mmhg) return;
  if (!(*o.total_compliance_ml_mmhg > 0.0 && std::isfinite(*o.total_compliance_ml_mmhg)))
    throw InvalidInput("total_compliance_ml_mmhg must be positive, not " +
                       shortest_text(*o.total_compliance_ml_mmhg));
  if (o.flow.outlets != OutletModel::resistance)
    throw InvalidInput("a total compliance needs outlets with resistance");
}

SvmultiphysicsCaseResult write_svmultiphysics_case(const geometry::MixedMesh& mesh,
                                                   const SvmultiphysicsCaseOptions& options,
                                                   const fs::path& folder, const core::TaskContext& task) {
  validate(options);
  require_new_folder(folder);
  io::require_holds(io::MeshFormat::mesh_complete, !mesh.prisms.empty(), mesh.quadratic());
  SvmultiphysicsCaseResult result;
  result.flow = boundary_flow(mesh, options.flow);
  result.warnings = result.flow.warnings;
  task.set_progress(0.2);
  core::StagedFolder staged(folder);
  const fs::path& target = staged.temporary();
  const auto written = io::export_mesh(mesh, io::MeshFormat::mesh_complete, target / "mesh-complete");
  result.warnings.insert(result.warnings.end(), written.warnings.begin(), written.warnings.end());
  task.set_progress(0.8);
  task.throw_if_cancelled();
  for (const Inlet& inlet : result.flow.inlets)
    write_case_file(target / (inlet.name + ".flow"), flow_file(samples_of(inlet, period_s(options)),
                                                               inlet.harmonics ? options.flow.harmonics : 1));
  write_case_file(target / "solver.xml",
                  "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<svMultiPhysicsFile version=\"0.1\">\n\n" +
                      general_part(options) + mesh_part(result.flow) + equation_part(result.flow, options) +
                      "</svMultiPhysicsFile>\n");
  write_case_file(target / "boundary_conditions.json", conditions_json(result.flow, options));
  write_case_record(case_record("svmultiphysics", options.flow, result.flow, options.cycles,
                                options.total_compliance_ml_mmhg.value_or(0.0)),
                    mesh, target);
  staged.commit();
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::solver
