#include "call.h"
#include "figures.h"
#include "motion.h"
#include "options.h"
#include "pipeline_parts.h"
#include "values.h"
#include "volume.h"

#include "ostia/analysis/motion_measures.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/pipeline/motion_export.h"
#include "ostia/pipeline/motion_fit.h"
#include "ostia/pipeline/motion_images.h"
#include "ostia/pipeline/motion_report.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using analysis::MotionMeasureOptions;
using geometry::PhaseOrigin;
using motion::HyperelasticWeights;
using motion::RegistrationOptions;
using motion::RegistrationReport;
using pipeline::CarriedQuality;
using pipeline::ImageCarrier;
using pipeline::ImagePhase;
using pipeline::ImagePhasesOptions;
using pipeline::MotionFitOptions;
using pipeline::MotionFormat;
using pipeline::MotionMethod;
using pipeline::MotionTime;
using pipeline::PhaseFit;

template <>
struct WordsOf<MotionMethod> {
  static constexpr std::pair<const char*, MotionMethod> words[] = {
      {"gauss_newton", MotionMethod::gauss_newton}, {"gradient_descent", MotionMethod::gradient_descent}};
};
template <>
struct WordsOf<ImageCarrier> {
  static constexpr std::pair<const char*, ImageCarrier> words[] = {{"cage", ImageCarrier::cage},
                                                                   {"b_splines", ImageCarrier::b_splines}};
};
OSTIA_OPTIONS(HyperelasticWeights, (length, area, volume), ())
OSTIA_OPTIONS(RegistrationOptions,
              (depth, margin, max_angle_deg, energy, data_weight, most_rounds, most_points),
              (start))  // a neighbour's cage
OSTIA_OPTIONS(MotionFitOptions, (method, registration, template_phase), ())
OSTIA_OPTIONS(ImagePhasesOptions, (carrier, template_phase, depth, margin, least_likeness), ())
OSTIA_OPTIONS(MotionMeasureOptions, (rr_s, reach_mm, least_curvature_per_mm, arm_mm, least_way_mm, rest_mm),
              ())
OSTIA_FIGURES(RegistrationReport,
              (rounds, paired_share, mean_distance_mm, least_jacobian, self_intersections,
               source_self_intersections),
              ())
OSTIA_FIGURES(PhaseFit, (phase, name, origin, why, gap, report, stiffness), ())
OSTIA_FIGURES(ImagePhase, (phase, likeness, inside_share, wall_shift_mm, found), ())
OSTIA_FIGURES(MotionTime,
              (phase, seconds, mean_displacement_mm, max_displacement_mm, inverted, min_scaled_jacobian), ())
OSTIA_FIGURES(CarriedQuality, (inverted, min_scaled_jacobian), ())

