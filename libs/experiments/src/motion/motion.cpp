#include "ostia/experiments/motion.h"

#include "motion/motion_branches.h"
#include "motion/motion_keep.h"
#include "motion/motion_scores.h"

#include "ostia/core/error.h"
#include "ostia/experiments/mixture_deformation.h"
#include "ostia/motion/cage_descent.h"
#include "ostia/motion/cage_registration.h"
#include "ostia/motion/moving_cage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <optional>

namespace ostia::experiments {
namespace {

using geometry::TriMesh;
using geometry::Vec3;
using Points = std::vector<Vec3>;

/// Phases outward from the template's in both directions, each with the one before it on its way.
struct Step {
  std::size_t phase;
  std::size_t from;
};
std::vector<Step> outward(std::size_t count, std::size_t first) {
  std::vector<Step> steps{{first, first}};
  for (std::size_t k = 1; steps.size() < count; ++k) {
    steps.push_back({(first + k) % count, (first + k - 1) % count});
    if (steps.size() < count) steps.push_back({(first + count - k) % count, (first + count - k + 1) % count});
  }
  return steps;
}

/// Seconds on the wall and of the processor, all threads together, since it was made.
class Stopwatch {
 public:
  void stop(MotionRun& run) const {
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    run.processor_seconds = static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC;
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::clock_t processor_ = std::clock();
};

struct Sampling {
  std::string name;  ///< "odd 10"
  std::size_t from, step;
};
/// Those of [Yi] 5.1.3 that leave three phases at least.
std::vector<Sampling> samplings(int phases) {
  std::vector<Sampling> found;
  const auto n = static_cast<std::size_t>(phases);
  for (const Sampling& s : {Sampling{"odd ", 1, 2}, {"even ", 0, 2}, {"odd ", 1, 4}, {"even ", 0, 4}})
    if (const std::size_t known = (n - s.from + s.step - 1) / s.step; known >= 3)
      found.push_back({s.name + std::to_string(known), s.from, s.step});
  return found;
}

bool same_phase(double a, double b) {
  return std::abs(a - b) < 1e-6;
}

/// One heart under the microscope. It is made when the first run asks for it.
class HeartRuns {
 public:
  HeartRuns(const MotionOptions& options, int number, MotionKeep& keep)
      : options_(options), number_(number), keep_(keep) {
    how_ = options.heart;
    how_.seed += static_cast<std::uint64_t>(number);
    name_ = heart_name(how_);
  }

  void run(const core::TaskContext& task) {
    const auto all = static_cast<std::size_t>(options_.heart.phases);
    if (keep_.count(name_, MotionMethod::none, 0, "all") < all) before(task);
    const double parts = static_cast<double>(options_.depths.size()) + 1.0;
    // Methods first: they are what takes longest, and need no cage of another phase.
    if (number_ < options_.compared_hearts) compare(task.sub(0.1, 1.0 / parts));
    for (std::size_t d = 0; d < options_.depths.size(); ++d)
      if (!done(options_.depths[d]))
        all_phases(options_.depths[d],
                   task.sub(static_cast<double>(d + 1) / parts, static_cast<double>(d + 2) / parts));
  }

 private:
  bool done(int depth) const {
    const auto all = static_cast<std::size_t>(options_.heart.phases);
    if (keep_.count(name_, MotionMethod::cage, depth, "all") < all) return false;
    if (depth != options_.depth) return true;
    for (const Sampling& s : samplings(options_.heart.phases))
      if (keep_.count(name_, MotionMethod::cage, depth, s.name) < all) return false;
    return keep_.has_branches(name_, depth);
  }

  const BeatingHeart& heart(const core::TaskContext& task) {
    if (heart_) return *heart_;
    heart_ = beating_heart(how_, task.sub(0.0, 0.1));
    template_intersections_ = intersections(heart_->model);
    for (std::size_t k = 0; k < heart_->phases.size(); ++k)
      if (same_phase(heart_->phases[k].phase, heart_->template_phase)) first_ = k;
    return *heart_;
  }

  void before(const core::TaskContext& task) {
    std::vector<MotionRun> runs;
    for (const HeartPhaseModel& phase : heart(task).phases)
      runs.push_back(scored(phase, heart_->model.points, {}, task));
    keep_.add(runs);
  }

  MotionRun scored(const HeartPhaseModel& phase, const Points& points, MotionRun run,
                   const core::TaskContext& task) const {
    task.throw_if_cancelled();
    if (run.sampling.empty()) run.sampling = "all";
    score(*heart_, phase, points, template_intersections_, options_.dice_resolution_mm, run,
          task.sub(0.0, 0.0));
    return run;
  }

  /// The template on every phase, each from its neighbour's cage; from the cage that is compared, also what
  /// follows from all phases together.
  void all_phases(int depth, const core::TaskContext& task) {
    const std::vector<HeartPhaseModel>& phases = heart(task).phases;
    std::vector<Points> found(phases.size());
    const std::vector<Step> steps = outward(phases.size(), first_);
    std::vector<MotionRun> runs(phases.size());
    geometry::CageGrid grid;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto [k, from] = steps[i];
      motion::RegistrationOptions how;
      how.depth = depth;
      if (from != k) how.start = found[from];
      runs[k].method = MotionMethod::cage;
      const core::TaskContext part = task.sub(static_cast<double>(i) / static_cast<double>(steps.size()),
                                              static_cast<double>(i + 1) / static_cast<double>(steps.size()));
      motion::Registration one = with_cage(how, phases[k], runs[k], part);
      grid = one.grid;
      found[k] = std::move(one.control_points);
    }
    std::vector<BranchRun> branches;
    if (depth == options_.depth) {
      sampled(grid, found, runs, task);
      branches = branch_runs(*heart_, grid, found, task.sub(1.0, 1.0));
    }
    keep_.add(runs, branches);
  }

