#include "array.h"
#include "call.h"
#include "figures.h"
#include "mesh_options.h"
#include "options.h"
#include "pipeline_parts.h"
#include "rooms.h"
#include "values.h"
#include "volume.h"

#include "ostia/core/log.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/pipeline/lumen_surface.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/repair.h"
#include "ostia/pipeline/report.h"
#include "ostia/pipeline/vessel_export.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

namespace ostia::python {

using imaging::DicomReadOptions;
using meshing::QualityVerdict;
using pipeline::ExportSummary;
using pipeline::KeptParts;
using pipeline::MeshExportOptions;
using pipeline::ModelOptions;
using pipeline::RepairOptions;
using pipeline::RepairStep;
using pipeline::SurfaceEnds;
using pipeline::SurfaceExportOptions;
using pipeline::VolumeOptions;

template <>
struct WordsOf<KeptParts> {
  static constexpr std::pair<const char*, KeptParts> words[] = {
      {"vessels", KeptParts::vessels}, {"all", KeptParts::all}, {"largest", KeptParts::largest}};
};
template <>
struct WordsOf<SurfaceEnds> {
  static constexpr std::pair<const char*, SurfaceEnds> words[] = {
      {"rounded", SurfaceEnds::rounded}, {"capped", SurfaceEnds::capped}, {"open", SurfaceEnds::open}};
};
OSTIA_OPTIONS(VolumeOptions, (tetrahedralize, layers, split_prisms, order),
              (formats, refinement, solver_case))  // what is written is asked for apart
OSTIA_OPTIONS(ModelOptions,
              (clip, inset_radii, extensions, sizing, remesh, volume, bounds, volume_bounds, shape_bounds),
              (branches, source, targets, side_branches, segment, smoothing,
               centerline))  // of stages before meshing
OSTIA_OPTIONS(RepairOptions, (fill_holes_up_to_mm, parts), ())
OSTIA_OPTIONS(DicomReadOptions,
              (series_uid, resample_uneven, pixel_spacing_mm, slice_spacing_mm, assume_axial), ())
OSTIA_OPTIONS(SurfaceExportOptions, (vessels, ends, sizing, formats), ())
OSTIA_OPTIONS(MeshExportOptions, (vessels, sizing, volume, inset_radii, planes, extensions, surface_formats),
              ())
OSTIA_FIGURES(RepairStep, (what, count, text), ())
OSTIA_FIGURES(QualityVerdict, (reasons), ())
OSTIA_FIGURES(ExportSummary,
              (trees, triangles, tetrahedra, prisms, full_layers, volume_mm3, min_dihedral_deg, min_angle_deg,
               verdict, warnings),
              ())

namespace {

namespace fs = std::filesystem;
using core::TaskContext;
using geometry::TriMesh;
using geometry::VesselTree;

/// What pipeline::MeshedLumen holds, as far as Python has it.
struct Meshed {
  geometry::MixedMesh mesh;
  geometry::FacedSurface surface;
  VesselTree tree;
  std::string quality;
  std::vector<std::string> reasons, warnings;
};

Meshed meshed_of(pipeline::MeshedLumen&& made) {
  return {std::move(made.mesh),
          std::move(made.surface),
          std::move(made.centerlines.tree),
          pipeline::quality_json(made.quality),
          made.quality.verdict.reasons,
          made.warnings};
}

py::tuple state_of(const Meshed& m) {
  return py::make_tuple(std::make_shared<geometry::MixedMesh>(m.mesh),
                        std::make_shared<geometry::FacedSurface>(m.surface),
                        std::make_shared<VesselTree>(m.tree), m.quality, m.reasons, m.warnings);
}

std::shared_ptr<Meshed> meshed_of_state(const py::tuple& s) {
  return std::make_shared<Meshed>(
      Meshed{s[0].cast<const geometry::MixedMesh&>(), s[1].cast<const geometry::FacedSurface&>(),
             s[2].cast<const VesselTree&>(), s[3].cast<std::string>(), s[4].cast<std::vector<std::string>>(),
             s[5].cast<std::vector<std::string>>()});
}

void bind_meshed(py::module_& m) {
  py::class_<Meshed, std::shared_ptr<Meshed>> type(m, "MeshedLumen", "What mesh_lumen made.");
  type.def_property_readonly("mesh", part(&Meshed::mesh), "MixedMesh, with named faces")
      .def_property_readonly("surface", part(&Meshed::surface), "FacedSurface, closed and remeshed")
      .def_property_readonly("tree", part(&Meshed::tree), "VesselTree of the cut lumen")
      .def_property_readonly(
          "quality", [](const Meshed& r) { return json_of(r.quality); }, "as in quality.json")
      .def_property_readonly(
          "ok", [](const Meshed& r) { return r.reasons.empty(); },
          "Whether the gate passed; else `reasons` says why not")
      .def_readonly("reasons", &Meshed::reasons, "What did not pass.")
      .def_readonly("warnings", &Meshed::warnings, "What a person should know.")
      .def("__repr__",
           [](const Meshed& r) {
             return py::str("<ostia.MeshedLumen: {} tetrahedra, {} prisms, {}>")
                 .format(r.mesh.tetrahedra.size(), r.mesh.prisms.size(),
                         r.reasons.empty() ? std::string("passed") : r.reasons.front());
           })
      .def(py::pickle(&state_of, &meshed_of_state));
  same_when_copied(type);
  const std::string text = with_options<ModelOptions>(
      m, "mesh_lumen",
      "From a lumen and its axes to a mesh with named faces: cut, capped, remeshed, filled, judged.");
  m.def(
      "mesh_lumen",
      [](const TriMesh& lumen, const VesselTree& tree, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<ModelOptions>(options);
        pipeline::validate(how);
        return std::make_shared<Meshed>(watched(progress, [&](const TaskContext& task) {
          return meshed_of(pipeline::mesh_lumen(lumen, tree, how, task));
        }));
      },
      py::arg("lumen"), py::arg("tree"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  m.def(
      "mesh_quality",
      [](const geometry::MixedMesh& mesh, const py::object& progress) {
        return json_of(watched(progress, [&](const TaskContext& task) {
          return pipeline::quality_json(pipeline::judged(mesh, task));
        }));
      },
      py::arg("mesh"), py::kw_only(), py::arg("progress") = py::none(),
      "How good a volume mesh of any origin is, as quality.json has it: angles (degrees), Jacobians, volumes "
      "(mm3).");
}

void bind_repair(py::module_& m) {
  const std::string text =
      with_options<RepairOptions>(m, "repair_surface",
                                  "A faulty surface made fit for centerlines and meshing: (TriMesh, {steps, "
                                  "left, meshable}); open ends stay "
                                  "open.");
  m.def(
      "repair_surface",
      [](const TriMesh& surface, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<RepairOptions>(options);
        auto fixed = watched(progress,
                             [&](const TaskContext& task) { return pipeline::repaired(surface, how, task); });
        using py::literals::operator""_a;
        return py::make_tuple(std::make_shared<TriMesh>(std::move(fixed.mesh)),
                              py::dict("steps"_a = figures_of(fixed.steps), "left"_a = fixed.left,
                                       "meshable"_a = fixed.meshable));
      },
      py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

void bind_reading(py::module_& m) {
  const std::string text = with_options<DicomReadOptions>(
      m, "read_ct",
      "A CT in HU, int16: a DICOM folder or zip, NRRD, MetaImage or NIfTI; refused where it is a mask.");
  m.def(
      "read_ct",
      [](const fs::path& path, const py::object& progress, const py::kwargs& options) {
        pipeline::SourceOptions how;
        how.dicom = options_of<DicomReadOptions>(options);
        auto source = watched(progress, [&](const TaskContext& task) {
          pipeline::Source found = pipeline::load_ct(path, how, task);
          for (const std::string& warning : found.warnings) core::log_warning(warning);
          return found;
        });
        return AnyVolume(source.image);
      },
      py::arg("path"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

void bind_exports(py::module_& m) {
  std::string text =
      with_options<SurfaceExportOptions>(m, "export_model_surface",
                                         "The walls of a model's vessels in a folder, whole or not at all: "
                                         "lumen.vtp, .stl, .ply, centerlines.vtp. "
                                         "vessels: ids, with those that they come from; [] all.");
  m.def(
      "export_model_surface",
      [](const fs::path& folder, const lumen::LumenModel& model, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<SurfaceExportOptions>(options);
        pipeline::validate(how);
        return figures(watched(progress, [&](const TaskContext& task) {
          return pipeline::export_surface(folder, model, how, task);
        }));
      },
      py::arg("folder"), py::arg("model"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<MeshExportOptions>(
      m, "export_model_mesh",
      "A mesh of a model's vessels between flat, named ends in a folder, whole or not at all: mesh.vtu, "
      "lumen.vtp, "
      "centerlines.vtp, quality.json. planes: where a person wants ends cut, [{end, origin, normal}], mm.");
  m.def(
      "export_model_mesh",
      [](const fs::path& folder, const lumen::LumenModel& model, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<MeshExportOptions>(options);
        pipeline::validate(how);
        return figures(watched(progress, [&](const TaskContext& task) {
          return pipeline::export_mesh(folder, model, how, task);
        }));
      },
      py::arg("folder"), py::arg("model"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_pipeline(py::module_& m) {
  bind_meshed(m);
  bind_repair(m);
  bind_reading(m);
  bind_exports(m);
  bind_pipeline_trees(m);
  bind_pipeline_motion(m);
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
      "The surface of a level set (mm) about the seeds (n, 3), mm, with the topology that a vessel has.");
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
