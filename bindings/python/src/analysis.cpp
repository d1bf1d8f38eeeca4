#include "array.h"
#include "call.h"
#include "options.h"
#include "rooms.h"
#include "values.h"
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

// A row a section, for pickles.
constexpr py::ssize_t section_numbers = 14;

py::tuple state_of(const LumenProfile& profile) {
  py::array_t<double> rows({static_cast<py::ssize_t>(profile.sections.size()), section_numbers});
  double* to = rows.mutable_data();
  for (const analysis::SectionMeasures& s : profile.sections)
    for (const double value :
         {s.s_mm, s.area_mm2, s.perimeter_mm, s.diameter_mm, s.least_diameter_mm, s.largest_diameter_mm,
          s.centroid.x(), s.centroid.y(), s.centroid.z(), s.normal.x(), s.normal.y(), s.normal.z(),
          s.found ? 1.0 : 0.0, s.open ? 1.0 : 0.0})
      *to++ = value;
  return py::make_tuple(profile.vessel, profile.options.step_mm, profile.options.around, profile.length_mm,
                        rows);
}

LumenProfile profile_of_state(const py::tuple& state) {
  LumenProfile profile{state[0].cast<std::int32_t>(),
                       {state[1].cast<double>(), state[2].cast<int>()},
                       state[3].cast<double>(),
                       {}};
  const py::array rows = taken(state[4], {"sections", 'f', 8, {-1, section_numbers}}, {true, true});
  const auto* v = static_cast<const double*>(rows.data());
  for (py::ssize_t i = 0; i < rows.shape(0); ++i, v += section_numbers) {
    analysis::SectionMeasures s;
    s.s_mm = v[0];
    s.area_mm2 = v[1];
    s.perimeter_mm = v[2];
    s.diameter_mm = v[3];
    s.least_diameter_mm = v[4];
    s.largest_diameter_mm = v[5];
    s.centroid = {v[6], v[7], v[8]};
    s.normal = {v[9], v[10], v[11]};
    s.found = v[12] != 0.0;
    s.open = v[13] != 0.0;
    profile.sections.push_back(s);
  }
  return profile;
}

py::tuple state_of(const Stenosis& s) {
  return py::make_tuple(s.vessel, s.from_mm, s.to_mm, s.throat_mm, s.proximal_mm, s.distal_mm,
                        s.least_diameter_mm, s.least_area_mm2, s.reference_diameter_mm, s.reference_area_mm2,
                        s.diameter_percent, s.area_percent);
}

Stenosis stenosis_of_state(const py::tuple& state) {
  const auto number = [&](std::size_t i) { return state[i].cast<double>(); };
  return {state[0].cast<std::int32_t>(),
          number(1),
          number(2),
          number(3),
          number(4),
          number(5),
          number(6),
          number(7),
          number(8),
          number(9),
          number(10),
          number(11)};
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
  py::class_<LumenProfile, std::shared_ptr<LumenProfile>> profiles(
      m, "LumenProfile",
      "Sections along a vessel, from the root to its end: n = len(profile), one number a section.");
  profiles.def_readonly("vessel", &LumenProfile::vessel, "Its id.")
      .def_readonly("length_mm", &LumenProfile::length_mm, "Of the vessel's axis.")
      .def_property_readonly("s_mm", column(&Section::s_mm), "(n,), along the axis from the root, mm")
      .def_property_readonly("found", column(&Section::found),
                             "(n,) bool; False: no lumen there, its measures are 0")
      .def_property_readonly("area_mm2", column(&Section::area_mm2), "(n,), mm2")
      .def_property_readonly("perimeter_mm", column(&Section::perimeter_mm), "(n,), mm")
      .def_property_readonly("diameter_mm", column(&Section::diameter_mm),
                             "(n,), of the circle of the same area, mm")
      .def_property_readonly("least_diameter_mm", column(&Section::least_diameter_mm),
                             "(n,), least distance of two parallel tangents, mm")
      .def_property_readonly("largest_diameter_mm", column(&Section::largest_diameter_mm),
                             "(n,), largest distance of two parallel tangents, mm")
      .def_property_readonly("centroid", &centroids, "(n, 3), of the area, mm, LPS")
      .def(
          "volume_mm3",
          [](const LumenProfile& profile, double from_mm, double to_mm) {
            return analysis::volume_mm3(profile, from_mm, to_mm);
          },
          py::arg("from_mm"), py::arg("to_mm"), "Of the lumen between two places on the axis, mm3.")
      .def("__len__", [](const LumenProfile& profile) { return profile.sections.size(); })
      .def("__repr__",
           [](const LumenProfile& p) {
             return py::str("<ostia.LumenProfile of vessel {}: {} sections, {:.4g} mm>")
                 .format(p.vessel, p.sections.size(), p.length_mm);
           })
      .def(py::pickle(py::overload_cast<const LumenProfile&>(&state_of), &profile_of_state));
  same_when_copied(profiles);
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
  py::class_<Stenosis> stenoses(m, "Stenosis",
                                "A narrowing of one vessel; places are mm along its axis from the root.");
  stenoses.def_readonly("vessel", &Stenosis::vessel, "Its id.")
      .def_readonly("from_mm", &Stenosis::from_mm, "Where it begins.")
      .def_readonly("to_mm", &Stenosis::to_mm, "Where it ends.")
      .def_readonly("throat_mm", &Stenosis::throat_mm, "Where the area is least.")
      .def_property_readonly("length_mm", &Stenosis::length_mm, "to_mm - from_mm")
      .def_readonly("least_diameter_mm", &Stenosis::least_diameter_mm, "Of the circle with the least area.")
      .def_readonly("least_area_mm2", &Stenosis::least_area_mm2, "At the throat.")
      .def_readonly("reference_diameter_mm", &Stenosis::reference_diameter_mm,
                    "At the throat, without the disease.")
      .def_readonly("reference_area_mm2", &Stenosis::reference_area_mm2,
                    "At the throat, without the disease.")
      .def_readonly("diameter_percent", &Stenosis::diameter_percent, "100 (1 - least / reference)")
      .def_readonly("area_percent", &Stenosis::area_percent, "100 (1 - least / reference)")
      .def_property_readonly(
          "cad_rads",
          [](const Stenosis& s) { return analysis::to_string(analysis::cad_rads(s.diameter_percent)); },
          "CAD-RADS category of this narrowing: '0' to '5', '4A', '4B'")
      .def("__repr__",
           [](const Stenosis& s) {
             return py::str("<ostia.Stenosis of vessel {} at {:.1f} mm: {:.0f} % of diameter>")
                 .format(s.vessel, s.throat_mm, s.diameter_percent);
           })
      .def(py::pickle(py::overload_cast<const Stenosis&>(&state_of), &stenosis_of_state));
  same_when_copied(stenoses);
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
