#include "array.h"
#include "call.h"
#include "mesh_options.h"
#include "options.h"
#include "rooms.h"
#include "volume.h"

#include "ostia/core/log.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/pipeline/lumen_surface.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/report.h"

#include <pybind11/stl.h>

namespace ostia::python {

using pipeline::ModelOptions;
using pipeline::VolumeOptions;
OSTIA_OPTIONS(VolumeOptions, (tetrahedralize, layers, split_prisms, order),
              (formats, refinement, solver_case))  // what is written is asked for apart
OSTIA_OPTIONS(ModelOptions,
              (clip, inset_radii, extensions, sizing, remesh, volume, bounds, volume_bounds, shape_bounds),
              (branches, source, targets, side_branches, segment, smoothing,
               centerline))  // of stages before meshing

namespace {

using pipeline::MeshedLumen;

py::object json_of(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

void bind_meshed(py::module_& m) {
  py::class_<MeshedLumen, std::shared_ptr<MeshedLumen>>(m, "MeshedLumen", "What mesh_lumen made.")
      .def_property_readonly(
          "mesh",
          [](const py::object& self) {
            auto* meshed = self.cast<MeshedLumen*>();
            auto owner = std::make_shared<Held>(self);
            return std::shared_ptr<geometry::MixedMesh>(&meshed->mesh, [owner](auto*) {});
          },
          "MixedMesh, with named faces")
      .def_property_readonly(
          "surface",
          [](const py::object& self) {
            auto* meshed = self.cast<MeshedLumen*>();
            auto owner = std::make_shared<Held>(self);
            return std::shared_ptr<geometry::FacedSurface>(&meshed->surface, [owner](auto*) {});
          },
          "FacedSurface, closed and remeshed")
      .def_property_readonly(
          "tree", [](const MeshedLumen& r) { return r.centerlines.tree; }, "VesselTree of the cut lumen")
      .def_property_readonly(
          "quality", [](const MeshedLumen& r) { return json_of(pipeline::quality_json(r.quality)); },
          "as in quality.json")
      .def_property_readonly(
          "ok", [](const MeshedLumen& r) { return r.quality.verdict.ok(); },
          "Whether the gate passed; else `reasons` says why not")
      .def_property_readonly("reasons", [](const MeshedLumen& r) { return r.quality.verdict.reasons; })
      .def_readonly("warnings", &MeshedLumen::warnings)
      .def("__repr__", [](const MeshedLumen& r) {
        return py::str("<ostia.MeshedLumen: {} tetrahedra, {} prisms, {}>")
            .format(r.mesh.tetrahedra.size(), r.mesh.prisms.size(), r.quality.verdict.summary());
      });
}

}  // namespace

void bind_pipeline(py::module_& m) {
  bind_meshed(m);
  const std::string text = with_options<ModelOptions>(
      m, "mesh_lumen",
      "From a lumen and its axes to a mesh with named faces: cut, capped, remeshed, filled, judged.");
  m.def(
      "mesh_lumen",
      [](const geometry::TriMesh& lumen, const geometry::VesselTree& tree, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<ModelOptions>(options);
        pipeline::validate(how);
        return watched(progress,
                       [&](const auto& task) { return pipeline::mesh_lumen(lumen, tree, how, task); });
      },
      py::arg("lumen"), py::arg("tree"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  m.def(
      "lumen_surface",
      [](const AnyVolume& level_set, const py::object& seeds, const py::object& progress) {
        const imaging::FloatVolume& field = level_set.floats("level_set");
        const auto places = places_of(seeds, "seeds");
        return watched(progress, [&](const auto& task) {
          auto found = pipeline::lumen_surface(field, places, task);
          for (const std::string& warning : found.warnings) core::log_warning(warning);
          return std::move(found.mesh);
        });
      },
      py::arg("level_set"), py::arg("seeds"), py::kw_only(), py::arg("progress") = py::none(),
      "The surface of a level set about the seeds, mm, with the topology that a vessel has.");
  m.def(
      "model_of_image",
      [](const geometry::VesselTree& tree, const AnyVolume& image, const py::object& progress) {
        const imaging::ImageVolume& ct = image.image("image");
        return watched(progress, [&](const auto& task) {
          return lumen::model_of_walls(tree, pipeline::walls_from_image(tree, ct, task));
        });
      },
      py::arg("tree"), py::arg("image"), py::kw_only(), py::arg("progress") = py::none(),
      "A model whose walls are those that a CT shows about the axes.");
}

}  // namespace ostia::python
