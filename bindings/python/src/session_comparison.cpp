// Two cases of one patient compared.

#include "call.h"
#include "case.h"
#include "session_parts.h"
#include "values.h"
#include "volume.h"
#include "walls.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/session/comparison.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <string>

namespace ostia::python {
namespace {

using core::TaskContext;

/// What is read of a case while it is this thread's.
struct CaseToCompare {
  std::shared_ptr<const lumen::LumenModel> model;
  std::shared_ptr<const session::Annotations> notes;
  std::vector<session::JournalEntry> journal;
  std::optional<session::ImageReference> image;
};

CaseToCompare case_to_compare(Case& file) {
  return file.with_file([](session::CaseFile& f) {
    return CaseToCompare{f.model(), f.annotations(), f.journal(), f.image()};
  });
}

session::ComparedCase measured_case(const CaseToCompare& of, const imaging::ImageVolume* image,
                                    const TaskContext& task) {
  session::ReportOptions options;
  options.image = of.image;
  const SolvedWalls surfaces = solved(*of.model, task.sub(0.0, 0.4));
  const session::CaseReport report = session::make_case_report(*of.model, surfaces, *of.notes, of.journal,
                                                               image, options, task.sub(0.4, 0.9));
  std::optional<session::CaseFat> fat;
  if (image != nullptr) fat = session::case_fat(*of.model, surfaces, *image, {}, task.sub(0.9, 1.0));
  return session::compared_case(*of.model, report, fat ? &*fat : nullptr);
}

}  // namespace

void bind_session_comparison(py::module_& m) {
  m.def(
      "compare_cases",
      [](Case& old_case, Case& new_case, const AnyVolume* old_image, const AnyVolume* new_image, bool anyway,
         const std::optional<std::filesystem::path>& repeatability, const py::object& progress) {
        session::ComparisonOptions options;
        options.anyway = anyway;
        if (repeatability)
          options.change.repeatability =
              session::repeatability_of_json(core::read_file(*repeatability), repeatability->string());
        const CaseToCompare before = case_to_compare(old_case), after = case_to_compare(new_case);
        const imaging::ImageVolume* was = old_image != nullptr ? &old_image->image("old_image") : nullptr;
        const imaging::ImageVolume* is = new_image != nullptr ? &new_image->image("new_image") : nullptr;
        return json_of(watched(progress, [&](const TaskContext& task) {
          session::ComparedCase first = measured_case(before, was, task.sub(0.0, 0.5));
          session::ComparedCase second = measured_case(after, is, task.sub(0.5, 1.0));
          const session::Comparison made =
              session::compare_cases(std::move(first), std::move(second), options);
          for (const std::string& warning : made.warnings) core::log_warning(warning);
          return session::comparison_json(made);
        }));
      },
      py::arg("old"), py::arg("new"), py::arg("old_image") = py::none(), py::arg("new_image") = py::none(),
      py::kw_only(), py::arg("anyway") = false, py::arg("repeatability") = py::none(),
      py::arg("progress") = py::none(),
      "What changed between two cases of one patient, as comparison.json has it. old_image, new_image: the "
      "CTs "
      "that they were made with (int16, HU), for plaque and fat. repeatability: a cohort.json of unchanged "
      "patients; without it none of the differences is called a change. anyway: trees that are hardly of one "
      "patient, too.");
}

}  // namespace ostia::python
