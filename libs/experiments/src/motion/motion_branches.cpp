#include "motion/motion_branches.h"

#include "ostia/analysis/motion_measures.h"
#include "ostia/motion/moving_cage.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ostia::experiments {

using analysis::MotionMeasure;
using geometry::Vec3;

namespace {

constexpr double least_torsion_per_mm = 0.005;

analysis::TreeMotion known_motion(const BeatingHeart& heart, const core::TaskContext& task) {
  std::vector<double> phases;
  std::vector<geometry::VesselTree> trees;
  for (const HeartPhaseModel& phase : heart.phases) {
    phases.push_back(phase.phase);
    trees.push_back(phase.axes);
  }
  return analysis::measure_motion(analysis::followed_tree(heart.axes, heart.template_phase, phases, trees),
                                  {}, task);
}

analysis::TreeMotion fitted_motion(const BeatingHeart& heart, const geometry::CageGrid& grid,
                                   const std::vector<std::vector<Vec3>>& control_points,
                                   const core::TaskContext& task) {
  geometry::CageMotion motion;
  motion.grid = grid;
  motion.template_phase = heart.template_phase;
  std::vector<double> phases;
  for (std::size_t k = 0; k < heart.phases.size(); ++k) {
    phases.push_back(heart.phases[k].phase);
    motion.phases.push_back({heart.phases[k].phase, control_points[k], geometry::PhaseOrigin::fitted});
  }
  return analysis::measure_motion(
      analysis::carried_tree(heart.axes, motion::MovingCage(motion), phases, 0.5, task), {}, task);
}

/// Relative errors of one measure, and errors as shares of the branch's largest true change.
class Errors {
 public:
  void add(const std::string& branch, double fitted, double truth, double at_template, double least) {
    if (std::isnan(fitted) || std::isnan(truth)) return;
    Change& change = changes_[branch];
    change.largest = std::max(change.largest, std::abs(truth - at_template));
    change.errors += std::abs(fitted - truth);
    ++change.count;
    if (std::abs(truth) >= least) relative_.push_back(std::abs(fitted - truth) / std::abs(truth));
  }

  BranchAgreement result() {
    BranchAgreement found;
    found.count = relative_.size();
    if (relative_.empty()) return found;
    std::sort(relative_.begin(), relative_.end());
    const auto quantile = [&](double q) {
      return relative_[static_cast<std::size_t>(std::lround(q * static_cast<double>(relative_.size() - 1)))];
    };
    found.median = quantile(0.5);
    found.p95 = quantile(0.95);
    found.worst = relative_.back();
    const auto near = std::upper_bound(relative_.begin(), relative_.end(), 0.05) - relative_.begin();
    found.within_5_percent = static_cast<double>(near) / static_cast<double>(relative_.size());
    double sum = 0.0, count = 0.0;
    for (const auto& [branch, change] : changes_) {
      if (change.largest <= 0.0) continue;
      sum += change.errors / change.largest;
      count += static_cast<double>(change.count);
    }
    found.of_change = count > 0.0 ? sum / count : 0.0;
    return found;
  }

 private:
  struct Change {
    double largest = 0.0, errors = 0.0;
    std::size_t count = 0;
  };
  std::vector<double> relative_;
  std::map<std::string, Change> changes_;
};

}  // namespace

std::vector<BranchRun> branch_runs(const BeatingHeart& heart, const geometry::CageGrid& grid,
                                   const std::vector<std::vector<Vec3>>& control_points,
                                   const core::TaskContext& task) {
  const analysis::TreeMotion truth = known_motion(heart, task.sub(0.0, 0.5));
  const analysis::TreeMotion fitted = fitted_motion(heart, grid, control_points, task.sub(0.5, 1.0));
  const int depth = static_cast<int>(std::lround(std::log2(grid.cells)));
  std::vector<BranchRun> runs;
  for (const analysis::BranchMotion& known : truth.branches) {
    const auto same = std::find_if(fitted.branches.begin(), fitted.branches.end(),
                                   [&](const auto& branch) { return branch.name == known.name; });
    if (same == fitted.branches.end()) continue;
    for (std::size_t k = 0; k < heart.phases.size(); ++k) {
      const auto value = [&](const analysis::BranchMotion& of, MotionMeasure measure) {
        const std::vector<double>& values = of[measure].values;
        return k < values.size() ? values[k] : analysis::not_measured;
      };
      BranchRun run;
      run.heart = heart.name;
      run.phase = heart.phases[k].phase;
      run.depth = depth;
      run.branch = known.name;
      run.length_mm = known.length_mm;
      run.stretch = value(*same, MotionMeasure::stretch);
      run.true_stretch = value(known, MotionMeasure::stretch);
      run.torsion = value(*same, MotionMeasure::torsion_mean);
      run.true_torsion = value(known, MotionMeasure::torsion_mean);
      run.template_torsion = known[MotionMeasure::torsion_mean].at_template;
      run.size = value(*same, MotionMeasure::torsion_size);
      run.true_size = value(known, MotionMeasure::torsion_size);
      run.template_size = known[MotionMeasure::torsion_size].at_template;
      run.curvature = value(*same, MotionMeasure::curvature_mean);
      run.true_curvature = value(known, MotionMeasure::curvature_mean);
      run.template_curvature = known[MotionMeasure::curvature_mean].at_template;
      runs.push_back(run);
    }
  }
  return runs;
}

BranchAgreements agreement(const std::vector<BranchRun>& branches) {
  Errors stretch, torsion, size, curvature;
  for (const BranchRun& run : branches) {
    const std::string branch = run.heart + " " + run.branch;
    stretch.add(branch, run.stretch, run.true_stretch, 1.0, 0.0);
    torsion.add(branch, run.torsion, run.true_torsion, run.template_torsion, least_torsion_per_mm);
    size.add(branch, run.size, run.true_size, run.template_size, least_torsion_per_mm);
    curvature.add(branch, run.curvature, run.true_curvature, run.template_curvature, 0.0);
  }
  return {stretch.result(), torsion.result(), size.result(), curvature.result()};
}

}  // namespace ostia::experiments