  /// Registers and fills in `run`.
  motion::Registration with_cage(const motion::RegistrationOptions& how, const HeartPhaseModel& phase,
                                 MotionRun& run, const core::TaskContext& task) const {
    run.depth = how.depth;
    const Stopwatch watch;
    motion::Registration found = motion::register_cage(heart_->model, phase.segmented, how, task);
    watch.stop(run);
    run.inverted_cells = inverted_cells(found.grid, found.control_points);
    run = scored(phase, found.surface.points, run, task);
    return found;
  }

  /// Some phases known, all the others from their splines ([Yi] 5.1.3).
  void sampled(const geometry::CageGrid& grid, const std::vector<Points>& known, std::vector<MotionRun>& runs,
               const core::TaskContext& task) const {
    const motion::CarriedPoints carried(grid, heart_->model.points);
    for (const Sampling& s : samplings(options_.heart.phases)) {
      std::vector<double> phases;
      std::vector<Points> places;
      for (std::size_t k = s.from; k < heart_->phases.size(); k += s.step) {
        phases.push_back(heart_->phases[k].phase);
        places.push_back(known[k]);
      }
      const motion::CyclicSpline spline(phases, places);
      for (const HeartPhaseModel& phase : heart_->phases) {
        const Points points = spline.at(phase.phase);
        MotionRun run;
        run.method = MotionMethod::cage;
        run.depth = options_.depth;
        run.sampling = s.name;
        run.inverted_cells = inverted_cells(grid, points);
        runs.push_back(scored(phase, carried.places(points), run, task));
      }
    }
  }

  /// Phase by phase, all methods at each: what is there when this is stopped can be compared.
  void compare(const core::TaskContext& task) {
    const double all = static_cast<double>(options_.methods.size() * options_.compared_phases.size());
    double done = 0.0;
    for (const double share : options_.compared_phases)
      for (const MotionMethod method : options_.methods) {
        const core::TaskContext part = task.sub(done / all, (done + 1.0) / all);
        done += 1.0;
        if (keep_.count(name_, method, options_.depth, "all", share) > 0) continue;
        const std::vector<HeartPhaseModel>& phases = heart(task).phases;
        const auto phase = std::find_if(phases.begin(), phases.end(),
                                        [&](const auto& one) { return same_phase(one.phase, share); });
        keep_.add({with(method, *phase, part)});
      }
  }

  MotionRun with(MotionMethod method, const HeartPhaseModel& phase, const core::TaskContext& task) const {
    MotionRun run;
    run.method = method;
    run.depth = options_.depth;
    if (method == MotionMethod::cage_rest) {
      motion::RegistrationOptions how;
      how.depth = options_.depth;
      with_cage(how, phase, run, task);
      return run;
    }
    const Stopwatch watch;
    if (method == MotionMethod::descent || method == MotionMethod::descent_free) {
      motion::DescentOptions how;
      how.depth = options_.depth;
      how.with_energy = method == MotionMethod::descent;
      const motion::Registration found =
          motion::register_cage_by_descent(heart_->model, phase.segmented, how, task);
      watch.stop(run);
      run.inverted_cells = inverted_cells(found.grid, found.control_points);
      return scored(phase, found.surface.points, run, task);
    }
    MixtureOptions how;
    how.depth = options_.depth;
    const bool splines = method == MotionMethod::tps_l2 || method == MotionMethod::tps_kc;
    how.kind = splines ? DeformationKind::thin_plate_spline : DeformationKind::gaussian_basis;
    how.cost = method == MotionMethod::tps_l2 || method == MotionMethod::grbf_l2
                   ? MixtureCost::l2
                   : MixtureCost::kernel_correlation;
    const MixtureDeformation found = deform_by_mixtures(heart_->model, phase.segmented, how, task);
    watch.stop(run);
    return scored(phase, found.surface.points, run, task);
  }

  const MotionOptions& options_;
  int number_;
  MotionKeep& keep_;
  BeatingHeartOptions how_;
  std::string name_;
  std::optional<BeatingHeart> heart_;
  std::size_t template_intersections_ = 0, first_ = 0;
};

}  // namespace

MotionResults run_motion(const MotionOptions& options, const core::TaskContext& task) {
  validate(options);
  MotionKeep keep(options);
  for (int i = 0; i < options.hearts; ++i) {
    task.throw_if_cancelled();
    const core::TaskContext part =
        task.sub(static_cast<double>(i) / options.hearts, static_cast<double>(i + 1) / options.hearts);
    part.set_stage("heart " + std::to_string(i + 1) + " of " + std::to_string(options.hearts));
    HeartRuns(options, i, keep).run(part);
  }
  MotionResults results = keep.results();
  std::erase_if(results.branches, [&](const BranchRun& run) { return run.depth != options.depth; });
  return results;
}

}  // namespace ostia::experiments
