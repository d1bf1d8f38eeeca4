#include "case.h"

#include "call.h"
#include "errors.h"

#include "ostia/core/error.h"
#include "ostia/session/case_file.h"
#include "ostia/session/edit_json.h"
#include "ostia/session/replay.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>
#include <optional>
#include <utility>

namespace ostia::python {
namespace {

namespace fs = std::filesystem;
using lumen::LumenModel;
using session::CaseFile;
using session::JournalEntry;

std::shared_ptr<LumenModel> shared(const std::shared_ptr<const LumenModel>& model) {
  return std::const_pointer_cast<LumenModel>(model);  // Python has no way to change one
}

/// An open case, used by one thread at a time.
class Case {
 public:
  explicit Case(CaseFile file) : file_(std::move(file)) {}

  /// Runs `work` on the file without the interpreter's lock.
  template <class Work>
  auto with_file(Work&& work) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock())
      throw UsageError("case: another thread is at work in it; take turns, or open it twice");
    if (!file_) throw UsageError("case: it is closed; open it again");
    return unlocked([&] { return work(*file_); });
  }
  void close() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) throw UsageError("case: another thread is at work in it");
    // Closed for all who look, before the file is, which takes a while.
    std::optional<CaseFile> closing = std::move(file_);
    file_.reset();
    unlocked([&] { closing.reset(); });
  }
  bool closed() const { return !file_; }

 private:
  std::mutex mutex_;
  std::optional<CaseFile> file_;
};

py::dict shown(const JournalEntry& entry) {
  using py::literals::operator""_a;
  return py::dict("number"_a = entry.number, "op"_a = entry.op,
                  "parameters"_a = entry.parameters.empty()
                                       ? py::none()
                                       : py::module_::import("json").attr("loads")(entry.parameters),
                  "undone"_a = entry.undone, "dropped"_a = entry.dropped, "notes"_a = entry.notes,
                  "time_s"_a = entry.time_s, "author"_a = entry.author);
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
      .def("redo", [](Case& file) { return stepped(file, [](CaseFile& f) { return f.redo(); }); })
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
          py::arg("path"), py::arg("read_only") = false)
      .def_property_readonly(
          "model", [](Case& file) { return shared(file.with_file([](CaseFile& f) { return f.model(); })); },
          "LumenModel as it is now")
      .def_property_readonly(
          "starting_model",
          [](Case& file) { return shared(file.with_file([](CaseFile& f) { return f.starting_model(); })); })
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
          "editable", [](Case& file) { return file.with_file([](CaseFile& f) { return f.editable(); }); })
      .def("close", &Case::close)
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](Case& file, const py::args&) { file.close(); })
      .def("__repr__", [](Case& file) {
        if (file.closed()) return py::str("<ostia.Case, closed>");
        const auto model = file.with_file([](CaseFile& f) { return f.model(); });
        const auto steps = file.with_file([](CaseFile& f) { return f.edits().size(); });
        return py::str("<ostia.Case: {} vessels, {} edits>").format(model->vessels.size(), steps);
      });
  bind_steps(type);
}

}  // namespace ostia::python
