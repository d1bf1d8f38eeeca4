#include "call.h"
#include "case.h"
#include "options.h"
#include "rooms.h"
#include "volume.h"
#include "walls.h"

#include "ostia/core/files.h"
#include "ostia/core/private_folder.h"
#include "ostia/session/case_file.h"
#include "ostia/session/found_model.h"
#include "ostia/session/pressure_report.h"

#include <pybind11/stl.h>

namespace ostia::python {

using hemodynamics::Conditions;
using hemodynamics::PulseOptions;
using hemodynamics::ReadingOptions;

OSTIA_OPTIONS(Conditions,
              (systolic_mmhg, diastolic_mmhg, mean_share, venous_mmhg, heart_rate_bpm, density_kg_m3,
               viscosity_mpa_s, rest_flow_ml_min, lv_mass_g, rest_flow_ml_min_g, supplied_share,
               calibre_factor, calibre_exponent, split_exponent, hyperaemic_resistance),
              ())
OSTIA_OPTIONS(ReadingOptions, (behind_mm, least_seen_mm, ectasia, threshold), ())
OSTIA_OPTIONS(PulseOptions, (steps, most_beats, compliance_s_mmhg, right_muscle_share, left_muscle_share), ())

using session::PressureReportOptions;
OSTIA_OPTIONS(PressureReportOptions, (conditions, reading, pulse, pulse_options, unusual),
              (model, what_ifs, exports, uncertainty))  // by ostia.commands.ffr

namespace {

using geometry::VesselTree;
using lumen::LumenModel;

void bind_edits(py::module_& m) {
  py::class_<lumen::EditOutcome>(m, "Edited", "What an edit made.")
      .def_readonly("model", &lumen::EditOutcome::model, "LumenModel after it")
      .def_readonly("notes", &lumen::EditOutcome::notes, "what a person should know")
      .def_property_readonly(
          "vessels",
          [](const lumen::EditOutcome& e) {
            std::vector<std::int32_t> ids;
            for (const auto& change : e.changes) ids.push_back(change.vessel);
            return ids;
          },
          "ids of vessels that changed")
      .def("__repr__", [](const lumen::EditOutcome& e) {
        return py::str("<ostia.Edited: {} vessels changed>").format(e.changes.size());
      });
  m.def(
      "apply_edit",
      [](const LumenModel& model, const py::object& op, const py::kwargs& fields) {
        const lumen::Edit edit = edit_of(op, fields);
        return unlocked([&] { return lumen::apply(model, edit); });
      },
      py::arg("model"), py::arg("op"),
      "The model after an edit: its name, 'wall.push', and fields by keyword, or a line of JSON (docs: "
      "edits).");
  m.def("_model_bytes", [](const LumenModel& model) {
    const core::PrivateFolder folder;
    session::CaseFile::create(folder.path() / "model.ostia", model);
    return py::bytes(core::read_file(folder.path() / "model.ostia"));
  });
  m.def("_model_of_bytes", [](const py::bytes& bytes) {
    const core::PrivateFolder folder;
    core::write_file(folder.path() / "model.ostia", std::string(bytes));
    return std::const_pointer_cast<LumenModel>(
        session::CaseFile::open(folder.path() / "model.ostia", session::OpenMode::read_only).model());
  });
}

void bind_found(py::module_& m) {
  using session::FoundModel;
  py::class_<FoundModel, std::shared_ptr<FoundModel>>(m, "FoundModel",
                                                      "A coronary tree found without a click.")
      .def_readonly("model", &FoundModel::model)
      .def_readonly("doubts", &FoundModel::doubts, "one a vessel: why a person should look; empty where sure")
      .def_property_readonly(
          "confidence",
          [](const FoundModel& f) {
            std::vector<double> values;
            for (const auto& label : f.found.vessels.labels) values.push_back(label.confidence);
            return values;
          },
          "of each vessel's name")
      .def_property_readonly(
          "dominance",
          [](const FoundModel& f) { return std::string(coronary::word(f.found.vessels.dominance)); })
      .def_property_readonly("left_out", [](const FoundModel& f) { return f.found.left_out; })
      .def_property_readonly("warnings", [](const FoundModel& f) { return f.found.warnings; })
      .def(
          "save",
          [](const FoundModel& found, const std::filesystem::path& path) {
            unlocked([&] { session::create_case(path, found, {}); });
          },
          py::arg("path"), "A new case with the model and a mark for each vessel in doubt.")
      .def("__repr__", [](const FoundModel& f) {
        return py::str("<ostia.FoundModel: {} vessels>").format(f.model.vessels.size());
      });
  m.def(
      "extract",
      [](const AnyVolume& image, double least_confidence, const py::object& progress) {
        const imaging::ImageVolume& ct = image.image("image");
        coronary::ExtractOptions how;
        how.labels.least_confidence = least_confidence;
        return watched(progress, [&](const auto& task) { return session::found_model(ct, how, task); });
      },
      py::arg("image"), py::kw_only(),
      py::arg("least_confidence") = coronary::LabelOptions().least_confidence,
      py::arg("progress") = py::none(), "The coronary tree of a CT angiogram by itself.");
  m.def(
      "extract_mask",
      [](const AnyVolume& labels, double least_confidence, const py::object& progress) {
        const imaging::MaskVolume& mask = labels.mask("labels");
        coronary::MaskTreeOptions how;
        how.labels.least_confidence = least_confidence;
        return watched(progress, [&](const auto& task) {
          return session::model_of_mask(mask, nullptr, how, task).found;
        });
      },
      py::arg("labels"), py::kw_only(),
      py::arg("least_confidence") = coronary::LabelOptions().least_confidence,
      py::arg("progress") = py::none(), "The same of a mask of the coronary arteries.");
}

void bind_pressure(py::module_& m) {
  const std::string text =
      with_options<PressureReportOptions>(m, "pressure",
                                          "Pressure and flow along a tree (a LumenModel, or a VesselTree of "
                                          "round vessels), as ffr.json has them. Research "
                                          "only: no decision on a patient may rest on them.");
  m.def(
      "pressure",
      [](const py::object& of, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<PressureReportOptions>(options);
        hemodynamics::validate(how.conditions, how.unusual);
        const auto* model = py::isinstance<LumenModel>(of) ? of.cast<const LumenModel*>() : nullptr;
        const auto* tree = py::isinstance<VesselTree>(of) ? of.cast<const VesselTree*>() : nullptr;
        if (model == nullptr && tree == nullptr) refuse_call("of: a LumenModel or a VesselTree");
        const std::string json = watched(progress, [&](const core::TaskContext& task) {
          const auto part = task.sub(0.0, 0.9);
          session::PressureTree measured =
              model != nullptr
                  ? session::pressure_tree(*model, solved(*model, part.sub(0.0, 0.4)), {}, part.sub(0.4, 1.0))
                  : session::pressure_tree(*tree, {}, part);
          return session::pressure_json(
              session::make_pressure_report(std::move(measured), how, task.sub(0.9, 1.0)));
        });
        return py::module_::import("json").attr("loads")(json);
      },
      py::arg("of"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_session(py::module_& m) {
  bind_edits(m);
  bind_found(m);
  bind_pressure(m);
  bind_case(m);
}

}  // namespace ostia::python
