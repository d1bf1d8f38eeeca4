#include "ostia/experiments/hard.h"

#include "hard/baseline_growing.h"
#include "hard/baseline_path.h"
#include "hard/hard_truth.h"
#include "motion/heart_field.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/phantom/stair_steps.h"

#include <algorithm>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

constexpr double judged_mm = 1.5;  // width of the vessels that are judged, where they begin

phantom::CasePlan plan_of_hard(HardSuite suite, std::uint64_t seed, const HardPatient* patient,
                               const HardOptions& options) {
  phantom::CaseOptions usual;
  usual.seed = seed;
  usual.preset = phantom::Preset::small;
  if (patient) usual.patient = patient->tree;
  const bool hard = suite == HardSuite::hard;
  return plan_on_heart_field(hard ? hard_case(usual, options.strength) : usual, options.voxel_mm);
}

std::vector<Vec3> ostia_of(const phantom::CasePlan& plan) {
  std::vector<Vec3> ostia;
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels)
    if (vessel.parent < 0) ostia.push_back(phantom::shown_at(plan.options.scan, vessel.axis.points.front()));
  return ostia;
}

VesselRun scored_way(const TrueVessel& vessel, const std::vector<Vec3>& way, const core::TaskContext& task) {
  VesselRun run;
  run.name = vessel.name;
  run.annotated = vessel.annotated;
  run.length_mm = geometry::length(vessel.reference.points);
  run.scores = evaluation::score_centerline(vessel.reference, way, {}, task);
  run.scores.pairs.clear();
  run.scores.line.clear();
  return run;
}

/// Between the true ends; scored against what was traced.
ExtractionRun by_path(const ExtractionTruth& truth, const ExtractionTruth& traced,
                      const imaging::ImageVolume& image, const core::TaskContext& task) {
  ExtractionRun run;
  run.case_name = truth.case_name;
  const imaging::FloatVolume cost = cost_per_mm(image, {}, task.sub(0.0, 0.8));
  // One front serves all vessels that begin at the same place.
  std::vector<Vec3> starts;
  for (const TrueVessel& vessel : truth.vessels)
    if (std::ranges::find(starts, vessel.reference.points.front()) == starts.end())
      starts.push_back(vessel.reference.points.front());
  std::vector<std::vector<Vec3>> ways(truth.vessels.size());
  for (const Vec3& start : starts) {
    std::vector<std::size_t> members;
    std::vector<Vec3> ends;
    for (std::size_t n = 0; n < ways.size(); ++n) {
      const std::vector<Vec3>& points = truth.vessels[n].reference.points;
      if (points.front() != start) continue;
      members.push_back(n);
      ends.push_back(points.back());
    }
    std::vector<std::vector<Vec3>> found = cheapest_ways(cost, start, ends, task.sub(0.8, 1.0));
    for (std::size_t m = 0; m < members.size(); ++m) ways[members[m]] = std::move(found[m]);
  }
  for (std::size_t n = 0; n < ways.size(); ++n) {
    const TrueVessel& vessel = truth.vessels[n];
    if (ways[n].size() < 2) ways[n] = {vessel.reference.points.front(), vessel.reference.points.back()};
    run.vessels.push_back(scored_way(traced.vessels[n], ways[n], task));
  }
  return run;
}

/// Without names: the tree's vessels are lines of a skeleton.
ExtractionRun by_growing(const ExtractionTruth& truth, const imaging::ImageVolume& image,
                         const std::vector<Vec3>& ostia, const ExtractionScoreOptions& options,
                         const core::TaskContext& task) {
  try {
    const GrownRegion grown = grow_region(image, ostia, {}, task.sub(0.0, 0.7));
    if (grown.tree.vessels.empty()) return score_of_no_extraction(truth, "nothing grew, or all of it leaked");
    coronary::LabelledTree lines;
    lines.tree = grown.tree;
    for (const geometry::Vessel& vessel : grown.tree.vessels) {
      lines.labels.emplace_back();
      lines.labels.back().vessel = vessel.id;
    }
    return score_axes(truth, lines, options, task.sub(0.7, 1.0));
  } catch (const InvalidInput& error) {  // lines that turn back on themselves have no axis
    return score_of_no_extraction(truth, error.what());
  } catch (const GeometryError& error) {  // no curves
    return score_of_no_extraction(truth, error.what());
  }
}

