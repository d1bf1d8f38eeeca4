#include "ostia/analysis/motion_measures.h"

#include "moving/motion_parts.h"
#include "moving/smooth_motion.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::analysis {
namespace {

void require(double value, double least, double most, const std::string& what) {
  if (!(value >= least && value <= most))
    throw InvalidInput(what + " is " + std::to_string(value) + "; it must be in [" + std::to_string(least) +
                       ", " + std::to_string(most) + "]");
}

/// Of all branches together, weighted by length.
void add(PhaseDistances& sum, const PhaseDistances& one, double share) {
  if (sum.empty()) sum.assign(one.size(), std::vector<double>(one.size(), 0.0));
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t j = 0; j < one.size(); ++j) sum[i][j] += share * one[i][j];
}

}  // namespace

const MeasureName& name_of(MotionMeasure measure) {
  static const std::array<MeasureName, branch_measure_count> names{
      {{"displacement_mean", "mm", "mean displacement"},
       {"displacement_max", "mm", "largest displacement"},
       {"speed_mean", "mm/s", "mean speed"},
       {"speed_max", "mm/s", "largest speed"},
       {"length", "mm", "length"},
       {"stretch", "", "stretch"},
       {"stretch_least", "", "least local stretch"},
       {"stretch_largest", "", "largest local stretch"},
       {"curvature_mean", "1/mm", "mean curvature"},
       {"curvature_max", "1/mm", "largest curvature"},
       {"curvature_change", "1/mm", "mean change of curvature"},
       {"torsion_mean", "1/mm", "mean torsion"},
       {"torsion_change", "1/mm", "mean change of torsion"},
       {"torsion_total", "deg", "total torsion"},
       {"torsion_size", "1/mm", "size of the torsion"},
       {"torsion_share", "", "share with torsion"},
       {"twist", "deg", "twist"}}};
  return names.at(static_cast<std::size_t>(measure));
}

const MeasureName& name_of(LocalMeasure measure) {
  static const std::array<MeasureName, local_measure_count> names{{{"displacement", "mm", "displacement"},
                                                                   {"speed", "mm/s", "speed"},
                                                                   {"stretch", "", "local stretch"},
                                                                   {"curvature", "1/mm", "curvature"},
                                                                   {"torsion", "1/mm", "torsion"},
                                                                   {"twist", "deg", "twist"}}};
  return names.at(static_cast<std::size_t>(measure));
}

void validate(const MotionMeasureOptions& options) {
  require(options.rr_s, 0.1, 10.0, "the duration of the cycle, s,");
  require(options.reach_mm, 0.5, 50.0, "half of the piece that a bend is taken from, mm,");
  require(options.least_curvature_per_mm, 1e-6, 1.0, "the least curvature for torsion, 1/mm,");
  require(options.arm_mm, 1.0, 50.0, "the length of a branch for angles, mm,");
  require(options.least_way_mm, 0.0, 1000.0, "the least way between two branches' places, mm,");
  require(options.rest_mm, 1e-6, 100.0, "the motion within a rest period, mm,");
}

TreeMotion measure_motion(const MovingTree& tree, const MotionMeasureOptions& options,
                          const core::TaskContext& task) {
  validate(options);
  validate(tree);
  TreeMotion motion;
  motion.options = options;
  motion.template_phase = tree.template_phase;
  motion.phases = tree.phases;
  motion.warnings = tree.warnings;
  double length = 0.0;
  for (const MovingBranch& branch : tree.branches) length += branch.s_mm.back();
  const std::vector<PhasePoints> common = smooth_motion(tree, task);
  PhaseDistances together;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    task.throw_if_cancelled();
    const MovingBranch& branch = tree.branches[b];
    motion.branches.push_back(branch_motion(branch, common[b], options, motion.warnings));
    const PhaseDistances distances = phase_distances(branch);
    motion.branches.back().rests = rest_periods(distances, tree.phases, options.rest_mm);
    add(together, distances, branch.s_mm.back() / length);
    task.set_progress(0.5 * static_cast<double>(b + 1) / static_cast<double>(tree.branches.size()));
  }
  motion.rests = rest_periods(together, tree.phases, options.rest_mm);
  motion.angles = joint_angles(tree, options, motion.warnings);
  motion.distances = branch_distances(tree, options, task.sub(0.5, 1.0));
  task.set_progress(1.0);
  return motion;
}

}  // namespace ostia::analysis
