#include "extraction/own_axes.h"

#include "ostia/experiments/extraction.h"
#include "ostia/geometry/polyline.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/session/case_report.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

std::vector<std::pair<double, double>> missed_stretches(const io::RotterdamReference& reference,
                                                        const evaluation::CenterlineScores& scores) {
  std::vector<std::pair<double, double>> missed;
  bool open = false;
  for (const evaluation::ReferencePointScore& point : evaluation::along_reference(reference, scores)) {
    if (!point.matched && !open) missed.emplace_back(point.s_mm, point.s_mm);
    open = !point.matched;
    if (open) missed.back().second = point.s_mm;
  }
  return missed;
}

VesselRun nothing_of(const TrueVessel& vessel) {
  VesselRun run;
  run.name = vessel.name;
  run.annotated = vessel.annotated;
  run.length_mm = geometry::length(vessel.reference.points);
  run.scores.fn = vessel.reference.points.size();
  run.scores.ot = *std::max_element(vessel.reference.radius.begin(), vessel.reference.radius.end()) >=
                          evaluation::CenterlineScoreOptions{}.least_radius_mm
                      ? 0.0
                      : NAN;
  run.scores.ai_mm = run.scores.ai_score = NAN;
  run.missed_mm = {{0.0, run.length_mm}};
  return run;
}

VesselRun scored(const TrueVessel& vessel, const std::vector<evaluation::NamedLine>& lines,
                 const core::TaskContext& task) {
  VesselRun run = nothing_of(vessel);
  run.scores = evaluation::score_best_line(vessel.reference, lines, {}, task).scores;
  run.missed_mm = missed_stretches(vessel.reference, run.scores);
  run.scores.pairs.clear();
  run.scores.line.clear();
  return run;
}

/// Which found vessel covers each true vessel's own stretch, and whether it bears its name.
void judge_names(const std::vector<OwnAxis>& truth, const std::vector<OwnAxis>& found,
                 const coronary::LabelledTree& labelled, double astray_mm, ExtractionRun& run) {
  std::map<std::int32_t, bool> named;
  const geometry::VesselTree& tree = labelled.tree;
  for (std::size_t i = 0; i < tree.vessels.size(); ++i)
    named[tree.vessels[i].id] = tree.vessels[i].name == labelled.labels[i].likeliest;
  for (const OwnAxis& axis : truth) {
    std::map<std::size_t, std::size_t> covers;
    for (std::size_t i = 0; i < axis.points.size(); ++i) {
      const NearestAxis near = nearest_axis(found, axis.points[i]);
      if (near.away_mm <= axis.radius_mm[i] + astray_mm) ++covers[near.axis];
    }
    const auto most = std::max_element(covers.begin(), covers.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto vessel = std::find_if(run.vessels.begin(), run.vessels.end(),
                                     [&](const VesselRun& one) { return one.name == axis.name; });
    if (most == covers.end() || vessel == run.vessels.end() || 2 * most->second < axis.points.size())
      continue;
    vessel->found_name = found[most->first].name;
    vessel->verdict = !named[found[most->first].vessel] ? NameVerdict::unnamed
                      : vessel->found_name == axis.name ? NameVerdict::right
                                                        : NameVerdict::wrong;
  }
}

/// How much of the found tree lies outside of every true lumen.
void measure_astray(const std::vector<OwnAxis>& truth, const std::vector<OwnAxis>& found, double astray_mm,
                    ExtractionRun& run) {
  constexpr double step_mm = 0.25;
  for (const OwnAxis& axis : found) {
    const std::vector<Vec3> points = geometry::resample(axis.points, step_mm);
    const double step = geometry::length(axis.points) / static_cast<double>(points.size() - 1);
    double piece = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      run.found_mm += step;
      const NearestAxis near = nearest_axis(truth, points[i]);
      piece = near.away_mm > near.radius_mm + astray_mm ? piece + step : 0.0;
      if (piece > 0.0) run.astray_mm += step;
      run.longest_astray_mm = std::max(run.longest_astray_mm, piece);
    }
  }
}

