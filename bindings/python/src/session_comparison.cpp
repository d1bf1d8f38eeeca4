// Two cases of one patient compared, and a tree carried from one scan to the next.

#include "call.h"
#include "case.h"
#include "options.h"
#include "session_parts.h"
#include "values.h"
#include "volume.h"
#include "walls.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/session/carry.h"
#include "ostia/session/comparison_measures.h"
#include "ostia/session/scan_map.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace ostia::python {

using session::CarryOptions;

OSTIA_OPTIONS(CarryOptions, (reach_mm, search, anyway), ())

namespace {

using core::TaskContext;

session::CaseMoment moment_of(Case& file, const AnyVolume* image, const std::string& argument,
                              std::optional<double> tube_kv) {
  session::CaseMoment moment =
      file.with_file([](session::CaseFile& opened) { return session::moment_of(opened); });
  if (image != nullptr) moment.image = image->shared_image(argument);
  moment.tube_kv = tube_kv;
  return moment;
}

session::ComparedCase measured(const session::CaseMoment& of, const TaskContext& task) {
  const SolvedWalls surfaces = solved(*of.model, task.sub(0.0, 0.4));
  return session::measured_case(of, surfaces, task.sub(0.4, 1.0));
}

session::Comparison compared(const session::CaseMoment& before, const session::CaseMoment& after,
                             const session::ComparisonOptions& options, session::MapBy by,
                             const TaskContext& task) {
  session::ComparedCase first = measured(before, task.sub(0.0, 0.4));
  session::ComparedCase second = measured(after, task.sub(0.4, 0.8));
  const session::MapOfImages laid = session::map_of_images(
      first.tree.tree, second.tree.tree, before.image.get(), after.image.get(), by, task.sub(0.8, 1.0));
  session::Comparison made = session::compare_cases(std::move(first), std::move(second), options, laid.map);
  if (!laid.why_not.empty()) made.warnings.push_back(laid.why_not);
  return made;
}

void bind_compare(py::module_& m) {
  m.def(
      "compare_cases",
      [](Case& old_case, Case& new_case, const AnyVolume* old_image, const AnyVolume* new_image, bool anyway,
         const std::optional<std::filesystem::path>& repeatability, const std::string& map,
         std::optional<double> old_tube_kv, std::optional<double> new_tube_kv, const py::object& progress) {
        session::ComparisonOptions options;
        options.anyway = anyway;
        if (repeatability)
          options.change.repeatability =
              session::repeatability_of_json(core::read_file(*repeatability), repeatability->string());
        const session::MapBy by = session::map_by(map);
        const session::CaseMoment before = moment_of(old_case, old_image, "old_image", old_tube_kv);
        const session::CaseMoment after = moment_of(new_case, new_image, "new_image", new_tube_kv);
        return json_of(watched(progress, [&](const TaskContext& task) {
          const session::Comparison made = compared(before, after, options, by, task);
          for (const std::string& warning : made.warnings) core::log_warning(warning);
          return session::comparison_json(made);
        }));
      },
      py::arg("old"), py::arg("new"), py::arg("old_image") = py::none(), py::arg("new_image") = py::none(),
      py::kw_only(), py::arg("anyway") = false, py::arg("repeatability") = py::none(), py::arg("map") = "any",
      py::arg("old_tube_kv") = py::none(), py::arg("new_tube_kv") = py::none(),
      py::arg("progress") = py::none(),
      "What changed between two cases of one patient, as comparison.json has it. old_image, new_image: the "
      "CTs that they were made with (int16, HU), for plaque and fat; old_tube_kv, new_tube_kv: their tube "
      "voltages, where they are known. map: what lays the scans onto each other, 'trees', 'images' or 'any': "
      "the images where both are given and fit well. repeatability: a cohort.json of unchanged patients; "
      "without it none of the differences is called a change. anyway: trees that are hardly of one patient, "
      "too.");
}

void bind_carry(py::module_& m) {
  const std::string text = with_options<CarryOptions>(
      m, "carry_case",
      "A checked tree carried onto a later scan of the same patient: what became of each vessel, as `ostia "
      "carry --json` says it. old_image: the CT that the case was made with, new_image: the later one "
      "(int16, "
      "HU). path: the case that is made; None: none is.");
  m.def(
      "carry_case",
      [](Case& old_case, const AnyVolume& old_image, const AnyVolume& new_image,
         const std::optional<std::filesystem::path>& path, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<CarryOptions>(options);
        const session::CaseMoment before = moment_of(old_case, &old_image, "old_image", {});
        const auto after = new_image.shared_image("new_image");
        return json_of(watched(progress, [&](const TaskContext& task) {
          const session::CarriedCase made =
              session::carry_case(*before.model, *before.annotations, *before.image, *after, how, task);
          for (const std::string& warning : made.warnings) core::log_warning(warning);
          task.throw_if_cancelled();
          if (path) session::create_case(*path, made.carried, {});
          return session::carried_json(made);
        }));
      },
      py::arg("old"), py::arg("old_image"), py::arg("new_image"), py::arg("path") = py::none(), py::kw_only(),
      py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_session_comparison(py::module_& m) {
  bind_compare(m);
  bind_carry(m);
}

}  // namespace ostia::python
