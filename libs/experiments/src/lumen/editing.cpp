#include "ostia/experiments/editing.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/lumen/live_model.h"
#include "ostia/lumen/start_surface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>
#include <variant>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using geometry::AxisCurve;
using geometry::ContourSection;
using geometry::ContourSet;
using geometry::VesselTree;

Distances distances_of(const evaluation::SectionScore& score) {
  return {score.msd_mm, score.max_sd_mm, score.dice};
}

const ContourSection& section_of(const ContourSet& contours, const std::string& section,
                                 const std::string& observer) {
  for (const ContourSection& one : contours.sections)
    if (one.section == section && one.observer == observer && one.boundary == "lumen") return one;
  throw InvalidInput("there are no contours of section " + section + " by " + observer);
}

/// The stretch of the given axis that the section is edited on, as a tree of one vessel.
VesselTree stretch_of(const VesselTree& tree, const ContourSection& overlay, const EditingOptions& options,
                      double radius_mm) {
  const auto named = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                  [&](const geometry::Vessel& v) { return v.name == overlay.vessel; });
  if (named == tree.vessels.end())
    throw InvalidInput("section " + overlay.section + " lies on " + overlay.vessel +
                       ", which the tree does not have");
  const AxisCurve whole(geometry::vessel_axis(tree, *named));
  const double first = whole.nearest_foot(geometry::contour_centroid(overlay.contours.front())).s_mm;
  const double last = whole.nearest_foot(geometry::contour_centroid(overlay.contours.back())).s_mm;
  const double own = lumen::own_from_mm(tree, named->id);
  const double from = std::max(own, std::min(first, last) - options.margin_mm);
  const double to = std::min(whole.length(), std::max(first, last) + options.margin_mm);
  geometry::Centerline axis;
  const auto pieces = static_cast<int>(std::ceil((to - from) / 0.25));
  for (int i = 0; i <= pieces; ++i) {
    axis.points.push_back(whole.point(from + (to - from) * i / pieces));
    axis.radius.push_back(radius_mm);
  }
  geometry::complete(axis, whole.frame(from).normal);
  VesselTree out;
  out.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  out.segments = {{3, 1, 2, axis}};
  out.vessels = {{4, overlay.vessel, {3}}};
  return out;
}

double mean_radius(const ContourSection& section) {
  double sum = 0.0;
  for (const geometry::Contour& contour : section.contours)
    sum += std::sqrt(geometry::contour_area(contour) / 3.14159265358979323846);
  return sum / static_cast<double>(section.contours.size());
}

}  // namespace

void validate(const EditingOptions& options) {
  validate(options.reader);
  if (!(options.margin_mm >= 0.0)) throw InvalidInput("the margin beyond a section must not be negative");
  if (!std::isfinite(options.start_excess_mm)) throw InvalidInput("the start's excess radius must be finite");
}

SectionRun edit_section(const VesselTree& tree, const ContourSet& contours, const std::string& section,
                        const EditingOptions& options, const core::TaskContext& task) {
  validate(options);
  const ContourSection& overlay = section_of(contours, section, options.observer);
  const ContourSection& truth = section_of(contours, section, "truth");
  SectionRun run;
  run.section = section;
  run.vessel = overlay.vessel;
  run.health = overlay.health;
  run.start_radius_mm = std::max(0.3, mean_radius(overlay) + options.start_excess_mm);
  const evaluation::LumenResult own = evaluation::result_of(overlay);
  run.observer_against_truth = distances_of(own.score(truth, {}, task));
  const evaluation::SectionScore itself = own.score(overlay, {}, task);
  run.floor_mm = itself.floor_mm;
  run.length_mm = itself.length_mm;

  lumen::SamplingOptions sampling;
  sampling.spacing_mm = options.start_spacing_mm;
  run.start = lumen::model_of_tubes(stretch_of(tree, overlay, options, run.start_radius_mm),
                                    run.start_radius_mm, sampling);
  auto model = std::make_shared<const lumen::LumenModel>(run.start);
  lumen::LiveModel live(model);
  const lumen::VesselLumen& vessel = *run.start.vessels.front();
  SimulatedReader reader(overlay, vessel.axis, vessel.vessel, options.reader);
  double seconds = 0.0;
  // On the way a third of the samples will do; the table's figures are taken in full.
  const evaluation::LumenScoreOptions on_the_way{.sample_mm = 0.3, .line_mm = 0.1};
  const auto score = [&](const geometry::TriMesh& wall, const evaluation::LumenScoreOptions& how) {
    const evaluation::LumenResult result(wall);
    SectionRun::Step step;
    step.strokes = static_cast<int>(run.edits.size());
    step.seconds = seconds;
    step.to_observer = distances_of(result.score(overlay, how, task));
    step.to_truth = distances_of(result.score(truth, how, task));
    run.steps.push_back(step);
  };
  score(live.wall(0.25, task), {});
  while (const auto stroke = reader.next(*live.surface(vessel.vessel))) {
    task.throw_if_cancelled();
    seconds += stroke->seconds;
    try {
      live.follow(lumen::apply(live.model(), stroke->edit));
    } catch (const InvalidInput& e) {
      reader.refused();
      run.refusals.emplace_back(e.what());
      continue;
    }
    run.edits.push_back(stroke->edit);
    run.section_strokes += stroke->on_section ? 1 : 0;
    score(live.wall(0.25, task), on_the_way);
  }
  run.stopped = reader.why_stopped();
  // The last word is that of the stored model, solved afresh.
  run.steps.pop_back();
  score(lumen::surface_of(live.model(), 0.0, task), {});
  run.digest = lumen::digest(live.model());
  return run;
}

