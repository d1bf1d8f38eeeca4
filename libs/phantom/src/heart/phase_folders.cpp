#include "cases/case_parts.h"

#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/wfdb_file.h"
#include "ostia/phantom/heart_ecg.h"
#include "ostia/phantom/moving_case.h"

#include <atomic>

namespace ostia::phantom {
namespace fs = std::filesystem;
namespace {

/// What is known of the template, to be moved.
struct Truth {
  geometry::VesselTree tree;
  geometry::ContourSet contours;  ///< the true ones alone
  std::vector<ChallengeVessel> vessels;
  const geometry::TriMesh& lumen;
};

Truth truth_of(const CasePlan& plan, const geometry::TriMesh& lumen) {
  ObserverOptions none = plan.options.observers;
  none.count = 0;  // people drew at the template's phase alone
  Truth truth{vessel_tree(plan.tree),
              annotate(plan.tree, plan.sections.sections, plan.options.contours, none),
              plan.challenge.vessels, lumen};
  for (ChallengeVessel& vessel : truth.vessels) vessel.observers.clear();
  return truth;
}

void write_truth(const fs::path& folder, const Truth& truth, const BeatPhase& phase,
                 const core::TaskContext& task) {
  fs::create_directory(folder);
  for (const ChallengeVessel& vessel : truth.vessels)
    write_vessel(folder / ("vessel" + std::to_string(vessel.number)), moved(vessel, phase));
  task.throw_if_cancelled();
  io::write_contours(folder / "contours.json", moved(truth.contours, phase));
  io::write_centerlines(folder / "centerlines.vtp", moved(truth.tree, phase));
  task.throw_if_cancelled();
  io::write_surface(folder / "lumen.vtp", moved(truth.lumen, phase));
}

/// The same file under another name: what reads moving surfaces wants them in one folder.
void show_beside(const fs::path& file, const fs::path& name) {
  std::error_code none;
  fs::create_hard_link(file, name, none);
  if (none) fs::copy_file(file, name);
}

}  // namespace

std::vector<VesselMotion> write_phases(const fs::path& folder, int number, const SuiteOptions& options,
                                       const CasePlan& plan, const geometry::TriMesh& lumen,
                                       const core::TaskContext& task) {
  const Heartbeat beat = heartbeat_of(plan);
  const std::vector<double> percents = phase_percents(options.phases);
  std::vector<VesselMotion> vessels = vessel_motion(plan.tree, beat);
  task.throw_if_cancelled();
  core::write_file(folder / "heartbeat.json", heartbeat_json(beat, percents, vessels));
  core::write_file(folder / "motion.json", motion_json(plan.tree, beat, percents));
  const HeartEcg ecg = draw_ecg(beat.amplitudes().heart_rate_per_min, plan.options.seed);
  io::write_wfdb(folder / "ecg.hea", ecg.record, ecg.beats);
  fs::create_directory(folder / "lumen");
  const Truth truth = truth_of(plan, lumen);
  const core::TaskContext truths = task.sub(0.0, options.truth_only ? 1.0 : 0.1);
  std::atomic<std::size_t> done{0};
  core::parallel_for(percents.size(), 1, [&](std::size_t i) {
    task.throw_if_cancelled();
    const std::string name = phase_name(percents[i]);
    write_truth(folder / name, truth, beat.phase(percents[i]), task);
    show_beside(folder / name / "lumen.vtp", folder / "lumen" / (name + ".vtp"));
    truths.set_progress(static_cast<double>(++done) / static_cast<double>(percents.size()));
  });
  if (options.truth_only) return vessels;
  // One image after the other: a full one takes a good part of a gigabyte.
  const Body body(plan.heart, plan.tree, body_of(plan.options), plan.warp);
  for (std::size_t i = 0; i < percents.size(); ++i) {
    const double n = static_cast<double>(percents.size());
    const core::TaskContext own =
        task.sub(0.1 + 0.9 * static_cast<double>(i) / n, 0.1 + 0.9 * static_cast<double>(i + 1) / n);
    own.set_stage("case " + std::to_string(number + 1) + ": image " + std::to_string(i + 1) + " of " +
                  std::to_string(percents.size()));
    const Scan scan = scan_phase(plan, body, beat.phase(percents[i]), own.sub(0.0, 0.8));
    write_image(folder / phase_name(percents[i]), number, options, plan, scan, percents[i],
                own.sub(0.8, 1.0));
  }
  return vessels;
}

}  // namespace ostia::phantom
