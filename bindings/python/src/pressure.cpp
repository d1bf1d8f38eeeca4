#include "call.h"
#include "figures.h"
#include "options.h"
#include "session_parts.h"
#include "values.h"
#include "volume.h"
#include "walls.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/session/pressure_report.h"
#include "ostia/session/pressure_wall.h"
#include "ostia/session/pressure_wall_spread.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using hemodynamics::Conditions;
using hemodynamics::FlowModel;
using hemodynamics::JunctionLaw;
using hemodynamics::NetworkFormat;
using hemodynamics::PulseOptions;
using hemodynamics::ReadingOptions;
using hemodynamics::UncertaintyOptions;
using hemodynamics::WallSpread;
using session::PressureReportOptions;
using session::WhatIf;
using session::WhatIfKind;

template <>
struct WordsOf<JunctionLaw> {
  static constexpr std::pair<const char*, JunctionLaw> words[] = {{"none", JunctionLaw::none},
                                                                  {"unified", JunctionLaw::unified}};
};
template <>
struct WordsOf<NetworkFormat> {
  static constexpr std::pair<const char*, NetworkFormat> words[] = {{"svzerod", NetworkFormat::svzerod},
                                                                    {"svoned", NetworkFormat::svoned},
                                                                    {"openbf", NetworkFormat::openbf}};
};
template <>
struct WordsOf<WhatIfKind> {
  static constexpr std::pair<const char*, WhatIfKind> words[] = {{"open", WhatIfKind::open},
                                                                 {"narrow", WhatIfKind::narrow}};
};
OSTIA_OPTIONS(Conditions,
              (systolic_mmhg, diastolic_mmhg, mean_share, venous_mmhg, heart_rate_bpm, density_kg_m3,
               viscosity_mpa_s, rest_flow_ml_min, lv_mass_g, rest_flow_ml_min_g, supplied_share,
               calibre_factor, calibre_exponent, split_exponent, hyperaemic_resistance),
              ())
OSTIA_OPTIONS(ReadingOptions, (behind_mm, least_seen_mm, ectasia, threshold), ())
OSTIA_OPTIONS(PulseOptions, (steps, most_beats, compliance_s_mmhg, right_muscle_share, left_muscle_share), ())
OSTIA_OPTIONS(FlowModel,
              (inertia, bends, junctions, from_rest, root_momentum, development, layer_friction,
               adverse_friction, backflow, jet_spread, step_mm),
              (density_kg_m3, viscosity_mpa_s, inertia_scale))  // the conditions' blood; the solver's own
OSTIA_OPTIONS(WhatIf, (vessel, from_mm, to_mm, kind, percent), ())
OSTIA_OPTIONS(WallSpread, (radius_sd_mm, most_relative, correlation_mm, common_share),
              (station_sd_mm, source))                                        // of an image
OSTIA_OPTIONS(UncertaintyOptions, (samples, seed, indices, wall), (spreads))  // by uncertainty_inputs
OSTIA_OPTIONS(PressureReportOptions,
              (conditions, model, reading, pulse, pulse_options, unusual, what_ifs, exports, uncertainty), ())