void search_into(HardRun& run, const ExtractionTruth& truth, const imaging::ImageVolume& image,
                 const ExtractionScoreOptions& options, const core::TaskContext& task) {
  try {
    const session::FoundModel found = session::found_model(image, {}, task.sub(0.0, 0.6));
    run.warnings = found.found.warnings;
    run.search = score_extraction(truth, found, options, task.sub(0.6, 1.0));
  } catch (const GeometryError& error) {
    run.search = score_of_no_extraction(truth, error.what());
  } catch (const InvalidInput& error) {
    run.search = score_of_no_extraction(truth, error.what());
  }
}

HardRun run_one_hard(HardSuite suite, std::uint64_t seed, const HardPatient* patient,
                     const HardOptions& options, const core::TaskContext& task) {
  HardRun run;
  run.suite = suite;
  run.seed = seed;
  if (patient) run.patient = patient->name;
  if (suite == HardSuite::hard) run.draw = phantom::draw_hard(seed, options.strength);
  task.set_stage(std::string(word(suite)) + ", seed " + std::to_string(seed) +
                 (patient ? ", " + patient->name : ""));
  const phantom::CasePlan plan = plan_of_hard(suite, seed, patient, options);
  const ExtractionTruth truth = truth_of_plan(plan, judged_mm);
  const imaging::ImageVolume image = phantom::scan_case(plan, task.sub(0.0, 0.25)).image;
  const ExtractionTruth traced = truth_as_traced(plan, truth);
  run.path = by_path(truth, traced, image, task.sub(0.25, 0.6));
  run.growing = by_growing(traced, image, ostia_of(plan), options.scores, task.sub(0.6, 0.7));
  if (options.search) search_into(run, truth, image, options.scores, task.sub(0.7, 1.0));
  task.set_progress(1.0);
  return run;
}

}  // namespace

void validate(const HardOptions& options) {
  if (options.cases < 1 || options.cases > 100)
    throw InvalidInput("hard experiment: 1 to 100 cases, not " + std::to_string(options.cases));
  if (!(options.voxel_mm >= 0.35 && options.voxel_mm <= 2.0))
    throw InvalidInput("hard experiment: voxels of 0.35 to 2 mm, not " + std::to_string(options.voxel_mm));
  phantom::validate(options.strength);
  validate(options.scores);
}

const char* word(HardSuite suite) {
  return suite == HardSuite::full ? "full" : "hard";
}

const char* word(HardMethod method) {
  switch (method) {
    case HardMethod::path:
      return "path";
    case HardMethod::growing:
      return "growing";
    case HardMethod::search:
      break;
  }
  return "search";
}

const ExtractionRun& run_of(const HardRun& run, HardMethod method) {
  switch (method) {
    case HardMethod::path:
      return run.path;
    case HardMethod::growing:
      return run.growing;
    case HardMethod::search:
      break;
  }
  return run.search;
}

std::vector<HardRun> run_hard(const HardOptions& options, const std::vector<HardPatient>& patients,
                              const core::TaskContext& task) {
  validate(options);
  std::vector<HardSuite> suites{HardSuite::hard};
  if (options.easy) suites.insert(suites.begin(), HardSuite::full);
  const std::size_t kinds = patients.empty() ? 1 : 2, cases = static_cast<std::size_t>(options.cases);
  const auto count = static_cast<double>(suites.size() * kinds * cases);
  std::vector<HardRun> runs;
  for (const HardSuite suite : suites)
    for (std::size_t kind = 0; kind < kinds; ++kind)
      for (std::size_t n = 0; n < cases; ++n) {
        const auto done = static_cast<double>(runs.size());
        task.throw_if_cancelled();
        runs.push_back(run_one_hard(suite, options.first_seed + n,
                                    kind == 0 ? nullptr : &patients[n % patients.size()], options,
                                    task.sub(done / count, (done + 1.0) / count)));
      }
  return runs;
}

}  // namespace ostia::experiments
