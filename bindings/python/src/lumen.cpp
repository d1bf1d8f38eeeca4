#include "array.h"
#include "call.h"
#include "options.h"
#include "rooms.h"
#include "walls.h"

#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"

#include <pybind11/stl.h>

namespace ostia::python {

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

py::array values_at(const SolvedWalls& walls, std::int32_t vessel, const py::object& places) {
  const auto surface = walls(vessel);
  const std::vector<geometry::Vec3> where = places_of(places, "places");
  py::array_t<double> out(static_cast<py::ssize_t>(where.size()));
  const std::span<double> values(out.mutable_data(), where.size());
  unlocked([&] { surface->values(where, values); });
  return out;
}

void bind_model(py::module_& m) {
  py::class_<LumenModel, std::shared_ptr<LumenModel>>(
      m, "LumenModel", "A tree with the wall of each vessel; a value: an edit makes another one.")
      .def_readonly("tree", &LumenModel::tree, "VesselTree: axes, radii, names")
      .def_property_readonly(
          "digest", [](const LumenModel& model) { return lumen::digest(model); },
          "SHA-256 over all that is stored: equal ones are equal models to the last bit")
      .def("samples", &samples_of, py::arg("vessel"),
           "A vessel's wall as stored: id, position (n, 3), normal (n, 3), s_mm, origin (0 start, 1 cap, 2 "
           "edit).")
      .def(
          "own_from_mm",
          [](const LumenModel& model, std::int32_t vessel) { return lumen::own_from_mm(model.tree, vessel); },
          py::arg("vessel"), "Where a vessel's own part begins on its axis.")
      .def(
          "surface",
          [](const LumenModel& model, double cell_mm, const py::object& progress) {
            return watched(progress,
                           [&](const auto& task) { return lumen::surface_of(model, cell_mm, task); });
          },
          py::arg("cell_mm") = 0.0, py::kw_only(), py::arg("progress") = py::none(),
          "The wall as triangles, solved afresh; cell_mm 0: as fine as the model asks for.")
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
      .def_property_readonly("vessels",
                             [](const SolvedWalls& walls) {
                               std::vector<std::int32_t> ids;
                               for (const auto& [id, surface] : walls.surfaces) ids.push_back(id);
                               return ids;
                             })
      .def("values", &values_at, py::arg("vessel"), py::arg("places"),
           "f of a vessel at places (n, 3): negative inside, near the wall about the distance in mm.")
      .def("__repr__", [](const SolvedWalls& walls) {
        return py::str("<ostia.SolvedWalls of {} vessels>").format(walls.surfaces.size());
      });
}

}  // namespace

void bind_lumen(py::module_& m) {
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
}

}  // namespace ostia::python
