#include "case.h"

#include "errors.h"
#include "values.h"

#include "ostia/session/annotation_json.h"
#include "ostia/session/edit_json.h"
#include "ostia/session/replay.h"
#include "ostia/session/report_digest.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {
namespace {

namespace fs = std::filesystem;
using lumen::LumenModel;
using session::CaseFile;
using session::JournalEntry;

std::shared_ptr<LumenModel> shared(const std::shared_ptr<const LumenModel>& model) {
  return std::const_pointer_cast<LumenModel>(model);  // Python has no way to change one
}

py::dict shown(const JournalEntry& entry) {
  using py::literals::operator""_a;
  return py::dict("number"_a = entry.number, "op"_a = entry.op,
                  "parameters"_a = entry.parameters.empty()
                                       ? py::none()
                                       : py::module_::import("json").attr("loads")(entry.parameters),
                  "undone"_a = entry.undone, "dropped"_a = entry.dropped, "notes"_a = entry.notes,
                  "time_s"_a = entry.time_s, "author"_a = entry.author);
}

/// A command's fields, as the journal has them, without what all have.
py::object fields_of(const session::AnnotationCommand& command) {
  py::object fields = json_of(session::to_json(command));
  for (const char* key : {"v", "op"}) fields.attr("pop")(key);
  return fields;
}

py::list measurements_of(Case& file) {
  py::list rows;
  const auto notes = file.with_file([](CaseFile& f) { return f.annotations(); });
  for (const auto& one : notes->measurements) rows.append(fields_of(session::MeasureChange{one}));
  return rows;
}

/// What the case keeps of its report, and the digests that a signature of it is for: without and with the
/// case's image at hand.
py::dict report_notes_of(Case& file) {
  const auto [model, notes, image] =
      file.with_file([](CaseFile& f) { return std::tuple(f.model(), f.annotations(), f.image()); });
  const session::ReportNotes& report = notes->report;
  py::dict modifiers = fields_of(session::SetReportModifiers{report.modifiers});
  py::list versions;
  for (const session::ReportVersion& one : report.versions) {
    py::dict version = fields_of(session::SignReport{one});
    version["number"] = versions.size() + 1;
    versions.append(version);
  }
  py::dict all;
  all["impression"] = report.impression;
  all["modifiers"] = modifiers;
  all["features"] = fields_of(session::SetPlaqueFeatures{report.features})["features"];
  all["calcium"] = fields_of(session::SetCalciumPlaces{report.calcium})["words"];
  all["versions"] = versions;
  all["digest"] = session::report_content_digest(*model, *notes);
  all["digest_with_image"] =
      image ? py::cast(session::report_content_digest(*model, *notes, image->sha256)) : py::none();
  return all;
}

py::list marks_of(Case& file) {
  py::list rows;
  const auto notes = file.with_file([](CaseFile& f) { return f.annotations(); });
  for (const auto& one : notes->marks) rows.append(fields_of(session::MarkVessel{one}));
  return rows;
}

/// The id of a new measurement; else None.
py::object annotated(Case& file, const py::object& op, const py::kwargs& fields) {
  const auto line = py::module_::import("ostia._edits").attr("line")(op, **fields).cast<std::string>();
  const session::AnnotationCommand command = session::annotation_of_json(line);
  const auto change = file.with_file([&](CaseFile& f) { return f.annotate(command); });
  if (!std::holds_alternative<session::MeasureAdd>(command) || change.measurements.empty()) return py::none();
  return py::int_(change.measurements.back());
}

void bind_notes(py::class_<Case, std::shared_ptr<Case>>& type) {
  type.def("annotate", &annotated, py::arg("op"),
           "A measurement, a mark, what pressures are told or the report says, committed to the file: "
           "'measure.add', "
           "'measure.change', 'measure.delete', 'vessel.mark', 'pressure.inputs', 'pressure.what_if', "
           "'report.impression', 'report.modifiers', 'report.features', 'report.sign', 'calcium.places', and "
           "fields "
           "by keyword, or a line of JSON. Returns the id of a new measurement.")
      .def_property_readonly(
          "measurements", &measurements_of,
          "A dictionary each: id, kind, name, points (places, mm), vessel, from_mm, to_mm, "
          "inner_mm, outer_mm")
      .def_property_readonly(
          "marks", &marks_of,
          "What is noted of vessels, a dictionary each: vessel, visible, checked, color, note, "
          "evaluable, lesions")
      .def_property_readonly(
          "report_notes", &report_notes_of,
          "What a person says of the report: impression, modifiers, features (words on those of high-risk "
          "plaque), calcium (words on lesions of a calcium score), versions that were signed, and the digest "
          "that a signature is for ('report.sign')")
      .def_property_readonly(
          "pressure_inputs",
          [](Case& file) {
            return file.with_file([](CaseFile& f) { return f.annotations(); })->pressure.inputs;
          },
          "What the case's pressures are told, {key: number}: the option `conditions` of pressure")
      .def_property_readonly(
          "what_ifs",
          [](Case& file) {
            const auto notes = file.with_file([](CaseFile& f) { return f.annotations(); });
            return fields_of(session::SetWhatIfs{notes->pressure.what_ifs})["stretches"].cast<py::object>();
          },
          "Stretches that are looked at as if they were otherwise, a dictionary each: the option of "
          "pressure");
}

/// Whether there was such a step.
template <class Step>
bool stepped(Case& file, const Step& step) {
  return file.with_file([&](CaseFile& f) { return step(f).has_value(); });
}

void bind_steps(py::class_<Case, std::shared_ptr<Case>>& type) {
  type.def(
          "edit",
          [](Case& file, const py::object& op, const py::kwargs& fields) {
            const lumen::Edit edit = edit_of(op, fields);
            return file.with_file([&](CaseFile& f) { return f.apply(edit); });
          },
          py::arg("op"),
          "An edit, committed to the file: its name, 'wall.push', and fields by keyword, or a line of JSON.")
      .def(
          "undo", [](Case& file) { return stepped(file, [](CaseFile& f) { return f.undo(); }); },
          "Takes the last step back; False where there is none.")
      .def(
          "redo", [](Case& file) { return stepped(file, [](CaseFile& f) { return f.redo(); }); },
          "Does the last step that was taken back again; False where there is none.")
      .def(
          "go_to_step",
          [](Case& file, std::int64_t number) {
            return stepped(file, [&](CaseFile& f) { return f.go_to_step(number); });
          },
          py::arg("number"), "Undoes or redoes until this step of the journal is the last that is done.")
      .def(
          "save_as",
          [](Case& file, const fs::path& path) { file.with_file([&](CaseFile& f) { f.copy_to(path); }); },
          py::arg("path"), "Another case with the same content, journal and all.")
      .def(
          "set_author",
          [](Case& file, const std::string& name) {
            file.with_file([&](CaseFile& f) { f.set_author(name); });
          },
          py::arg("name"), "Who does the steps from here on.")
      .def(
          "replay",
          [](Case& file, const py::object& progress) {
            return watched(progress, [&](const core::TaskContext& task) {
              const py::gil_scoped_acquire locked;
              return file.with_file([&](CaseFile& f) { return session::replay(f, task).same(); });
            });
          },
          py::kw_only(), py::arg("progress") = py::none(),
          "Whether the edits, applied anew to the first model, give the model that is stored, bit for bit.");
}

}  // namespace

