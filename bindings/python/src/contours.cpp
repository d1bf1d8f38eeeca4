#include "contours.h"

#include "options.h"
#include "values.h"

#include "ostia/core/error.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/contour_set.h"

#include <pybind11/stl.h>

namespace ostia::python {

using geometry::Health;

namespace {

using geometry::AxisCurve;
using geometry::Contour;
using geometry::ContourSection;
using geometry::ContourSet;
using geometry::Frame;

ContourSection section_of(const std::string& section, const std::string& vessel, const py::object& s_mm,
                          const py::sequence& contours, const std::string& observer,
                          const std::string& boundary, const py::object& health) {
  ContourSection made{section, vessel, observer, boundary, Health::healthy, {}};
  take(made.health, health, "health");
  if (boundary != "lumen" && boundary != "wall")
    throw InvalidInput("boundary: lumen or wall, not " + boundary);
  const auto abscissas = numbers_of(s_mm, "s_mm");
  if (abscissas.size() != contours.size())
    throw InvalidInput("s_mm: " + std::to_string(abscissas.size()) + " numbers for " +
                       std::to_string(contours.size()) + " contours; give one a contour");
  for (std::size_t i = 0; i < abscissas.size(); ++i)
    made.contours.push_back({abscissas[i], places_of(contours[i], "contours[" + std::to_string(i) + "]")});
  if (const auto fault = geometry::find_fault(made)) throw InvalidInput("contours: " + *fault);
  return made;
}

py::list rings_of(const ContourSection& section) {
  py::list rings;
  for (const Contour& contour : section.contours) rings.append(array_of(contour.points));
  return rings;
}

std::vector<double> abscissas_of(const ContourSection& section) {
  std::vector<double> all;
  for (const Contour& contour : section.contours) all.push_back(contour.s_mm);
  return all;
}

py::tuple state_of(const ContourSection& s) {
  return py::make_tuple(s.section, s.vessel, array_of(abscissas_of(s)), rings_of(s), s.observer, s.boundary,
                        detail::word_of(s.health));
}

ContourSection section_of_state(const py::tuple& s) {
  return section_of(s[0].cast<std::string>(), s[1].cast<std::string>(), s[2], s[3].cast<py::sequence>(),
                    s[4].cast<std::string>(), s[5].cast<std::string>(), s[6]);
}

void bind_sections(py::module_& m) {
  py::class_<ContourSection, std::shared_ptr<ContourSection>> section(
      m, "ContourSection", "A stretch of one vessel's boundary as one observer sees it.");
  section
      .def(py::init(&section_of), py::arg("section"), py::arg("vessel"), py::arg("s_mm"), py::arg("contours"),
           py::kw_only(), py::arg("observer") = "observer1", py::arg("boundary") = "lumen",
           py::arg("health") = "healthy",
           "contours: closed lines of (n, 3) places each, mm, by rising s_mm (k,); counter-clockwise for one "
           "who looks distally, the first place not repeated.")
      .def_readonly("section", &ContourSection::section, "Key, the same for all observers of the stretch.")
      .def_readonly("vessel", &ContourSection::vessel, "The vessel's name.")
      .def_readonly("observer", &ContourSection::observer, "truth, observer1, ...")
      .def_readonly("boundary", &ContourSection::boundary, "lumen or wall")
      .def_property_readonly(
          "health", [](const ContourSection& s) { return detail::word_of(s.health); }, "healthy or diseased")
      .def_property_readonly(
          "s_mm", [](const ContourSection& s) { return array_of(abscissas_of(s)); },
          "(k,), mm along the vessel's axis")
      .def_property_readonly("contours", &rings_of, "k arrays of (n, 3), mm")
      .def("__len__", [](const ContourSection& s) { return s.contours.size(); })
      .def("__repr__",
           [](const ContourSection& s) {
             return py::str("<ostia.ContourSection {} of {}: {} contours by {}, {}>")
                 .format(s.section, s.vessel, s.contours.size(), s.observer, detail::word_of(s.health));
           })
      .def(py::pickle(&state_of, &section_of_state));
  same_when_copied(section);
  py::class_<ContourSet, std::shared_ptr<ContourSet>> set(
      m, "ContourSet", "Sections of vessels, of several observers perhaps.");
  set.def(py::init([](std::vector<ContourSection> sections) { return ContourSet{std::move(sections)}; }),
          py::arg("sections"))
      .def_property_readonly(
          "sections", [](const ContourSet& s) { return s.sections; }, "A list of ContourSection.")
      .def("__len__", [](const ContourSet& s) { return s.sections.size(); })
      .def("__repr__",
           [](const ContourSet& s) {
             return py::str("<ostia.ContourSet of {} sections>").format(s.sections.size());
           })
      .def(py::pickle(
          [](const ContourSet& s) { return py::make_tuple(s.sections); },
          [](const py::tuple& s) { return ContourSet{s[0].cast<std::vector<ContourSection>>()}; }));
  same_when_copied(set);
}

void bind_frames(py::module_& m) {
  py::class_<Frame> frame(m, "Frame",
                          "Right-handed axes at a place of a vessel's axis, unit vectors (x, y, z): binormal "
                          "= tangent x normal.");
  frame
      .def(py::init([](const py::object& tangent, const py::object& normal) {
             const geometry::Vec3 t = place_of(tangent, "tangent"), n = place_of(normal, "normal");
             const geometry::Vec3 across = n - t.normalized() * t.normalized().dot(n);
             if (!(t.norm() > 0.0) || !(across.norm() > 1e-9 * n.norm()))
               throw InvalidInput("normal: not along the tangent, and neither of them of no length");
             const geometry::Vec3 along = t.normalized(), up = across.normalized();
             return Frame{along, up, along.cross(up)};
           }),
           py::arg("tangent"), py::arg("normal"))
      .def_property_readonly(
          "tangent", [](const Frame& f) { return tuple_of(f.tangent); }, "Unit, distal.")
      .def_property_readonly(
          "normal", [](const Frame& f) { return tuple_of(f.normal); }, "Unit; theta = 0.")
      .def_property_readonly(
          "binormal", [](const Frame& f) { return tuple_of(f.binormal); }, "Unit; theta = -90 degrees.")
      .def(
          "direction",
          [](const Frame& f, double theta) { return tuple_of(geometry::radial_direction(f, theta)); },
          py::arg("theta"),
          "The unit direction across the vessel at an angle, radians, counter-clockwise for one who looks "
          "distally.")
      .def(
          "angle",
          [](const Frame& f, const py::object& direction) {
            return geometry::angle_of(f, place_of(direction, "direction"));
          },
          py::arg("direction"),
          "The angle of the part of a direction (x, y, z) across the vessel, radians, (-pi, pi].")
      .def("__repr__",
           [](const Frame& f) { return py::str("<ostia.Frame along {}>").format(tuple_of(f.tangent)); })
      .def(py::pickle(
          [](const Frame& f) {
            return py::make_tuple(tuple_of(f.tangent), tuple_of(f.normal), tuple_of(f.binormal));
          },
          [](const py::tuple& s) {
            return Frame{place_of(s[0], "tangent"), place_of(s[1], "normal"), place_of(s[2], "binormal")};
          }));
  same_when_copied(frame);
}

void bind_curve(py::module_& m) {
  py::class_<AxisCurve, std::shared_ptr<AxisCurve>>(
      m, "AxisCurve",
      "A vessel's axis as a smooth curve in arc length: one definition for all that is on it.")
      .def(py::init([](const geometry::Centerline& axis) { return std::make_shared<AxisCurve>(axis); }),
           py::arg("axis"))
      .def_property_readonly("length", &AxisCurve::length, "mm")
      .def(
          "point", [](const AxisCurve& c, double s_mm) { return tuple_of(c.point(s_mm)); }, py::arg("s_mm"),
          "(x, y, z) at an abscissa, mm; beyond the ends, the ends.")
      .def("frame", &AxisCurve::frame, py::arg("s_mm"), "Frame there.")
      .def("radius", &AxisCurve::radius, py::arg("s_mm"), "mm, linear between the axis' points.")
      .def(
          "place",
          [](const AxisCurve& c, double s_mm, double theta, double rho_mm) {
            return tuple_of(c.place(s_mm, theta, rho_mm));
          },
          py::arg("s_mm"), py::arg("theta"), py::arg("rho_mm"),
          "(x, y, z) at an abscissa, an angle (radians) and a distance from the axis, mm.")
      .def(
          "foot",
          [](const AxisCurve& c, const py::object& place) {
            const auto foot = c.nearest_foot(place_of(place, "place"));
            return py::make_tuple(foot.s_mm, foot.theta, foot.rho_mm);
          },
          py::arg("place"),
          "(s_mm, theta, rho_mm) of a place (x, y, z), mm: where it is in the vessel's own coordinates.")
      .def("__repr__",
           [](const AxisCurve& c) { return py::str("<ostia.AxisCurve of {:.4g} mm>").format(c.length()); });
}

}  // namespace

void bind_contours(py::module_& m) {
  bind_frames(m);
  bind_curve(m);
  bind_sections(m);
}

}  // namespace ostia::python
