#include "call.h"
#include "case.h"
#include "options.h"
#include "rooms.h"
#include "session_parts.h"
#include "volume.h"

#include "ostia/core/files.h"
#include "ostia/core/private_folder.h"
#include "ostia/session/case_file.h"
#include "ostia/session/found_model.h"

#include <pybind11/stl.h>

#include <array>

namespace ostia::python {

namespace {

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
      .def_readonly("model", &FoundModel::model, "LumenModel: axes, names, walls")
      .def_readonly("doubts", &FoundModel::doubts, "one a vessel: why a person should look; empty where sure")
      .def_property_readonly(
          "confidence",
          [](const FoundModel& f) {
            std::vector<double> values;
            for (const auto& label : f.found.vessels.labels) values.push_back(label.confidence);
            return values;
          },
          "probability of each vessel's likeliest name")
      .def_property_readonly(
          "choices",
          [](const FoundModel& f) {
            std::vector<std::vector<std::pair<std::string, double>>> vessels;
            for (const auto& label : f.found.vessels.labels) {
              vessels.emplace_back();
              if (!label.likeliest.empty()) vessels.back().emplace_back(label.likeliest, label.confidence);
              if (!label.second.empty()) vessels.back().emplace_back(label.second, label.second_confidence);
            }
            return vessels;
          },
          "the names that each vessel may have, likeliest first, at most two: name, probability")
      .def_property_readonly(
          "probability",
          [](const FoundModel& f) {
            std::vector<double> values;
            for (const auto& one : f.found.certainty) values.push_back(one.probability);
            return values;
          },
          "that each vessel is a coronary artery and its axis lies in it; empty for a mask")
      .def_property_readonly(
          "pieces",
          [](const FoundModel& f) {
            std::vector<std::vector<std::array<double, 3>>> vessels;
            for (const auto& one : f.found.certainty) {
              vessels.emplace_back();
              for (const auto& piece : one.pieces)
                vessels.back().push_back({piece.from_mm, piece.to_mm, piece.probability});
            }
            return vessels;
          },
          "the same of each vessel's centimetres: from mm, to mm, probability")
      .def_property_readonly(
          "dominance",
          [](const FoundModel& f) { return std::string(coronary::word(f.found.vessels.dominance)); },
          "'right', 'left', 'balanced' or 'unknown'")
      .def_property_readonly(
          "left_out", [](const FoundModel& f) { return f.found.left_out; }, "branches not followed, and why")
      .def_property_readonly(
          "warnings", [](const FoundModel& f) { return f.found.warnings; }, "what a person should know")
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

}  // namespace

void bind_session(py::module_& m) {
  bind_edits(m);
  bind_found(m);
  bind_pressure(m);
  bind_session_walls(m);
  bind_session_tissues(m);
  bind_session_comparison(m);
  bind_case(m);
  bind_session_reports(m);
}

}  // namespace ostia::python
