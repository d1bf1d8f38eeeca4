#include "call.h"
#include "case.h"
#include "figures.h"
#include "options.h"
#include "session_parts.h"
#include "values.h"
#include "volume.h"
#include "walls.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/session/case_report.h"
#include "ostia/session/doubts.h"
#include "ostia/session/evaluability.h"
#include "ostia/session/label_volume.h"
#include "ostia/session/plaque_sampling.h"
#include "ostia/session/sample_case.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using analysis::HighRiskOptions;
using analysis::PlaqueOptions;
using segmentation::OuterWallOptions;
using session::LabelCount;
using session::OuterWallsOptions;
using session::ReportLanguage;
using session::ReportOptions;
using session::ReportTemplate;
using session::ScanGrade;
using session::ScanQuality;
using session::VoxelLabels;

template <>
struct WordsOf<ReportLanguage> {
  static constexpr std::pair<const char*, ReportLanguage> words[] = {{"en", ReportLanguage::english},
                                                                     {"de", ReportLanguage::german}};
};
template <>
struct WordsOf<ReportTemplate> {
  static constexpr std::pair<const char*, ReportTemplate> words[] = {{"full", ReportTemplate::full},
                                                                     {"short", ReportTemplate::brief}};
};
template <>
struct WordsOf<ScanGrade> {
  static constexpr std::pair<const char*, ScanGrade> words[] = {
      {"good", ScanGrade::good}, {"fair", ScanGrade::fair}, {"poor", ScanGrade::poor}};
};
template <>
struct WordsOf<VoxelLabels> {
  static constexpr std::pair<const char*, VoxelLabels> words[] = {{"lumen", VoxelLabels::lumen},
                                                                  {"segments", VoxelLabels::segments},
                                                                  {"wall", VoxelLabels::wall},
                                                                  {"plaque", VoxelLabels::plaque}};
};
OSTIA_OPTIONS(OuterWallOptions,
              (radial_step_mm, least_thickness_mm, largest_thickness_mm, blur_sigma_mm, wall_hu, fat_hu,
               largest_slope_along, largest_slope_around),
              ())
OSTIA_OPTIONS(PlaqueOptions,
              (low_attenuation_hu, fibrofatty_hu, fibrous_hu, thin_wall_mm, healthy_margin_mm, step_mm,
               around, deep, blur_sigma_mm),
              ())
OSTIA_OPTIONS(OuterWallsOptions, (step_mm, around, wall, plaque), (maps))  // of a screen
OSTIA_OPTIONS(HighRiskOptions, (least_low_mm3, least_remodelling, spot_mm, least_spot_mm3, ring_deg, ring_mm),
              ())
OSTIA_OPTIONS(ReportOptions,
              (date, walls, least_graded_mm, picture_percent, theta_deg, level_hu, window_hu, language, form,
               agatston, impression, high_risk),
              (image, profile, reference, stenosis, medina, plaque_stretches, evaluability, technique,
               certainty))  // the case's; of the analyses; of the image
OSTIA_FIGURES(LabelCount, (value, name, voxels), ())
OSTIA_FIGURES(ScanQuality,
              (voxel_mm, noise_hu, lumen_hu, contrast_hu, cnr, blur_mm, evaluable_share, limited_share,
               not_evaluable_share, grade, reasons),
              ())

