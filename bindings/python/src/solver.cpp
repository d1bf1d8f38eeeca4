#include "call.h"
#include "fields.h"
#include "figures.h"
#include "options.h"
#include "rooms.h"
#include "values.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/solver/flow_files.h"
#include "ostia/solver/openfoam_case.h"
#include "ostia/solver/openfoam_continue.h"
#include "ostia/solver/svmultiphysics_case.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using solver::Blood;
using solver::BoundaryFlowOptions;
using solver::CaseLength;
using solver::FlowWaveform;
using solver::OpenfoamCaseOptions;
using solver::OutletModel;
using solver::Rheology;
using solver::ShearLimits;
using solver::SvmultiphysicsCaseOptions;

template <>
struct WordsOf<Rheology> {
  static constexpr std::pair<const char*, Rheology> words[] = {{"newton", Rheology::newtonian},
                                                               {"carreau", Rheology::carreau}};
};
template <>
struct WordsOf<OutletModel> {
  static constexpr std::pair<const char*, OutletModel> words[] = {{"zero", OutletModel::zero_pressure},
                                                                  {"split", OutletModel::split},
                                                                  {"resistance", OutletModel::resistance}};
};
OSTIA_OPTIONS(Blood, (density_kg_m3, viscosity_mpa_s, rheology), ())
OSTIA_OPTIONS(FlowWaveform, (time_s, flow_ml_s, period_s, relative), ())
OSTIA_OPTIONS(BoundaryFlowOptions,
              (blood, flow_ml_s, mean_velocity_cm_s, reynolds, inlet_flow_ml_s, waveform, harmonics, outlets,
               split_exponent, total_resistance_mmhg_s_ml),
              ())
OSTIA_OPTIONS(OpenfoamCaseOptions,
              (flow, processes, iterations, tolerance, cycles, total_compliance_ml_mmhg, samples_per_cycle,
               results_per_cycle, courant, time_step_s),
              (start))  // a solution in one dimension
OSTIA_OPTIONS(SvmultiphysicsCaseOptions,
              (flow, total_compliance_ml_mmhg, cycles, steps_per_cycle, results_per_cycle), ())
OSTIA_OPTIONS(ShearLimits, (low_pa, high_pa), ())
OSTIA_FIGURES(CaseLength, (pulsatile, now, end), ())

namespace {

namespace fs = std::filesystem;
using core::TaskContext;
using geometry::MixedMesh;
using py::literals::operator""_a;
using solver::FlowResult;

py::dict flow_shown(const solver::BoundaryFlow& flow) {
  py::list inlets, outlets;
  for (const auto& inlet : flow.inlets)
    inlets.append(py::dict("name"_a = inlet.name, "diameter_mm"_a = inlet.section.diameter_mm(),
                           "mean_flow_ml_s"_a = inlet.mean_flow_ml_s, "reynolds"_a = inlet.reynolds));
  for (const auto& outlet : flow.outlets)
    outlets.append(py::dict("name"_a = outlet.name, "diameter_mm"_a = outlet.diameter_mm,
                            "area_mm2"_a = outlet.area_mm2, "share"_a = outlet.share,
                            "resistance_pa_s_m3"_a = outlet.resistance_pa_s_m3));
  return py::dict("inlets"_a = inlets, "outlets"_a = outlets, "walls"_a = flow.walls,
                  "mean_flow_ml_s"_a = flow.mean_flow_ml_s);
}

void warn(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) core::log_warning(text);
}

