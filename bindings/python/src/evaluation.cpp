#include "call.h"
#include "contours.h"
#include "figures.h"
#include "options.h"
#include "rooms.h"
#include "values.h"
#include "volume.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/evaluation/agreement.h"
#include "ostia/evaluation/centerline_scores.h"
#include "ostia/evaluation/contour_surface.h"
#include "ostia/evaluation/frame_hint.h"
#include "ostia/evaluation/label_scores.h"
#include "ostia/evaluation/lumen_scores.h"
#include "ostia/evaluation/motion_error.h"
#include "ostia/evaluation/suite.h"
#include "ostia/evaluation/surface_motion.h"
#include "ostia/evaluation/surface_shape.h"
#include "ostia/geometry/polyline.h"
#include "ostia/io/rotterdam_file.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using evaluation::BlandAltman;
using evaluation::CenterlineScoreOptions;
using evaluation::CycleFigures;
using evaluation::FloorRow;
using evaluation::LabelScore;
using evaluation::LineDirection;
using evaluation::LumenScoreOptions;
using evaluation::LumenSummary;
using evaluation::MotionError;
using evaluation::OverlapRules;
using evaluation::PhaseError;
using evaluation::SectionScore;
using evaluation::StenosisDetection;
using evaluation::SurfaceDistances;
using evaluation::SurfaceMotionError;
using evaluation::SurfacePhaseError;
using evaluation::SurfaceShape;
using evaluation::VolumeOverlap;
using geometry::Health;

template <>
struct WordsOf<LineDirection> {
  static constexpr std::pair<const char*, LineDirection> words[] = {
      {"nearest_ends", LineDirection::nearest_ends}, {"as_given", LineDirection::as_given}};
};
template <>
struct WordsOf<OverlapRules> {
  static constexpr std::pair<const char*, OverlapRules> words[] = {{"challenge", OverlapRules::challenge},
                                                                   {"paper", OverlapRules::paper}};
};
OSTIA_OPTIONS(CenterlineScoreOptions, (least_radius_mm, free_start_mm, clip, direction, rules), ())
OSTIA_OPTIONS(LumenScoreOptions, (sample_mm, line_mm, reach_radii), ())
OSTIA_FIGURES(SurfaceDistances, (msd_mm, rms_sd_mm, hd95_mm, max_sd_mm, signed_mean_mm, signed_sd_mm), ())
OSTIA_FIGURES(SurfaceShape,
              (area_mm2, closed, volume_mm3, rms_kappa1, rms_kappa2, rms_curvature, vertices_left_out), ())
OSTIA_FIGURES(VolumeOverlap, (reference_mm3, result_mm3, both_mm3, dice, jaccard, relative_difference), ())
OSTIA_FIGURES(LabelScore, (label, in_reference, in_result, overlap, difference_mm3, boundary), ())
OSTIA_FIGURES(SectionScore,
              (section, vessel, observer, health, length_mm, found, dice, msd_mm, rms_sd_mm, max_sd_mm,
               signed_mean_mm, floor_mm, s_mm, reference_radius_mm, result_radius_mm),
              ())
OSTIA_FIGURES(LumenSummary, (sections, missing, length_mm, dice, msd_mm, rms_sd_mm, max_sd_mm), ())
OSTIA_FIGURES(FloorRow, (spacing_mm, points, mean_mm, max_mm, estimate_mm), ())
OSTIA_FIGURES(BlandAltman,
              (count, bias, sd, lower_limit, upper_limit, bias_error, limit_error, bias_interval,
               lower_limit_interval, upper_limit_interval, correlation, slope, intercept, slope_error),
              ())
OSTIA_FIGURES(StenosisDetection,
              (true_positive, false_positive, false_negative, true_negative, sensitivity, ppv,
               mean_grade_difference, rms_grade_difference, weighted_kappa),
              ())
OSTIA_FIGURES(PhaseError, (percent, mean_mm, rms_mm, max_mm), ())
OSTIA_FIGURES(MotionError, (phases, mean_mm, rms_mm, max_mm, amplitude_mm, relative), ())
OSTIA_FIGURES(CycleFigures, (path_mm, amplitude_mm, closing_ratio), ())
OSTIA_FIGURES(SurfacePhaseError, (name, msd_mm, max_sd_mm, dice, displacement_mm, max_displacement_mm), ())
OSTIA_FIGURES(SurfaceMotionError,
              (phases, corresponding, msd_mm, max_sd_mm, dice, displacement_mm, reference, result,
               path_difference_mm),
              ())

