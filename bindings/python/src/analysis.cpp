#include "array.h"
#include "call.h"
#include "options.h"
#include "rooms.h"
#include "walls.h"

#include "ostia/analysis/lumen_profile.h"
#include "ostia/analysis/ostial_way.h"
#include "ostia/analysis/stenosis.h"

#include <pybind11/stl.h>

namespace ostia::python {

using analysis::LumenProfile;
using analysis::ProfileOptions;
using analysis::Stenosis;
using analysis::StenosisOptions;
OSTIA_OPTIONS(ProfileOptions, (step_mm, around), ())
OSTIA_OPTIONS(StenosisOptions, (least_percent, least_length_mm), ())

namespace {

/// One number of all sections, (n,).
template <class T>
auto column(T analysis::SectionMeasures::*member) {
  return [member](const LumenProfile& profile) {
    py::array_t<T> out(static_cast<py::ssize_t>(profile.sections.size()));
    for (std::size_t i = 0; i < profile.sections.size(); ++i)
      out.mutable_at(static_cast<py::ssize_t>(i)) = profile.sections[i].*member;
    return out;
  };
}

py::array centroids(const LumenProfile& profile) {
  py::array_t<double> out({static_cast<py::ssize_t>(profile.sections.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < profile.sections.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      out.mutable_at(static_cast<py::ssize_t>(i), axis) = profile.sections[i].centroid[axis];
  return out;
}

/// As a case's report finds them: the reference line knows the ostia on the vessel's way and its branches.
std::vector<Stenosis> stenoses_of(const lumen::LumenModel& model, const SolvedWalls& walls,
                                  std::int32_t vessel, const LumenProfile& profile,
                                  const StenosisOptions& how) {
  const auto ostia = analysis::ostia_of(model, walls, vessel);
  const auto line = analysis::reference_line(profile, analysis::branch_abscissas(model, vessel),
                                             analysis::reading_from_ostium(ostia));
  return analysis::find_stenoses(profile, line, how);
}

void bind_profile(py::module_& m) {
  using Section = analysis::SectionMeasures;
  py::class_<LumenProfile, std::shared_ptr<LumenProfile>>(
      m, "LumenProfile", "Sections along a vessel, one row each, from the root to its end.")
      .def_readonly("vessel", &LumenProfile::vessel)
      .def_readonly("length_mm", &LumenProfile::length_mm)
      .def_property_readonly("s_mm", column(&Section::s_mm))
      .def_property_readonly("found", column(&Section::found), "False: no lumen there, its measures are 0")
      .def_property_readonly("area_mm2", column(&Section::area_mm2))
      .def_property_readonly("perimeter_mm", column(&Section::perimeter_mm))
      .def_property_readonly("diameter_mm", column(&Section::diameter_mm), "of the circle of the same area")
      .def_property_readonly("least_diameter_mm", column(&Section::least_diameter_mm))
      .def_property_readonly("largest_diameter_mm", column(&Section::largest_diameter_mm))
      .def_property_readonly("centroid", &centroids, "(n, 3), mm")
      .def(
          "volume_mm3",
          [](const LumenProfile& profile, double from_mm, double to_mm) {
            return analysis::volume_mm3(profile, from_mm, to_mm);
          },
          py::arg("from_mm"), py::arg("to_mm"))
      .def("__len__", [](const LumenProfile& profile) { return profile.sections.size(); })
      .def("__repr__", [](const LumenProfile& p) {
        return py::str("<ostia.LumenProfile of vessel {}: {} sections, {:.4g} mm>")
            .format(p.vessel, p.sections.size(), p.length_mm);
      });
  const std::string text = with_options<ProfileOptions>(
      m, "lumen_profile", "The lumen's size along a vessel (its id), on its solved walls.");
  m.def(
      "lumen_profile",
      [](const lumen::LumenModel& model, std::int32_t vessel, const std::shared_ptr<SolvedWalls>& walls,
         const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<ProfileOptions>(options);
        return watched(progress, [&](const auto& task) {
          const SolvedWalls solved_now = walls ? *walls : solved(model, task.sub(0.0, 0.5));
          return analysis::lumen_profile(model, solved_now, vessel, how, task.sub(0.5, 1.0));
        });
      },
      py::arg("model"), py::arg("vessel"), py::arg("walls") = py::none(), py::kw_only(),
      py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_analysis(py::module_& m) {
  bind_profile(m);
  py::class_<Stenosis>(m, "Stenosis", "A narrowing of one vessel, mm along its axis.")
      .def_readonly("vessel", &Stenosis::vessel)
      .def_readonly("from_mm", &Stenosis::from_mm)
      .def_readonly("to_mm", &Stenosis::to_mm)
      .def_readonly("throat_mm", &Stenosis::throat_mm)
      .def_property_readonly("length_mm", &Stenosis::length_mm)
      .def_readonly("least_diameter_mm", &Stenosis::least_diameter_mm)
      .def_readonly("least_area_mm2", &Stenosis::least_area_mm2)
      .def_readonly("reference_diameter_mm", &Stenosis::reference_diameter_mm)
      .def_readonly("reference_area_mm2", &Stenosis::reference_area_mm2)
      .def_readonly("diameter_percent", &Stenosis::diameter_percent)
      .def_readonly("area_percent", &Stenosis::area_percent)
      .def_property_readonly(
          "cad_rads",
          [](const Stenosis& s) { return analysis::to_string(analysis::cad_rads(s.diameter_percent)); })
      .def("__repr__", [](const Stenosis& s) {
        return py::str("<ostia.Stenosis of vessel {} at {:.1f} mm: {:.0f} % of diameter>")
            .format(s.vessel, s.throat_mm, s.diameter_percent);
      });
  const std::string text = with_options<StenosisOptions>(
      m, "find_stenoses", "The narrowings of a vessel (its id) against its reference line.");
  m.def(
      "find_stenoses",
      [](const lumen::LumenModel& model, std::int32_t vessel, const std::shared_ptr<SolvedWalls>& walls,
         const std::shared_ptr<LumenProfile>& profile, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<StenosisOptions>(options);
        return watched(progress, [&](const auto& task) {
          const SolvedWalls solved_now = walls ? *walls : solved(model, task.sub(0.0, 0.5));
          const LumenProfile measured =
              profile ? *profile : analysis::lumen_profile(model, solved_now, vessel, {}, task.sub(0.5, 1.0));
          return stenoses_of(model, solved_now, vessel, measured, how);
        });
      },
      py::arg("model"), py::arg("vessel"), py::arg("walls") = py::none(), py::arg("profile") = py::none(),
      py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace ostia::python