namespace {

namespace fs = std::filesystem;
using core::TaskContext;
using lumen::LumenModel;
using py::literals::operator""_a;
using session::VesselWalls;

py::dict volumes_shown(const analysis::PlaqueVolumes& v) {
  using analysis::PlaqueClass;
  return py::dict("length_mm"_a = v.length_mm, "lumen_mm3"_a = v.lumen_mm3, "vessel_mm3"_a = v.vessel_mm3,
                  "low_attenuation_mm3"_a = v.of(PlaqueClass::low_attenuation),
                  "fibrofatty_mm3"_a = v.of(PlaqueClass::fibrofatty),
                  "fibrous_mm3"_a = v.of(PlaqueClass::fibrous),
                  "calcified_mm3"_a = v.of(PlaqueClass::calcified), "plaque_mm3"_a = v.plaque_mm3(),
                  "thin_wall_mm3"_a = v.thin_wall_mm3, "burden_percent"_a = v.burden_percent(),
                  "type"_a = analysis::to_string(analysis::plaque_type(v)));
}

template <class Value>
py::array of_slabs(const VesselWalls& walls, const Value& value) {
  std::vector<double> all;
  for (const analysis::PlaqueSlab& slab : walls.plaque.slabs) all.push_back(value(slab));
  return array_of(all);
}

py::dict slabs_shown(const VesselWalls& walls) {
  using analysis::PlaqueSlab;
  py::dict columns;
  columns["s_mm"] = of_slabs(walls, [](const PlaqueSlab& s) { return s.s_mm; });
  columns["lumen_mm2"] = of_slabs(walls, [](const PlaqueSlab& s) { return s.lumen_mm2; });
  columns["vessel_mm2"] = of_slabs(walls, [](const PlaqueSlab& s) { return s.vessel_mm2; });
  columns["plaque_mm2"] = of_slabs(walls, [](const PlaqueSlab& s) { return s.plaque_mm2; });
  for (std::size_t i = 0; i < analysis::plaque_classes; ++i) {
    std::string name = analysis::to_string(static_cast<analysis::PlaqueClass>(i));
    std::replace(name.begin(), name.end(), ' ', '_');
    columns[(name + "_mm3").c_str()] =
        of_slabs(walls, [i](const PlaqueSlab& s) { return s.volumes.class_mm3[i]; });
  }
  return columns;
}

void bind_plaque(py::module_& m) {
  py::class_<VesselWalls, std::shared_ptr<VesselWalls>>(
      m, "VesselWalls", "A vessel's lumen and outer wall as an image shows them, and the plaque between.")
      .def_readonly("vessel", &VesselWalls::vessel, "id")
      .def_property_readonly(
          "from_mm", [](const VesselWalls& w) { return w.plaque.from_mm; }, "Where it begins on the axis, mm")
      .def_property_readonly(
          "to_mm", [](const VesselWalls& w) { return w.plaque.to_mm; }, "Where it ends, mm")
      .def_property_readonly(
          "seen_share", [](const VesselWalls& w) { return w.outer.seen_share; },
          "Of the outer wall that borders on fat, [0, 1]; the rest is a bridge")
      .def_property_readonly(
          "slabs", &slabs_shown,
          "A dictionary of columns along the vessel, (n,) each: s_mm, areas (mm2), volumes by "
          "class (mm3)")
      .def(
          "between",
          [](const VesselWalls& w, double from_mm, double to_mm) {
            return volumes_shown(analysis::plaque_between(w.plaque, from_mm, to_mm));
          },
          py::arg("from_mm"), py::arg("to_mm"), "Volumes by class of a stretch (mm3), burden and type.")
      .def(
          "ring",
          [](const VesselWalls& w, double s_mm, int points) {
            return array_of(session::outer_wall_ring(w, s_mm, points));
          },
          py::arg("s_mm"), py::arg("points") = 96,
          "The outer wall on the section at an abscissa: (points, 3), mm; (0, 3) beyond what was found.")
      .def("__repr__", [](const VesselWalls& w) {
        return py::str("<ostia.VesselWalls of vessel {}: {:.4g} to {:.4g} mm>")
            .format(w.vessel, w.plaque.from_mm, w.plaque.to_mm);
      });
  const std::string text = with_options<OuterWallsOptions>(
      m, "find_plaque",
      "A vessel's outer wall in the CT that its model was made with, and the plaque within; None where less "
      "than 2 mm of it run by themselves.");
  m.def(
      "find_plaque",
      [](const LumenModel& model, std::int32_t vessel, const AnyVolume& image,
         const std::shared_ptr<SolvedWalls>& walls, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<OuterWallsOptions>(options);
        const imaging::ImageVolume& ct = image.image("image");
        auto found = watched(progress, [&](const TaskContext& task) {
          const SolvedWalls solved_now = walls ? *walls : solved(model, task.sub(0.0, 0.5));
          return session::vessel_walls(model, solved_now, vessel, ct, how, task.sub(0.5, 1.0));
        });
        return found ? std::make_shared<VesselWalls>(std::move(*found)) : nullptr;
      },
      py::arg("model"), py::arg("vessel"), py::arg("image"), py::arg("walls") = py::none(), py::kw_only(),
      py::arg("progress") = py::none(), text.c_str());
}

void bind_labels(py::module_& m) {
  const std::string text = with_options<OuterWallsOptions>(
      m, "label_volume",
      "A model's lumen as voxels on an image's grid: (Volume of uint8, a dictionary a label: value, name, "
      "voxels). what: lumen, segments (AHA and SCCT numbers), wall or plaque; the latter two look for the "
      "outer "
      "wall in the image, a CT.");
  m.def(
      "label_volume",
      [](const LumenModel& model, const AnyVolume& image, const std::string& what, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<OuterWallsOptions>(options);
        VoxelLabels labels{};
        take(labels, py::str(what), "what");
        const bool walls = labels == VoxelLabels::wall || labels == VoxelLabels::plaque;
        const imaging::ImageVolume* ct = walls ? &image.image("image") : nullptr;
        auto made = watched(progress, [&](const TaskContext& task) {
          auto found = session::label_volume(model, image.grid(), labels, ct, how, task);
          for (const std::string& warning : found.warnings) core::log_warning(warning);
          return found;
        });
        return py::make_tuple(AnyVolume(std::move(made.volume)), figures_of(made.counts));
      },
      py::arg("model"), py::arg("image"), py::arg("what") = "lumen", py::kw_only(),
      py::arg("progress") = py::none(), text.c_str());
  m.def(
      "scan_quality",
      [](const LumenModel& model, const AnyVolume& image, const py::object& progress) {
        const imaging::ImageVolume& ct = image.image("image");
        return figures(watched(progress, [&](const TaskContext& task) {
          const SolvedWalls walls = solved(model, task.sub(0.0, 0.5));
          const double noise = session::noise_about(model, ct);
          std::vector<session::VesselEvaluability> vessels;
          for (const auto& vessel : model.vessels)
            vessels.push_back(session::vessel_evaluability(model, walls, vessel->vessel, ct, noise, {},
                                                           task.sub(0.5, 1.0)));
          return session::scan_quality(ct.geometry, noise, vessels);
        }));
      },
      py::arg("model"), py::arg("image"), py::kw_only(), py::arg("progress") = py::none(),
      "How good a CT is for the arteries of a model: noise, contrast (HU), blur (mm), shares that can be "
      "judged, "
      "grade and reasons.");
}

/// What a report is made of, from the case.
struct OfCase {
  std::shared_ptr<const LumenModel> model;
  std::shared_ptr<const session::Annotations> notes;
  std::vector<session::JournalEntry> journal;
  pipeline::JobKey job;
};

OfCase read_case(Case& file, bool with_image, ReportOptions& how) {
  return file.with_file([&](session::CaseFile& f) {
    how.image = f.image();
    how.certainty = session::kept_certainty(f);
    return OfCase{f.model(), f.annotations(), f.journal(), session::report_job(f, with_image, how)};
  });
}

std::string write_report(const fs::path& folder, const OfCase& of, const imaging::ImageVolume* image,
                         const ReportOptions& how, const TaskContext& task) {
  pipeline::require_free_folder(folder);
  const SolvedWalls surfaces = solved(*of.model, task.sub(0.0, 0.3));
  const session::CaseReport report =
      session::make_case_report(*of.model, surfaces, *of.notes, of.journal, image, how, task.sub(0.3, 0.5));
  for (const std::string& warning : report.warnings) core::log_warning(warning);
  const auto images = session::key_images(report, *of.model, surfaces, image, task.sub(0.5, 0.85));
  session::write_case_report(folder, report, images, of.job, 0.0, task.sub(0.85, 1.0));
  return session::report_json(report, images);
}

void bind_reports(py::module_& m) {
  const std::string text =
      with_options<ReportOptions>(m, "write_report",
                                  "A case's report into a folder, whole or not at all: a page, a PDF, "
                                  "tables, key images. image: the CT that "
                                  "the case was made with. Returns report.json.");
  m.def(
      "write_report",
      [](const fs::path& folder, Case& file, const AnyVolume* image, const py::object& progress,
         const py::kwargs& options) {
        auto how = options_of<ReportOptions>(options);
        session::validate(how);
        const imaging::ImageVolume* ct = image != nullptr ? &image->image("image") : nullptr;
        const OfCase of = read_case(file, ct != nullptr, how);
        return json_of(watched(
            progress, [&](const TaskContext& task) { return write_report(folder, of, ct, how, task); }));
      },
      py::arg("folder"), py::arg("case"), py::arg("image") = py::none(), py::kw_only(),
      py::arg("progress") = py::none(), text.c_str());
  m.def(
      "sample_case",
      [](const fs::path& folder, const std::string& preset, const py::object& progress) {
        const auto wanted = preset == "tiny"    ? phantom::Preset::tiny
                            : preset == "small" ? phantom::Preset::small
                                                : phantom::Preset::full;
        if (preset != phantom::preset_name(wanted))
          throw InvalidInput("preset: tiny, small or full, not " + preset);
        const auto made = watched(
            progress, [&](const TaskContext& task) { return session::sample_case(folder, wanted, task); });
        return py::make_tuple(made.image.string(), made.case_file.string());
      },
      py::arg("folder"), py::arg("preset") = "small", py::kw_only(), py::arg("progress") = py::none(),
      "A synthetic patient to try things on: (image file, case file) in a folder; what is there is used.");
}

}  // namespace

void bind_session_walls(py::module_& m) {
  bind_plaque(m);
  bind_labels(m);
}

void bind_session_reports(py::module_& m) {
  bind_reports(m);
}

}  // namespace ostia::python