/// The report's stenoses at the places of the true vessels.
std::vector<evaluation::Lesion> stenoses_of(const session::FoundModel& model,
                                            const std::vector<OwnAxis>& truth, double astray_mm,
                                            const core::TaskContext& task) {
  constexpr double least_mm = 0.05;  // between the ends of a lesion
  const session::CaseReport report =
      session::make_case_report(model.model, session::solved_surfaces(model.model, task.sub(0.0, 0.5)), {},
                                {}, nullptr, {}, task.sub(0.5, 1.0));
  std::vector<evaluation::Lesion> lesions;
  for (const session::ReportStenosis& one : report.stenoses) {
    const auto vessel = std::find_if(model.model.tree.vessels.begin(), model.model.tree.vessels.end(),
                                     [&](const geometry::Vessel& v) { return v.id == one.stenosis.vessel; });
    const std::vector<Vec3> axis = geometry::vessel_axis(model.model.tree, *vessel).points;
    const auto place = [&](double s_mm) { return geometry::at_abscissa(axis, s_mm).point; };
    const NearestAxis throat = nearest_axis(truth, place(one.stenosis.throat_mm));
    evaluation::Lesion lesion{"none, by " + one.vessel_name, one.stenosis.from_mm, one.stenosis.to_mm,
                              one.stenosis.throat_mm,
                              std::clamp(one.stenosis.diameter_percent, 0.0, 100.0) / 100.0};
    if (throat.away_mm <= throat.radius_mm + astray_mm) {
      const std::vector<OwnAxis> same{truth[throat.axis]};
      lesion.vessel = same.front().name;
      lesion.s_throat_mm = throat.s_mm;
      lesion.s_from_mm =
          std::min(nearest_axis(same, place(one.stenosis.from_mm)).s_mm, throat.s_mm - least_mm);
      lesion.s_to_mm = std::max(nearest_axis(same, place(one.stenosis.to_mm)).s_mm, throat.s_mm + least_mm);
    }
    lesions.push_back(std::move(lesion));
  }
  return lesions;
}

bool is_asked(const geometry::ContourSection& section) {
  return section.observer == "truth" && section.boundary == "lumen";
}

}  // namespace

ExtractionRun score_of_no_extraction(const ExtractionTruth& truth, const std::string& why) {
  ExtractionRun run;
  run.case_name = truth.case_name;
  run.failure = why;
  run.lesions = truth.lesions;
  for (const TrueVessel& vessel : truth.vessels) run.vessels.push_back(nothing_of(vessel));
  for (const geometry::ContourSection& section : truth.contours.sections)
    if (is_asked(section)) run.sections.push_back(evaluation::score_of_nothing(section));
  return run;
}

ExtractionRun score_axes(const ExtractionTruth& truth, const coronary::LabelledTree& found,
                         const ExtractionScoreOptions& options, const core::TaskContext& task) {
  validate(options);
  ExtractionRun run;
  run.case_name = truth.case_name;
  const std::vector<evaluation::NamedLine> lines = evaluation::lines_of(found.tree);
  for (const TrueVessel& vessel : truth.vessels) run.vessels.push_back(scored(vessel, lines, task));
  const std::vector<OwnAxis> true_axes = own_axes(truth.tree), found_axes = own_axes(found.tree);
  judge_names(true_axes, found_axes, found, options.astray_mm, run);
  measure_astray(true_axes, found_axes, options.astray_mm, run);
  return run;
}

ExtractionRun score_extraction(const ExtractionTruth& truth, const session::FoundModel& found,
                               const ExtractionScoreOptions& options, const core::TaskContext& task) {
  ExtractionRun run = score_axes(truth, found.found.vessels, options, task.sub(0.0, 0.3));
  run.lesions = truth.lesions;
  const evaluation::LumenResult wall(lumen::surface_of(found.model, 0.0, task.sub(0.3, 0.5)));
  for (const geometry::ContourSection& section : truth.contours.sections)
    if (is_asked(section)) run.sections.push_back(wall.score(section, {}, task));
  run.found_lesions = stenoses_of(found, own_axes(truth.tree), options.astray_mm, task.sub(0.7, 1.0));
  return run;
}

}  // namespace ostia::experiments
