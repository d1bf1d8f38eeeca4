#include "array.h"
#include "call.h"
#include "options.h"
#include "rooms.h"
#include "values.h"

#include "ostia/centerline/extract_centerlines.h"

#include <pybind11/stl.h>

namespace ostia::python {

using centerline::CenterlineOptions;
OSTIA_OPTIONS(CenterlineOptions, (step_mm, smoothing_radii, recentre, merge_fraction, vessel_names),
              (keep_voronoi))

namespace {

using Result = centerline::CenterlineResult;

py::tuple state_of(const Result& r) {
  py::list lines;
  for (const auto& line : r.lines) lines.append(std::make_shared<geometry::Centerline>(line));
  return py::make_tuple(std::make_shared<geometry::VesselTree>(r.tree), lines, tuple_of(r.source),
                        r.source_radius, array_of(r.ends), array_of(r.end_radii), r.diagnostics.warnings);
}

std::shared_ptr<Result> result_of_state(const py::tuple& s) {
  auto made = std::make_shared<Result>();
  made->tree = s[0].cast<const geometry::VesselTree&>();
  for (const py::handle line : s[1]) made->lines.push_back(line.cast<const geometry::Centerline&>());
  made->source = place_of(s[2], "source");
  made->source_radius = s[3].cast<double>();
  made->ends = places_of(s[4], "ends");
  made->end_radii = numbers_of(s[5], "end_radii");
  made->diagnostics.warnings = s[6].cast<std::vector<std::string>>();
  return made;
}

}  // namespace

void bind_centerline(py::module_& m) {
  py::class_<Result, std::shared_ptr<Result>>(m, "Centerlines", "What extract_centerlines found.")
      .def_readonly("tree", &Result::tree, "VesselTree, split at bifurcations")
      .def_property_readonly(
          "lines",
          [](const py::object& self) {
            py::list lines;
            for (const auto& line : self.cast<const Result&>().lines)
              lines.append(py::cast(&line, py::return_value_policy::reference_internal, self));
            return lines;
          },
          "One Centerline a target, from the source.")
      .def_property_readonly(
          "source", [](const Result& r) { return tuple_of(r.source); }, "(x, y, z), as used, mm")
      .def_property_readonly(
          "ends", [](const py::object& self) { return view_of(self.cast<const Result&>().ends, self); },
          "(n, 3), the targets as used, mm")
      .def_property_readonly(
          "warnings", [](const Result& r) { return r.diagnostics.warnings; }, "What a person should know.")
      .def("__repr__",
           [](const Result& r) {
             return py::str("<ostia.Centerlines: {} lines, {} vessels>")
                 .format(r.lines.size(), r.tree.vessels.size());
           })
      .def(py::pickle(&state_of, &result_of_state));
  const std::string text = with_options<CenterlineOptions>(
      m, "extract_centerlines",
      "Centerlines of a lumen from `source` (x, y, z), mm (None: the widest "
      "open end) to each of `targets` (n, 3), mm (None: the other open ends).");
  m.def(
      "extract_centerlines",
      [](const geometry::TriMesh& lumen, const py::object& source, const py::object& targets,
         const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<CenterlineOptions>(options);
        std::optional<geometry::Vec3> from;
        if (!source.is_none()) from = place_of(source, "source");
        const auto to = places_of(targets, "targets");
        return watched(progress, [&](const auto& task) {
          return centerline::extract_centerlines(lumen, from, to, how, task);
        });
      },
      py::arg("lumen"), py::arg("source") = py::none(), py::arg("targets") = py::none(), py::kw_only(),
      py::arg("progress") = py::none(), text.c_str());
}

}  // namespace ostia::python