namespace {

namespace fs = std::filesystem;
using core::TaskContext;
using geometry::ContourSection;
using geometry::ContourSet;
using geometry::TriMesh;
using io::RotterdamReference;
using py::literals::operator""_a;

void warn(const std::string& text) {
  if (!text.empty()) core::log_warning(text);
}

void bind_surfaces(py::module_& m) {
  m.def(
      "evaluate_surface",
      [](const TriMesh& reference, const TriMesh& result, double sample_mm, const py::object& progress) {
        return figures(watched(progress, [&](const TaskContext& task) {
          warn(evaluation::hint_of_other_frame(reference.points, result.points));
          return evaluation::compare_surfaces(reference, result, {sample_mm, {}, {}}, task);
        }));
      },
      py::arg("reference"), py::arg("result"), py::kw_only(), py::arg("sample_mm") = 0.2,
      py::arg("progress") = py::none(),
      "Exact distances between two surfaces, both ways, weighted by area, mm: msd_mm, rms_sd_mm, hd95_mm, "
      "max_sd_mm (Hausdorff), signed_mean_mm, signed_sd_mm (positive outside the reference).");
  m.def(
      "surface_shape",
      [](const TriMesh& surface, const py::object& progress) {
        return figures(
            watched(progress, [&](const TaskContext& task) { return evaluation::shape_of(surface, task); }));
      },
      py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(),
      "Area (mm2), volume (mm3) and root mean squares of the principal curvatures over a surface (1/mm).");
}

/// Labels of whatever type, as the comparison takes them.
imaging::ImageVolume labels_of(const AnyVolume& volume, const std::string& argument) {
  if (volume.type() == "float32")
    throw InvalidInput(argument + ": a Volume of float32; labels are int16 or uint8: give " + argument +
                       ".astype('uint8')");
  return volume.visit([&](const auto& one) {
    imaging::ImageVolume out;
    out.geometry = one.geometry;
    out.voxels.assign(one.voxels.begin(), one.voxels.end());
    return out;
  });
}

py::dict of_labels(const AnyVolume& reference, const AnyVolume& result, const py::object& progress) {
  auto found = watched(progress, [&](const TaskContext& task) {
    imaging::ImageVolume a = labels_of(reference, "reference"), b = labels_of(result, "result");
    auto labels = evaluation::compare_labels(a, b, {}, task.sub(0.0, 0.5));
    for (imaging::ImageVolume* image : {&a, &b})
      for (std::int16_t& v : image->voxels) v = v != 0;
    auto whole = evaluation::compare_labels(a, b, {}, task.sub(0.5, 1.0)).front();
    return std::pair(std::move(whole), std::move(labels));
  });
  py::dict out = figures(found.first);
  for (const char* key : {"label", "in_reference", "in_result"}) out.attr("pop")(key);
  out["labels"] = figures_of(found.second);
  return out;
}

void bind_volumes(py::module_& m) {
  m.def(
      "evaluate_volume",
      [](const AnyVolume& reference, const AnyVolume& result, double, const py::object& progress) {
        return of_labels(reference, result, progress);
      },
      py::arg("reference"), py::arg("result"), py::kw_only(), py::arg("resolution_mm") = 0.2,
      py::arg("progress") = py::none(),
      "Overlap of two masks or label Volumes of one grid, all labels together (overlap, boundary) and each "
      "(labels); or of what two closed TriMeshes enclose, on lines resolution_mm apart.");
  m.def(
      "evaluate_volume",
      [](const TriMesh& reference, const TriMesh& result, double resolution_mm, const py::object& progress) {
        return figures(watched(progress, [&](const TaskContext& task) {
          return evaluation::compare_enclosed(reference, result, resolution_mm, {}, task);
        }));
      },
      py::arg("reference"), py::arg("result"), py::kw_only(), py::arg("resolution_mm") = 0.2,
      py::arg("progress") = py::none());
}

RotterdamReference reference_of(const py::object& points, const py::object& radius,
                                const py::object& observer_spread) {
  RotterdamReference line{places_of(points, "points"), numbers_of(radius, "radius"), {}};
  line.observer_spread = observer_spread.is_none() ? std::vector<double>(line.points.size(), 0.1)
                                                   : numbers_of(observer_spread, "observer_spread");
  if (line.points.size() < 2) throw InvalidInput("points: a line has two or more");
  if (line.radius.size() != line.points.size() || line.observer_spread.size() != line.points.size())
    throw InvalidInput("radius, observer_spread: one number a point, " + std::to_string(line.points.size()));
  return line;
}

std::vector<evaluation::NamedLine> candidates_of(const py::object& result) {
  if (py::isinstance<geometry::VesselTree>(result))
    return evaluation::lines_of(result.cast<const geometry::VesselTree&>());
  if (py::isinstance<geometry::Centerline>(result))
    return {{"result", result.cast<const geometry::Centerline&>().points}};
  return {{"result", places_of(result, "result")}};
}

py::dict along(const RotterdamReference& reference, const evaluation::CenterlineScores& scores) {
  std::vector<double> s_mm, distance_mm;
  py::list matched;
  for (const auto& one : evaluation::along_reference(reference, scores)) {
    s_mm.push_back(one.s_mm);
    distance_mm.push_back(one.distance_mm);
    matched.append(one.matched);
  }
  return py::dict("s_mm"_a = array_of(s_mm), "distance_mm"_a = array_of(distance_mm),
                  "matched"_a = py::module_::import("numpy").attr("array")(matched, "bool"));
}

py::dict scores_shown(const RotterdamReference& reference, const std::string& name,
                      const evaluation::CenterlineScores& s) {
  return py::dict("result"_a = name, "length_mm"_a = geometry::length(reference.points), "ov"_a = s.ov,
                  "of"_a = s.of, "ot"_a = s.ot, "ai_mm"_a = s.ai_mm, "ai_score"_a = s.ai_score,
                  "tpr"_a = s.tpr, "fn"_a = s.fn, "tpm"_a = s.tpm, "fp"_a = s.fp, "turned"_a = s.turned,
                  "along"_a = along(reference, s));
}

void bind_lines(py::module_& m) {
  py::class_<RotterdamReference, std::shared_ptr<RotterdamReference>> line(
      m, "ReferenceLine",
      "A vessel's line as observers traced it, the Rotterdam challenge's reference.txt: points (n, 3), "
      "radius and observer_spread (n,), mm.");
  line.def(py::init(&reference_of), py::arg("points"), py::arg("radius"),
           py::arg("observer_spread") = py::none())
      .def_static(
          "read",
          [](const fs::path& path) { return unlocked([&] { return io::read_rotterdam_reference(path); }); },
          py::arg("path"), "reference.txt: x y z r io in a row, mm.")
      .def_property_readonly("points", view(&RotterdamReference::points), "(n, 3), mm, LPS")
      .def_property_readonly("radius", view(&RotterdamReference::radius), "(n,), mm")
      .def_property_readonly("observer_spread", view(&RotterdamReference::observer_spread),
                             "(n,), how far observers were from each other, mm")
      .def("__repr__",
           [](const RotterdamReference& r) {
             return py::str("<ostia.ReferenceLine: {} points>").format(r.points.size());
           })
      .def(py::pickle(
          [](const RotterdamReference& r) {
            return py::make_tuple(array_of(r.points), array_of(r.radius), array_of(r.observer_spread));
          },
          [](const py::tuple& s) { return reference_of(s[0], s[1], s[2]); }));
  same_when_copied(line);
  const std::string text = with_options<CenterlineScoreOptions>(
      m, "evaluate_centerline",
      "Overlap (ov, of, ot), accuracy (ai_mm) and counts of a line against a reference, as the Rotterdam "
      "challenge scores it. Of a VesselTree the best of its lines is taken; else a Centerline, or (n, 3).");
  m.def(
      "evaluate_centerline",
      [](const RotterdamReference& reference, const py::object& result, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<CenterlineScoreOptions>(options);
        const auto candidates = candidates_of(result);
        const auto best = watched(progress, [&](const TaskContext& task) {
          return evaluation::score_best_line(reference, candidates, how, task);
        });
        return scores_shown(reference, candidates[best.index].name, best.scores);
      },
      py::arg("reference"), py::arg("result"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

const ContourSection* section_like(const ContourSet& set, const ContourSection& like) {
  for (const ContourSection& s : set.sections)
    if (s.section == like.section && s.boundary == like.boundary) return &s;
  return nullptr;
}

/// One score for each of the reference's sections of a lumen.
std::vector<SectionScore> section_scores(const ContourSet& reference, const evaluation::LumenResult* surface,
                                         const ContourSet* contours, const LumenScoreOptions& how,
                                         const TaskContext& task) {
  std::vector<SectionScore> scores;
  for (const ContourSection& section : reference.sections) {
    if (section.boundary != "lumen") continue;
    task.throw_if_cancelled();
    const ContourSection* own = contours ? section_like(*contours, section) : nullptr;
    scores.push_back(surface ? surface->score(section, how, task)
                     : own   ? evaluation::result_of(*own).score(section, how, task)
                             : evaluation::score_of_nothing(section));
    task.set_progress(static_cast<double>(scores.size()) / static_cast<double>(reference.sections.size()));
  }
  if (scores.empty()) throw InvalidInput("reference: it holds no section of a lumen");
  return scores;
}

py::list summaries_of(const std::vector<SectionScore>& scores) {
  py::list rows;
  for (const Health health : {Health::healthy, Health::diseased}) {
    std::vector<SectionScore> group;
    for (const SectionScore& score : scores)
      if (score.health == health) group.push_back(score);
    if (group.empty()) continue;
    py::dict row = figures(evaluation::summarize(group));
    row["health"] = detail::word_of(health);
    rows.append(row);
  }
  return rows;
}

void bind_lumina(py::module_& m) {
  const std::string text = with_options<LumenScoreOptions>(
      m, "evaluate_lumen",
      "Dice and distances of a lumen (a TriMesh, or a ContourSet) in annotated sections: sections, a "
      "dictionary each with radii along it (k,), and summary, healthy and diseased apart.");
  m.def(
      "evaluate_lumen",
      [](const ContourSet& reference, const py::object& result, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<LumenScoreOptions>(options);
        const auto* mesh = py::isinstance<TriMesh>(result) ? result.cast<const TriMesh*>() : nullptr;
        const auto* drawn = py::isinstance<ContourSet>(result) ? result.cast<const ContourSet*>() : nullptr;
        if (mesh == nullptr && drawn == nullptr) refuse_call("result: a TriMesh or a ContourSet");
        const auto scores = watched(progress, [&](const TaskContext& task) {
          std::optional<evaluation::LumenResult> surface;
          if (mesh != nullptr) surface.emplace(*mesh);
          return section_scores(reference, surface ? &*surface : nullptr, drawn, how, task);
        });
        return py::dict("summary"_a = summaries_of(scores), "sections"_a = figures_of(scores));
      },
      py::arg("reference"), py::arg("result"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  m.def(
      "lumen_floor", [] { return figures_of(unlocked([] { return evaluation::floor_table(); })); },
      "How exact surfaces ruled between contours are, by the contours' spacing and their points: a list of "
      "dictionaries, mm.");
  m.def(
      "diameter_stenosis",
      [](const py::object& s_mm, const py::object& radius_mm) {
        return evaluation::diameter_stenosis(numbers_of(s_mm, "s_mm"), numbers_of(radius_mm, "radius_mm"));
      },
      py::arg("s_mm"), py::arg("radius_mm"),
      "How much narrower a section's thinnest place is than its ends let expect, [0, 1]; both (n,), mm.");
}

void bind_agreement(py::module_& m) {
  m.def(
      "bland_altman",
      [](const py::object& reference, const py::object& result) {
        return figures(
            evaluation::bland_altman(numbers_of(reference, "reference"), numbers_of(result, "result")));
      },
      py::arg("reference"), py::arg("result"),
      "Agreement of paired values, (n,) each, in one unit: bias, sd, limits of agreement with their errors, "
      "correlation.");
  m.def(
      "detect_stenoses",
      [](const py::object& reference, const py::object& result, double threshold) {
        const auto a = numbers_of(reference, "reference"), b = numbers_of(result, "result");
        if (a.size() != b.size())
          throw InvalidInput("result: " + std::to_string(b.size()) + " grades for " +
                             std::to_string(a.size()) + " of the reference; give one a place");
        std::vector<evaluation::GradedPlace> places;
        for (std::size_t i = 0; i < a.size(); ++i) places.push_back({a[i], b[i]});
        return figures(evaluation::detect_stenoses(places, threshold));
      },
      py::arg("reference"), py::arg("result"), py::arg("threshold") = 0.5,
      "How stenoses are detected and graded: diameter stenoses of n places, (n,) each, [0, 1].");
}

/// (p, n, 3) and the phases' percents (p,).
evaluation::PointMotion motion_of(const py::object& percent, const py::object& places,
                                  const std::string& name) {
  evaluation::PointMotion motion;
  motion.percent = numbers_of(percent, "percent");
  const py::array array = taken(places, {name, 'f', 8, {-1, -1, 3}}, {true, true});
  require_finite(array, name);
  const auto* from = static_cast<const double*>(array.data());
  for (py::ssize_t phase = 0; phase < array.shape(0); ++phase) {
    motion.phases.emplace_back();
    for (py::ssize_t i = 0; i < array.shape(1); ++i, from += 3)
      motion.phases.back().emplace_back(from[0], from[1], from[2]);
  }
  return motion;
}

evaluation::SurfaceMotion surfaces_of(const py::sequence& phases, const std::string& name) {
  evaluation::SurfaceMotion motion;
  for (const py::handle one : phases) {
    if (!py::isinstance<TriMesh>(one)) refuse_call(name + ": a list of TriMesh, one a phase");
    motion.names.push_back(std::to_string(motion.names.size()));
    motion.phases.push_back(one.cast<const TriMesh&>());
  }
  return motion;
}

void bind_motions(py::module_& m) {
  m.def(
      "evaluate_motion_points",
      [](const py::object& percent, const py::object& reference, const py::object& result) {
        const auto a = motion_of(percent, reference, "reference");
        const auto b = motion_of(percent, result, "result");
        return figures(unlocked([&] { return evaluation::compare_motion(a, b); }));
      },
      py::arg("percent"), py::arg("reference"), py::arg("result"),
      "Two motions of the same n points at p phases: percent of the cycle (p,), places (p, n, 3), mm.");
  m.def(
      "evaluate_motion",
      [](const py::sequence& reference, const py::sequence& result, double sample_mm, double resolution_mm,
         const py::object& progress) {
        const auto a = surfaces_of(reference, "reference"), b = surfaces_of(result, "result");
        return figures(watched(progress, [&](const TaskContext& task) {
          return evaluation::compare_surface_motion(a, b, {sample_mm, resolution_mm}, task);
        }));
      },
      py::arg("reference"), py::arg("result"), py::kw_only(), py::arg("sample_mm") = 0.2,
      py::arg("resolution_mm") = 0.2, py::arg("progress") = py::none(),
      "Two moving surfaces, a TriMesh a phase of one cycle: distances and overlap phase by phase, mm.");
  m.def(
      "evaluate_suite",
      [](const fs::path& golden, const fs::path& result, const std::optional<fs::path>& tolerance,
         const py::object& progress) {
        return json_of(watched(progress, [&](const TaskContext& task) {
          const auto rules =
              tolerance ? evaluation::read_tolerances(*tolerance) : evaluation::default_tolerances();
          return evaluation::suite_json(evaluation::compare_suites(golden, result, rules, task));
        }));
      },
      py::arg("golden"), py::arg("result"), py::arg("tolerance") = py::none(), py::kw_only(),
      py::arg("progress") = py::none(),
      "Two runs of any set of cases, folder against folder, as suite.json has it; tolerance: a file of "
      "rules.");
}

}  // namespace

void bind_evaluation(py::module_& m) {
  bind_surfaces(m);
  bind_volumes(m);
  bind_lines(m);
  bind_lumina(m);
  bind_agreement(m);
  bind_motions(m);
}

}  // namespace ostia::python