void bind_cases(py::module_& m) {
  std::string text = with_options<OpenfoamCaseOptions>(
      m, "write_openfoam_case",
      "A case of laminar blood flow that OpenFOAM runs as it is, into a folder, whole or not at all. Returns "
      "what flows: inlets, outlets (mm, ml/s); of a pulsatile one about how many steps and hours, too. flow: "
      "options of its own, flow={\"outlets\": \"split\", \"waveform\": ostia.waveform(\"coronary-left\")}.");
  m.def(
      "write_openfoam_case",
      [](const fs::path& folder, const MixedMesh& mesh, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<OpenfoamCaseOptions>(options);
        solver::validate(how);
        const auto made = watched(progress, [&](const TaskContext& task) {
          auto result = solver::write_openfoam_case(mesh, how, folder, task);
          warn(result.warnings);
          return result;
        });
        py::dict shown = flow_shown(made.flow);
        shown["time_step_s"] = made.time_step_s;
        shown["steps"] = made.steps;
        shown["hours"] = made.hours;
        return shown;
      },
      py::arg("folder"), py::arg("mesh"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<SvmultiphysicsCaseOptions>(m, "write_svmultiphysics_case",
                                                 "Input of SimVascular's svMultiPhysics, into a folder, "
                                                 "whole or not at all. Returns what flows: inlets, "
                                                 "outlets (mm, ml/s).");
  m.def(
      "write_svmultiphysics_case",
      [](const fs::path& folder, const MixedMesh& mesh, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<SvmultiphysicsCaseOptions>(options);
        solver::validate(how);
        return flow_shown(watched(progress, [&](const TaskContext& task) {
                            auto result = solver::write_svmultiphysics_case(mesh, how, folder, task);
                            warn(result.warnings);
                            return result;
                          }).flow);
      },
      py::arg("folder"), py::arg("mesh"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  m.def(
      "continue_openfoam_case",
      [](const fs::path& folder, const std::optional<int>& iterations, const std::optional<int>& cycles) {
        return figures(unlocked([&] { return solver::continue_openfoam_case(folder, iterations, cycles); }));
      },
      py::arg("folder"), py::kw_only(), py::arg("iterations") = py::none(), py::arg("cycles") = py::none(),
      "Lets a case go on for longer with the fields that it has: {pulsatile, now, end}.");
  m.def(
      "waveform", [](const std::string& name) { return members_shown(solver::builtin_waveform(name)); },
      py::arg("name"),
      "A built-in flow over one cycle, coronary-left or coronary-right: {time_s, flow_ml_s, period_s, "
      "relative}, as the option flow.waveform takes it.");
}

py::list ends_shown(const FlowResult& result) {
  py::list rows;
  for (const auto& end : result.ends)
    rows.append(py::dict(
        "name"_a = end.name, "kind"_a = end.kind == geometry::FaceKind::inlet ? "inlet" : "outlet",
        "area_mm2"_a = end.area_mm2, "flow_ml_s"_a = end.flow_ml_s, "pressure_pa"_a = end.pressure_pa));
  return rows;
}

void bind_results(py::module_& m) {
  py::class_<FlowResult, std::shared_ptr<FlowResult>>(m, "FlowResult", "A finished run of a case.")
      .def_property_readonly("mesh", part(&FlowResult::mesh), "MixedMesh, mm")
      .def_property_readonly(
          "wall",
          [](const py::object& self) { return part_of(self.cast<FlowResult&>().wall.surface.mesh, self); },
          "TriMesh, mm")
      .def_property_readonly(
          "wall_fields", [](const FlowResult& r) { return field_arrays(solver::wall_fields(r)); },
          "At the wall's n points: wall_shear_stress_Pa (n,), its vector (n, 3), pressure_Pa ...; of a "
          "pulsatile flow time averages, oscillatory index and residence time, too")
      .def_property_readonly(
          "cell_fields", [](const FlowResult& r) { return field_arrays(solver::volume_fields(r).cells); },
          "At the mesh's m elements: velocity_m_s (m, 3), pressure_Pa (m,)")
      .def_property_readonly(
          "point_fields", [](const FlowResult& r) { return field_arrays(solver::volume_fields(r).points); },
          "At the mesh's n points: velocity_m_s (n, 3), pressure_Pa (n,)")
      .def_property_readonly("ends", &ends_shown, "Inlets, then outlets: ml/s, Pa, mm2")
      .def_property_readonly("mass_balance_error", &FlowResult::mass_balance_error,
                             "What flows in and not out, relative")
      .def_property_readonly(
          "converged", [](const FlowResult& r) { return r.run.converged; }, "As the run's log has it")
      .def("__repr__", [](const FlowResult& r) {
        return py::str("<ostia.FlowResult of {}: {} ends, {}converged>")
            .format(r.run.program, r.ends.size(), r.run.converged ? "" : "not ");
      });
  m.def(
      "read_flow_result",
      [](const fs::path& folder, const fs::path& mesh, const py::object& progress) {
        return std::make_shared<FlowResult>(watched(
            progress, [&](const TaskContext& task) { return solver::read_flow_result(folder, mesh, task); }));
      },
      py::arg("folder"), py::arg("mesh") = fs::path(), py::kw_only(), py::arg("progress") = py::none(),
      "Of the folder of a case of OpenFOAM that was run; mesh: a file, where the case's own mesh.vtu is "
      "gone.");
  std::string text = with_options<ShearLimits>(
      m, "flow_report",
      "Flows, pressures and wall shear stress of a run, as result.json has them, and whether to trust them "
      "(passed, reasons).");
  m.def(
      "flow_report",
      [](const FlowResult& result, const py::kwargs& options) {
        const auto limits = options_of<ShearLimits>(options);
        solver::validate(limits);
        const auto report = unlocked([&] { return solver::flow_report(result, limits); });
        py::object shown = json_of(solver::report_json(result, report));
        shown["passed"] = report.passed();
        shown["reasons"] = report.reasons;
        return shown;
      },
      py::arg("result"), text.c_str());
  text =
      with_options<ShearLimits>(m, "write_flow_result",
                                "Fields, wall, tables and pictures of a run into a folder, whole or not at "
                                "all.");
  m.def(
      "write_flow_result",
      [](const fs::path& folder, const FlowResult& result, const py::object& progress,
         const py::kwargs& options) {
        const auto limits = options_of<ShearLimits>(options);
        solver::validate(limits);
        run_watched(progress, [&](const TaskContext& task) {
          core::StagedFolder staged(folder);
          solver::write_flow_files(result, solver::flow_report(result, limits), staged.temporary(), task);
          staged.commit();
        });
      },
      py::arg("folder"), py::arg("result"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_solver(py::module_& m) {
  bind_cases(m);
  bind_results(m);
}

}  // namespace ostia::python