void Case::close() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) throw UsageError("case: another thread is at work in it");
  // Closed for all who look, before the file is, which takes a while.
  std::optional<CaseFile> closing = std::move(file_);
  file_.reset();
  unlocked([&] { closing.reset(); });
}

lumen::Edit edit_of(const py::object& op, const py::kwargs& fields) {
  const auto line = py::module_::import("ostia._edits").attr("line")(op, **fields).cast<std::string>();
  return session::edit_of_json(line);
}

void bind_case(py::module_& m) {
  py::class_<Case, std::shared_ptr<Case>> type(m, "Case",
                                               "A case file (.ostia): a model with the journal of its edits. "
                                               "Every command is on disk when it returns.");
  type.def_static(
          "create",
          [](const fs::path& path, const LumenModel& model) {
            return std::make_shared<Case>(unlocked([&] { return CaseFile::create(path, model); }));
          },
          py::arg("path"), py::arg("model"), "A new case; refused where there is a file.")
      .def_static(
          "open",
          [](const fs::path& path, bool read_only) {
            const auto mode = read_only ? session::OpenMode::read_only : session::OpenMode::read_write;
            return std::make_shared<Case>(unlocked([&] { return CaseFile::open(path, mode); }));
          },
          py::arg("path"), py::arg("read_only") = false, "A case that is there.")
      .def_property_readonly(
          "model", [](Case& file) { return shared(file.with_file([](CaseFile& f) { return f.model(); })); },
          "LumenModel as it is now")
      .def_property_readonly(
          "starting_model",
          [](Case& file) { return shared(file.with_file([](CaseFile& f) { return f.starting_model(); })); },
          "LumenModel before all edits")
      .def_property_readonly(
          "journal",
          [](Case& file) {
            py::list list;
            for (const auto& entry : file.with_file([](CaseFile& f) { return f.journal(); }))
              list.append(shown(entry));
            return list;
          },
          "All steps: number, op, parameters, undone, dropped, notes, time_s, author")
      .def_property_readonly(
          "edits",
          [](Case& file) {
            std::vector<std::string> lines;
            for (const auto& edit : file.with_file([](CaseFile& f) { return f.edits(); }))
              lines.push_back(session::to_json(edit));
            return lines;
          },
          "Those not undone, each as a line of JSON")
      .def_property_readonly(
          "editable", [](Case& file) { return file.with_file([](CaseFile& f) { return f.editable(); }); },
          "False where it is open for reading alone")
      .def("close", &Case::close, "Ends the work on the file; `with` does it by itself.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](Case& file, const py::args&) { file.close(); })
      .def("__repr__", [](Case& file) {
        if (file.closed()) return py::str("<ostia.Case, closed>");
        const auto model = file.with_file([](CaseFile& f) { return f.model(); });
        const auto steps = file.with_file([](CaseFile& f) { return f.edits().size(); });
        return py::str("<ostia.Case: {} vessels, {} edits>").format(model->vessels.size(), steps);
      });
  bind_steps(type);
  bind_notes(type);
}

}  // namespace ostia::python