std::vector<SectionRun> edit_suite(const fs::path& suite, const EditingOptions& options,
                                   const core::TaskContext& task) {
  validate(options);
  std::vector<fs::path> cases;
  if (fs::is_directory(suite)) {
    for (const auto& entry : fs::directory_iterator(suite))
      if (entry.is_directory() && entry.path().filename().string().starts_with("dataset"))
        cases.push_back(entry.path());
  }
  if (cases.empty())
    throw InvalidInput(
        suite.filename().string() +
        " holds no dataset folders; make a suite by `ostia phantom -o DIR --cases 18 --truth-only`");
  std::sort(cases.begin(), cases.end());
  std::vector<SectionRun> runs;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const VesselTree tree = io::read_centerlines(cases[k] / "centerlines.vtp");
    const ContourSet contours = io::read_contours(cases[k] / "contours.json");
    std::vector<std::string> names;
    for (const ContourSection& one : contours.sections) {
      if (one.observer == options.observer && one.boundary == "lumen") names.push_back(one.section);
    }
    if (names.empty())
      throw InvalidInput((cases[k].filename() / "contours.json").string() + " has no contours by " +
                         options.observer);
    for (std::size_t i = 0; i < names.size(); ++i) {
      task.set_stage(cases[k].filename().string() + " " + names[i]);
      task.set_progress(
          (static_cast<double>(k) + static_cast<double>(i) / static_cast<double>(names.size())) /
          static_cast<double>(cases.size()));
      SectionRun run = edit_section(tree, contours, names[i], options, task.sub(0.0, 0.0));
      run.case_name = cases[k].filename().string();
      runs.push_back(std::move(run));
    }
  }
  task.set_progress(1.0);
  return runs;
}

EditingSummary summarize(const std::vector<SectionRun>& runs, geometry::Health health) {
  EditingSummary out;
  std::vector<double> strokes;
  double on_sections = 0.0, all = 0.0;
  const auto add = [](Distances& sum, const Distances& one, double weight, double count) {
    sum.msd_mm += weight * one.msd_mm;
    sum.dice += weight * one.dice;
    sum.max_sd_mm += count * one.max_sd_mm;
  };
  double length = 0.0, count = 0.0;
  for (const SectionRun& run : runs) {
    if (run.health != health) continue;
    length += run.length_mm;
    count += 1.0;
  }
  if (count == 0.0) return out;
  for (const SectionRun& run : runs) {
    if (run.health != health) continue;
    const double w = run.length_mm / length, n = 1.0 / count;
    add(out.start, run.first().to_observer, w, n);
    add(out.start_to_truth, run.first().to_truth, w, n);
    add(out.final, run.last().to_observer, w, n);
    add(out.final_to_truth, run.last().to_truth, w, n);
    add(out.observer_against_truth, run.observer_against_truth, w, n);
    out.floor_msd_mm += w * run.floor_mm;
    out.mean_seconds += n * run.last().seconds;
    strokes.push_back(static_cast<double>(run.edits.size()));
    all += static_cast<double>(run.edits.size());
    on_sections += run.section_strokes;
  }
  out.sections = strokes.size();
  out.length_mm = length;
  out.section_share = all > 0.0 ? on_sections / all : 0.0;
  std::sort(strokes.begin(), strokes.end());
  const std::size_t middle = strokes.size() / 2;
  out.median_strokes =
      strokes.size() % 2 == 1 ? strokes[middle] : 0.5 * (strokes[middle - 1] + strokes[middle]);
  return out;
}

}  // namespace ostia::experiments