namespace {

namespace fs = std::filesystem;
using core::TaskContext;
using geometry::MixedMesh;
using geometry::TriMesh;
using geometry::VesselTree;
using pipeline::MotionFit;
using pipeline::PhaseSurface;

/// A dictionary {phase: value}, or a list of (phase, value).
template <class Each>
void for_phases(const py::object& given, const std::string& name, const Each& each) {
  const py::object pairs = py::isinstance<py::dict>(given) ? given.attr("items")() : given;
  for (const py::handle one : pairs) {
    if (!py::isinstance<py::sequence>(one) || py::len(one) != 2)
      refuse_call(name + ": a dictionary {phase: value}, or a list of (phase, value)");
    const auto pair = py::reinterpret_borrow<py::object>(one);
    double phase = 0.0;
    take(phase, pair[py::int_(0)], name + ": phase");
    each(phase, py::object(pair[py::int_(1)]));
  }
}

std::vector<PhaseSurface> surfaces_of(const py::object& given) {
  std::vector<PhaseSurface> phases;
  for_phases(given, "surfaces", [&](double phase, const py::object& value) {
    if (value.is_none()) {
      phases.push_back({phase, "phase " + pipeline::percent_text(phase), {}});
      return;
    }
    if (!py::isinstance<TriMesh>(value))
      refuse_call("surfaces: a TriMesh at each phase, None where there is none");
    phases.push_back({phase, "phase " + pipeline::percent_text(phase), value.cast<const TriMesh&>()});
  });
  return phases;
}

void bind_fit(py::module_& m) {
  py::class_<MotionFit, std::shared_ptr<MotionFit>>(m, "MotionFit", "What fit_motion found.")
      .def_property_readonly(
          "motion",
          [](const MotionFit& fit) { return std::make_shared<Motion>(fit.motion, fit.template_shape); },
          "Motion, with the template's surface")
      .def_property_readonly(
          "phases", [](const MotionFit& fit) { return figures_of(fit.phases); },
          "A dictionary a phase: phase, origin, why, gap, stiffness, report (distances, mm; Jacobian)")
      .def_readonly("template_index", &MotionFit::template_index, "Which of the phases is the template.")
      .def_readonly("warnings", &MotionFit::warnings, "What a person should know.")
      .def_property_readonly("ok", &pipeline::is_sound,
                             "False where a person must look: bridged, folded or crossed.")
      .def("__repr__", [](const MotionFit& fit) {
        return py::str("<ostia.MotionFit: {} phases, {}>")
            .format(fit.phases.size(), pipeline::is_sound(fit) ? "ok" : "a person must look");
      });
  std::string text = with_options<MotionFitOptions>(
      m, "fit_motion",
      "One surface that beats from surfaces at three phases or more: {phase: TriMesh}, phases as shares of "
      "the cycle since the R peak, [0, 1), mm. None: the vessel is not seen then.");
  m.def(
      "fit_motion",
      [](const py::object& surfaces, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<MotionFitOptions>(options);
        auto phases = surfaces_of(surfaces);
        return std::make_shared<MotionFit>(watched(progress, [&](const TaskContext& task) {
          MotionFit fit = pipeline::fit_motion(std::move(phases), how, task);
          for (const std::string& warning : fit.warnings) core::log_warning(warning);
          return fit;
        }));
      },
      py::arg("surfaces"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<ImagePhasesOptions>(
      m, "surfaces_from_images",
      "A template's surface found in the CTs of other phases: ({phase: TriMesh or None}, a dictionary a "
      "phase: likeness, inside_share, wall_shift_mm, found). images: {phase: Volume}, the template's among "
      "them.");
  m.def(
      "surfaces_from_images",
      [](const TriMesh& shape, const py::object& images, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<ImagePhasesOptions>(options);
        std::vector<pipeline::PhaseView> views;
        for_phases(images, "images", [&](double phase, const py::object& value) {
          if (!py::isinstance<AnyVolume>(value)) refuse_call("images: a Volume at each phase");
          auto image = value.cast<const AnyVolume&>().shared_image("images");
          views.push_back({phase, "phase " + pipeline::percent_text(phase),
                           [image](const TaskContext&) { return image; }});
        });
        auto found = watched(progress, [&](const TaskContext& task) {
          return pipeline::surfaces_from_images(shape, std::move(views), how, task);
        });
        py::dict surfaces;
        for (PhaseSurface& one : found.surfaces)
          surfaces[py::float_(one.phase)] = one.surface.triangles.empty()
                                                ? py::object(py::none())
                                                : py::cast(std::make_shared<TriMesh>(std::move(one.surface)));
        return py::make_tuple(surfaces, figures_of(found.found));
      },
      py::arg("surface"), py::arg("images"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

void bind_measures(py::module_& m) {
  const std::string text = with_options<MotionMeasureOptions>(
      m, "measure_motion",
      "How a tree at the template's phase moves over the beat, at so many times of the cycle: displacement "
      "(mm), speed (mm/s), stretch, bends, angles and rests of its branches, as measures.json has them.");
  m.def(
      "measure_motion",
      [](const Motion& motion, const VesselTree& tree, int times, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<MotionMeasureOptions>(options);
        analysis::validate(how);
        return json_of(watched(progress, [&](const TaskContext& task) {
          const auto moving = analysis::carried_tree(tree, motion.moving, analysis::even_phases(times), 0.5,
                                                     task.sub(0.0, 0.3));
          const auto measured = analysis::measure_motion(moving, how, task.sub(0.3, 1.0));
          for (const std::string& warning : measured.warnings) core::log_warning(warning);
          return pipeline::motion_measures_json(measured);
        }));
      },
      py::arg("motion"), py::arg("tree"), py::kw_only(), py::arg("times") = 50,
      py::arg("progress") = py::none(), text.c_str());
}

pipeline::MotionExport export_motion(const fs::path& folder, const Motion& motion, const TriMesh* surface,
                                     const MixedMesh* mesh, const pipeline::MotionExportOptions& how,
                                     const TaskContext& task) {
  if (surface == nullptr && !motion.surface)
    throw InvalidInput("surface: the motion has none of its own; give the template's");
  core::StagedFolder staged(folder);
  auto made = pipeline::export_motion(staged.temporary(), motion.moving, surface ? *surface : *motion.surface,
                                      mesh, how, task);
  for (const std::string& warning : made.warnings) core::log_warning(warning);
  task.throw_if_cancelled();
  staged.commit();
  return made;
}

void bind_export(py::module_& m) {
  m.def(
      "export_motion",
      [](const fs::path& folder, const Motion& motion, const TriMesh* surface, const MixedMesh* mesh,
         const std::vector<std::string>& formats, int times, double rr_seconds, const py::object& progress) {
        pipeline::MotionExportOptions how;
        how.times = times;
        how.rr_seconds = rr_seconds;
        how.formats.clear();
        for (const std::string& name : formats) how.formats.push_back(pipeline::motion_format(name));
        if (formats.empty()) how.formats = {mesh != nullptr ? MotionFormat::vtu : MotionFormat::vtp};
        pipeline::validate(how, mesh);
        const auto made = watched(progress, [&](const TaskContext& task) {
          return export_motion(folder, motion, surface, mesh, how, task);
        });
        return figures_of(made.times);
      },
      py::arg("folder"), py::arg("motion"), py::arg("surface") = py::none(), py::arg("mesh") = py::none(),
      py::kw_only(), py::arg("formats") = std::vector<std::string>(), py::arg("times") = 20,
      py::arg("rr_seconds") = 0.8, py::arg("progress") = py::none(),
      "A surface (None: the motion's own) and a volume mesh time by time into a folder, whole or not at all: "
      "formats vtp, stl, vtu, openfoam, csv, json. Returns a dictionary a time: displacements (mm), inverted "
      "elements.");
  m.def(
      "carried_quality",
      [](const MixedMesh& mesh, const py::object& progress) {
        return figures(watched(
            progress, [&](const TaskContext& task) { return pipeline::carried_quality(mesh, task); }));
      },
      py::arg("mesh"), py::kw_only(), py::arg("progress") = py::none(),
      "Elements of a mesh that are inverted, and the least scaled Jacobian.");
}

}  // namespace

void bind_pipeline_motion(py::module_& m) {
  bind_fit(m);
  bind_measures(m);
  bind_export(m);
}

}  // namespace ostia::python
