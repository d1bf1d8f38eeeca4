#include "array.h"
#include "call.h"
#include "options.h"
#include "rooms.h"
#include "values.h"
#include "walls.h"

#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"

#include <pybind11/stl.h>

namespace ostia::python {

using lumen::ImplicitSurface;
using lumen::LumenModel;
using lumen::SamplingOptions;
OSTIA_OPTIONS(SamplingOptions, (spacing_mm, least_spacing_mm, least_around), ())

std::shared_ptr<const lumen::ImplicitSurface> SolvedWalls::operator()(std::int32_t vessel) const {
  const auto found = surfaces.find(vessel);
  if (found == surfaces.end())
    throw InvalidInput("walls: they have no vessel " + std::to_string(vessel) +
                       "; solve the model that is asked of");
  return found->second;
}

SolvedWalls solved(const LumenModel& model, const core::TaskContext& task) {
  SolvedWalls walls;
  for (const auto& vessel : model.vessels) {
    task.throw_if_cancelled();
    walls.surfaces[vessel->vessel] = std::make_shared<const lumen::ImplicitSurface>(lumen::solve(*vessel));
    task.set_progress(static_cast<double>(walls.surfaces.size()) / static_cast<double>(model.vessels.size()));
  }
  return walls;
}

namespace {

/// Samples of a vessel's wall as arrays of their own.
py::dict samples_of(const LumenModel& model, std::int32_t vessel) {
  const auto& samples = lumen::vessel(model, vessel).samples;
  const auto count = static_cast<py::ssize_t>(samples.size());
  py::array_t<double> positions({count, py::ssize_t{3}}), normals({count, py::ssize_t{3}}), s_mm(count);
  py::array_t<std::int64_t> ids(count);
  py::array_t<std::uint8_t> origins(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const lumen::SurfaceSample& sample = samples[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < 3; ++axis) {
      positions.mutable_at(i, axis) = sample.position[axis];
      normals.mutable_at(i, axis) = sample.normal[axis];
    }
    s_mm.mutable_at(i) = sample.s_mm;
    ids.mutable_at(i) = sample.id;
    origins.mutable_at(i) = static_cast<std::uint8_t>(sample.origin);
  }
  using py::literals::operator""_a;
  return py::dict("id"_a = ids, "position"_a = positions, "normal"_a = normals, "s_mm"_a = s_mm,
                  "origin"_a = origins);
}

py::array values_at(const ImplicitSurface& surface, const py::object& places) {
  const std::vector<geometry::Vec3> where = places_of(places, "places");
  py::array_t<double> out(static_cast<py::ssize_t>(where.size()));
  const std::span<double> values(out.mutable_data(), where.size());
  unlocked([&] { surface.values(where, values); });
  return out;
}

py::array gradients_at(const ImplicitSurface& surface, const py::object& places) {
  const std::vector<geometry::Vec3> where = places_of(places, "places");
  return array_of(unlocked([&] {
    std::vector<geometry::Vec3> out;
    out.reserve(where.size());
    for (const geometry::Vec3& place : where) out.push_back(surface.gradient(place));
    return out;
  }));
}

std::shared_ptr<ImplicitSurface> implicit_of(const py::object& centres, const py::object& weights,
                                             double support_radius_mm, const std::string& kernel,
                                             const py::object& polynomial) {
  lumen::ImplicitCoefficients c;
  c.kernel = lumen::kernel_named(kernel);
  c.support_radius_mm = support_radius_mm;
  c.centres = places_of(centres, "centres");
  c.weights = numbers_of(weights, "weights");
  const auto line = numbers_of(polynomial, "polynomial");
  if (line.size() != 4) throw InvalidInput("polynomial: q0, q1, q2, q3 of q0 + q1 x + q2 y + q3 z");
  std::copy(line.begin(), line.end(), c.polynomial.begin());
  return std::make_shared<ImplicitSurface>(std::move(c));
}

py::tuple state_of(const ImplicitSurface& surface) {
  const auto& c = surface.coefficients();
  return py::make_tuple(array_of(c.centres), array_of(c.weights), c.support_radius_mm, lumen::name(c.kernel),
                        array_of(std::vector<double>(c.polynomial.begin(), c.polynomial.end())));
}

void bind_implicit(py::module_& m) {
  py::class_<ImplicitSurface, std::shared_ptr<ImplicitSurface>> type(
      m, "ImplicitSurface",
      "f(p) = sum w_j phi(|p - c_j| / support) + polynomial, with a kernel phi of compact support: negative "
      "inside a wall. centres (n, 3), mm; weights (n,); polynomial (4,); kernel morse-c0, wendland-c2 or "
      "wendland-c4.");
  type.def(py::init(&implicit_of), py::arg("centres"), py::arg("weights"), py::arg("support_radius_mm"),
           py::kw_only(), py::arg("kernel") = "wendland-c2",
           py::arg("polynomial") = std::vector<double>{0.0, 0.0, 0.0, 0.0})
      .def_property_readonly(
          "centres",
          [](const py::object& self) {
            return view_of(self.cast<const ImplicitSurface&>().coefficients().centres, self);
          },
          "(n, 3) float64, mm")
      .def_property_readonly(
          "weights",
          [](const py::object& self) {
            return view_of(self.cast<const ImplicitSurface&>().coefficients().weights, self);
          },
          "(n,) float64, mm")
      .def_property_readonly(
          "polynomial",
          [](const ImplicitSurface& s) {
            const auto& q = s.coefficients().polynomial;
            return array_of(std::vector<double>(q.begin(), q.end()));
          },
          "(4,): q0 in mm, q1, q2, q3 of q0 + q1 x + q2 y + q3 z")
      .def_property_readonly(
          "support_radius_mm", [](const ImplicitSurface& s) { return s.coefficients().support_radius_mm; },
          "mm; beyond it a centre has no say")
      .def_property_readonly(
          "kernel", [](const ImplicitSurface& s) { return lumen::name(s.coefficients().kernel); },
          "morse-c0, wendland-c2 or wendland-c4")
      .def("values", &values_at, py::arg("places"), "f at places (n, 3), mm: (n,).")
      .def("gradients", &gradients_at, py::arg("places"), "Its gradient there, (n, 3), 1/mm.")
      .def("__repr__",
           [](const ImplicitSurface& s) {
             return py::str("<ostia.ImplicitSurface: {} centres, support {:.4g} mm>")
                 .format(s.coefficients().centres.size(), s.coefficients().support_radius_mm);
           })
      .def(py::pickle(&state_of, [](const py::tuple& s) {
        return implicit_of(s[0], s[1], s[2].cast<double>(), s[3].cast<std::string>(), s[4]);
      }));
  same_when_copied(type);
}

void bind_model(py::module_& m) {
  py::class_<LumenModel, std::shared_ptr<LumenModel>>(
      m, "LumenModel", "A tree with the wall of each vessel; a value: an edit makes another one.")
      .def_readonly("tree", &LumenModel::tree, "VesselTree: axes, radii, names")
      .def_property_readonly(
          "digest", [](const LumenModel& model) { return lumen::digest(model); },
          "SHA-256 over all that is stored: equal ones are equal models to the last bit")
      .def("samples", &samples_of, py::arg("vessel"),
           "A vessel's wall as stored, by name: id (n,), position (n, 3) in mm, unit normal (n, 3), s_mm "
           "(n,), origin (n,) (0 start, 1 cap, 2 edit).")
      .def(
          "own_from_mm",
          [](const LumenModel& model, std::int32_t vessel) { return lumen::own_from_mm(model.tree, vessel); },
          py::arg("vessel"), "Where a vessel's own part begins on its axis, mm.")
      .def(
          "surface",
          [](const LumenModel& model, double cell_mm, const py::object& progress) {
            return watched(progress,
                           [&](const auto& task) { return lumen::surface_of(model, cell_mm, task); });
          },
          py::arg("cell_mm") = 0.0, py::kw_only(), py::arg("progress") = py::none(),
          "The wall as triangles, solved afresh; cell_mm: of the grid, 0: as fine as the model asks for.")
      .def(
          "solve",
          [](const LumenModel& model, const py::object& progress) {
            return watched(progress, [&](const auto& task) { return solved(model, task); });
          },
          py::kw_only(), py::arg("progress") = py::none(), "The walls solved, for profiles and stenoses.")
      .def("__eq__",
           [](const LumenModel& a, const py::object& other) {
             return py::isinstance<LumenModel>(other) &&
                    lumen::digest(a) == lumen::digest(other.cast<const LumenModel&>());
           })
      .def("__hash__", [](const LumenModel& model) { return py::hash(py::str(lumen::digest(model))); })
      .def("__reduce__",
           [](const py::object& self) {
             const py::object content = py::module_::import("ostia._ostia").attr("_model_bytes")(self);
             return py::make_tuple(py::module_::import("ostia._pickling").attr("model_of_bytes"),
                                   py::make_tuple(content));
           })
      .def("__copy__", [](const py::object& self) { return self; })
      .def(
          "__deepcopy__", [](const py::object& self, const py::object&) { return self; }, py::arg("memo"))
      .def("__repr__", [](const LumenModel& model) {
        std::size_t samples = 0;
        for (const auto& vessel : model.vessels) samples += vessel->samples.size();
        return py::str("<ostia.LumenModel: {} vessels, {} samples>").format(model.vessels.size(), samples);
      });
  py::class_<SolvedWalls, std::shared_ptr<SolvedWalls>>(m, "SolvedWalls", "The walls of a model, solved.")
      .def_property_readonly(
          "vessels",
          [](const SolvedWalls& walls) {
            std::vector<std::int32_t> ids;
            for (const auto& [id, surface] : walls.surfaces) ids.push_back(id);
            return ids;
          },
          "Their ids.")
      .def(
          "values",
          [](const SolvedWalls& walls, std::int32_t vessel, const py::object& places) {
            return values_at(*walls(vessel), places);
          },
          py::arg("vessel"), py::arg("places"),
          "f of a vessel at places (n, 3), mm: (n,), negative inside, near the wall about the distance in "
          "mm.")
      .def(
          "surface",
          [](const SolvedWalls& walls, std::int32_t vessel) {
            return std::const_pointer_cast<ImplicitSurface>(
                walls(vessel));  // Python has no way to change one
          },
          py::arg("vessel"), "ImplicitSurface of a vessel (its id).")
      .def("__repr__",
           [](const SolvedWalls& walls) {
             return py::str("<ostia.SolvedWalls of {} vessels>").format(walls.surfaces.size());
           })
      .def(py::pickle(
          [](const SolvedWalls& walls) {
            py::dict surfaces;
            for (const auto& [vessel, surface] : walls.surfaces)
              surfaces[py::int_(vessel)] = std::const_pointer_cast<ImplicitSurface>(surface);
            return py::make_tuple(surfaces);
          },
          [](const py::tuple& s) {
            SolvedWalls walls;
            for (const auto& [vessel, surface] : s[0].cast<py::dict>())
              walls.surfaces[vessel.cast<std::int32_t>()] = surface.cast<std::shared_ptr<ImplicitSurface>>();
            return walls;
          }));
}

}  // namespace

void bind_lumen(py::module_& m) {
  bind_implicit(m);
  bind_model(m);
  std::string text = with_options<SamplingOptions>(
      m, "model_of_tubes", "A model whose walls are round, of the axes' radii or of one radius for all.");
  m.def(
      "model_of_tubes",
      [](const geometry::VesselTree& tree, const std::optional<double>& radius_mm,
         const py::kwargs& options) {
        const auto how = options_of<SamplingOptions>(options);
        return unlocked([&] { return lumen::model_of_tubes(tree, radius_mm, how); });
      },
      py::arg("tree"), py::arg("radius_mm") = py::none(), text.c_str());
  text = with_options<SamplingOptions>(m, "model_of_surface",
                                       "A model whose walls are a surface's, along rays from the axes.");
  m.def(
      "model_of_surface",
      [](const geometry::VesselTree& tree, const geometry::TriMesh& surface, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<SamplingOptions>(options);
        return watched(progress,
                       [&](const auto& task) { return lumen::model_of_surface(tree, surface, how, task); });
      },
      py::arg("tree"), py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<SamplingOptions>(
      m, "model_of_contours",
      "A model whose walls are contours' where there are any (one observer's lumen), and round elsewhere; "
      "vessels are matched by name.");
  m.def(
      "model_of_contours",
      [](const geometry::VesselTree& tree, const geometry::ContourSet& contours, const py::kwargs& options) {
        const auto how = options_of<SamplingOptions>(options);
        return unlocked([&] { return lumen::model_of_contours(tree, contours, how); });
      },
      py::arg("tree"), py::arg("contours"), text.c_str());
}

}  // namespace ostia::python