namespace {

namespace fs = std::filesystem;
using core::TaskContext;
using geometry::TriMesh;
using geometry::VesselTree;
using lumen::LumenModel;
using session::PressureReport;

/// What is asked, from Python's side; used without the interpreter's lock.
struct Asked {
  const LumenModel* model = nullptr;  // either
  const VesselTree* tree = nullptr;   // or
  std::shared_ptr<const imaging::ImageVolume> image;
  PressureReportOptions how;
};

Asked asked_of(const py::object& of, const py::object& image, const py::object& uncertainty_inputs,
               const py::kwargs& options) {
  Asked asked;
  asked.how = options_of<PressureReportOptions>(options);
  hemodynamics::validate(asked.how.conditions, asked.how.unusual);
  for (const WhatIf& one : asked.how.what_ifs) session::validate(one);
  if (!uncertainty_inputs.is_none()) {
    if (!asked.how.uncertainty) asked.how.uncertainty.emplace();
    const py::dict wrapped(py::arg("inputs") = uncertainty_inputs);
    asked.how.uncertainty = hemodynamics::uncertainty_of_json(
        py::module_::import("json").attr("dumps")(wrapped).cast<std::string>(), *asked.how.uncertainty);
  }
  if (asked.how.uncertainty) hemodynamics::validate(*asked.how.uncertainty);
  if (py::isinstance<LumenModel>(of)) asked.model = of.cast<const LumenModel*>();
  if (py::isinstance<VesselTree>(of)) asked.tree = of.cast<const VesselTree*>();
  if (asked.model == nullptr && asked.tree == nullptr) refuse_call("of: a LumenModel or a VesselTree");
  if (image.is_none()) return asked;
  if (asked.model == nullptr)
    refuse_call("image: a tree has no walls that an image could tell the spread of");
  if (!asked.how.uncertainty) refuse_call("image: it tells how sure walls are; give uncertainty={}, too");
  if (!py::isinstance<AnyVolume>(image)) refuse_call("image: a Volume");
  asked.image = image.cast<const AnyVolume&>().shared_image("image");
  return asked;
}

PressureReport report_of(Asked asked, const TaskContext& task) {
  if (asked.tree != nullptr)
    return session::make_pressure_report(session::pressure_tree(*asked.tree, {}, task.sub(0.0, 0.8)),
                                         asked.how, task.sub(0.8, 1.0));
  const LumenModel& model = *asked.model;
  const auto surfaces = solved(model, task.sub(0.0, 0.4));
  session::PressureTree tree = session::pressure_tree(model, surfaces, {}, task.sub(0.4, 0.7));
  if (asked.image && asked.how.uncertainty)
    asked.how.uncertainty->wall = session::wall_spread_of_image(
        tree, model, surfaces, *asked.image, asked.how.uncertainty->wall, {}, task.sub(0.7, 0.8));
  return session::make_pressure_report(std::move(tree), asked.how, task.sub(0.8, 1.0));
}

constexpr const char* what_is_asked =
    " image: the CT that the model was made with, for how sure its walls are. uncertainty_inputs: how the "
    "inputs are spread, {\"systolic_mmhg\": 5}. Research only: no decision on a patient may rest on them.";

void bind_report(py::module_& m) {
  std::string text = with_options<PressureReportOptions>(
      m, "pressure",
      std::string(
          "Pressure and flow along a tree (a LumenModel, or a VesselTree of round vessels), as ffr.json "
          "has them: mmHg, ml/min, mm. uncertainty={}: also how sure they are; what_ifs: a list of "
          "{vessel, from_mm, to_mm, kind, percent}, as if stretches were opened or narrowed.") +
          what_is_asked);
  m.def(
      "pressure",
      [](const py::object& of, const py::object& image, const py::object& uncertainty_inputs,
         const py::object& progress, const py::kwargs& options) {
        const Asked asked = asked_of(of, image, uncertainty_inputs, options);
        return json_of(watched(progress, [&](const TaskContext& task) {
          return session::pressure_json(report_of(asked, task));
        }));
      },
      py::arg("of"), py::kw_only(), py::arg("image") = py::none(), py::arg("uncertainty_inputs") = py::none(),
      py::arg("progress") = py::none(), text.c_str());
  text = with_options<PressureReportOptions>(
      m, "write_pressure",
      std::string("The same as a folder, whole or not at all: ffr.json, a page, lines.vtp, tables, and cases "
                  "of other solvers (exports).") +
          what_is_asked);
  m.def(
      "write_pressure",
      [](const fs::path& folder, const py::object& of, const py::object& image,
         const py::object& uncertainty_inputs, const py::object& progress, const py::kwargs& options) {
        const Asked asked = asked_of(of, image, uncertainty_inputs, options);
        return json_of(watched(progress, [&](const TaskContext& task) {
          pipeline::require_free_folder(folder);
          PressureReport report = report_of(asked, task.sub(0.0, 0.9));
          for (const std::string& warning : report.warnings) core::log_warning(warning);
          if (asked.model != nullptr)
            report.wall = session::pressure_wall(report, *asked.model, task.sub(0.9, 1.0));
          session::write_pressure_report(folder, report, {"ffr", {}, "{}"}, 0.0);
          return session::pressure_json(report);
        }));
      },
      py::arg("folder"), py::arg("of"), py::kw_only(), py::arg("image") = py::none(),
      py::arg("uncertainty_inputs") = py::none(), py::arg("progress") = py::none(), text.c_str());
}

/// The wall's points with what their sections have.
py::dict fields_of(const session::WallPressures& at) {
  py::dict fields;
  fields["ffr"] = array_of(at.ffr);
  fields["resting_ratio"] = array_of(at.resting_ratio);
  fields["pressure_mmhg"] = array_of(at.pressure_mmhg);
  fields["wall_shear_pa"] = array_of(at.wall_shear_pa);
  fields["s_mm"] = array_of(at.s_mm);
  fields["vessel"] = array_of(at.vessel);
  fields["branch"] = array_of(at.branch);
  fields["occluded"] = array_of(at.occluded);
  return fields;
}

void bind_others(py::module_& m) {
  std::string text = with_options<PressureReportOptions>(
      m, "pressure_wall",
      "What is computed along the axes on the wall of a model: (TriMesh, fields at its n points, (n,) each: "
      "ffr, resting_ratio, pressure_mmhg, wall_shear_pa, s_mm, vessel, branch, occluded).");
  m.def(
      "pressure_wall",
      [](const LumenModel& of, const py::object& progress, const py::kwargs& options) {
        const Asked asked =
            asked_of(py::cast(&of, py::return_value_policy::reference), py::none(), py::none(), options);
        auto made = watched(progress, [&](const TaskContext& task) {
          return session::pressure_wall(report_of(asked, task.sub(0.0, 0.8)), of, task.sub(0.8, 1.0));
        });
        return py::make_tuple(std::make_shared<TriMesh>(std::move(made.wall)), fields_of(made.at_points));
      },
      py::arg("of"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<PressureReportOptions>(m, "export_network",
                                             "A tree under hyperaemia as a case of svZeroDSolver (svzerod), "
                                             "svOneDSolver (svoned) or openBF (openbf): "
                                             "{file name: text}.");
  m.def(
      "export_network",
      [](const py::object& of, const std::string& format, const py::object& progress,
         const py::kwargs& options) {
        const NetworkFormat as = hemodynamics::network_format(format);
        const Asked asked = asked_of(of, py::none(), py::none(), options);
        const auto files = watched(progress, [&](const TaskContext& task) {
          const PressureReport report = report_of(asked, task);
          return hemodynamics::export_network(*report.network, report.hyperaemia.boundary,
                                              report.hyperaemia.solution, as);
        });
        py::dict texts;
        for (const auto& file : files) texts[file.name.c_str()] = file.text;
        return texts;
      },
      py::arg("of"), py::arg("format"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_pressure(py::module_& m) {
  bind_report(m);
  bind_others(m);
}

}  // namespace ostia::python
