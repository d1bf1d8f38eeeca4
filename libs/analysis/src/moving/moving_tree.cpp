#include "ostia/analysis/moving_tree.h"

#include "names/tree_paths.h"

#include "ostia/core/error.h"
#include "ostia/motion/cyclic_spline.h"

#include <cmath>
#include <limits>

namespace ostia::analysis {
namespace {

constexpr std::size_t least_phases = 3;
constexpr int most_phases = 1000;

void validate_phases(const std::vector<double>& phases) {
  if (phases.size() < least_phases)
    throw InvalidInput("a motion over the cycle needs at least three phases, there are " +
                       std::to_string(phases.size()));
  for (std::size_t k = 0; k < phases.size(); ++k)
    if (!(phases[k] >= 0.0 && phases[k] < 1.0) || (k > 0 && !(phases[k] > phases[k - 1])))
      throw InvalidInput("phase " + std::to_string(k) + " is " + std::to_string(phases[k]) +
                         "; phases are shares of the cycle that rise from 0 to below 1");
}

void validate_points(const MovingBranch& branch, const PhasePoints& points, std::size_t phases,
                     const std::string& what) {
  if (points.size() != phases)
    throw InvalidInput("branch " + branch.name + " has " + what + " at " + std::to_string(points.size()) +
                       " phases of " + std::to_string(phases));
  for (std::size_t k = 0; k < phases; ++k) {
    if (points[k].size() != branch.rest.size())
      throw InvalidInput("branch " + branch.name + " has " + std::to_string(branch.rest.size()) +
                         " points at the template and " + std::to_string(points[k].size()) + " " + what +
                         " at phase " + std::to_string(k));
    for (const Vec3& p : points[k])
      if (!p.allFinite())
        throw InvalidInput("branch " + branch.name + " has " + what + " at phase " + std::to_string(k) +
                           " that are not finite");
  }
}

void require_sound(const geometry::VesselTree& tree, const std::string& which) {
  if (const auto fault = geometry::find_fault(tree)) throw InvalidInput(which + ": " + *fault);
  if (tree.segments.empty()) throw InvalidInput(which + " has no axes");
}

/// The segment of the same id, with as many points.
const geometry::TreeSegment& same_segment(const geometry::TreeSegment& rest, const geometry::VesselTree& tree,
                                          std::size_t phase) {
  for (const geometry::TreeSegment& one : tree.segments) {
    if (one.id != rest.id) continue;
    if (one.axis.points.size() != rest.axis.points.size())
      throw InvalidInput("segment " + std::to_string(rest.id) + " has " +
                         std::to_string(rest.axis.points.size()) + " points at the template and " +
                         std::to_string(one.axis.points.size()) + " at phase " + std::to_string(phase) +
                         "; points must be followed through all phases");
    return one;
  }
  throw InvalidInput("the tree at phase " + std::to_string(phase) + " has no segment " +
                     std::to_string(rest.id) + ", which the template has");
}

}  // namespace

std::vector<double> even_phases(int count) {
  if (count < static_cast<int>(least_phases) || count > most_phases)
    throw InvalidInput("the cycle is measured at 3 to 1000 times, not at " + std::to_string(count));
  std::vector<double> phases;
  for (int k = 0; k < count; ++k) phases.push_back(static_cast<double>(k) / count);
  return phases;
}

void validate(const MovingTree& tree) {
  validate_phases(tree.phases);
  const std::size_t phases = tree.phases.size();
  if (tree.branches.empty()) throw InvalidInput("a moving tree without branches cannot be measured");
  for (const MovingBranch& branch : tree.branches) {
    const std::size_t points = branch.rest.size();
    if (points < 2 || branch.s_mm.size() != points || branch.radius_mm.size() != points)
      throw InvalidInput("branch " + branch.name + " has " + std::to_string(points) +
                         " points at the template; it needs two at least, each with abscissa and radius");
    for (std::size_t i = 1; i < points; ++i)
      if (!(branch.s_mm[i] > branch.s_mm[i - 1]) || !std::isfinite(branch.s_mm[i]))
        throw InvalidInput("branch " + branch.name + " has abscissas that do not rise at point " +
                           std::to_string(i));
    validate_points(branch, branch.places, phases, "places");
    validate_points(branch, branch.rates, phases, "velocities");
    if (!branch.shape.empty()) validate_points(branch, branch.shape, phases, "places of its shape");
    if (!branch.beside.empty()) validate_points(branch, branch.beside, phases, "places beside its axis");
  }
  for (const Joint& joint : tree.joints)
    for (const JointArm& arm : joint.arms)
      if (arm.branch >= tree.branches.size())
        throw InvalidInput("joint " + std::to_string(joint.node) + " names a branch that is not there");
}

MovingTree followed_tree(const geometry::VesselTree& rest, double template_phase,
                         const std::vector<double>& phases,
                         const std::vector<geometry::VesselTree>& at_phases) {
  validate_phases(phases);
  require_sound(rest, "the tree at the template");
  if (at_phases.size() != phases.size())
    throw InvalidInput(std::to_string(phases.size()) + " phases were given and trees at " +
                       std::to_string(at_phases.size()) + " of them");
  MovingTree tree{template_phase, phases, {}, {}, {}};
  const std::vector<BranchPath> paths = branch_paths(rest);
  std::vector<std::vector<double>> node_s(paths.size());
  for (std::size_t b = 0; b < paths.size(); ++b) {
    std::vector<std::size_t> nodes;
    const geometry::Centerline line = joined(paths[b], &nodes);
    for (const std::size_t i : nodes) node_s[b].push_back(line.abscissa[i]);
    MovingBranch branch{
        paths[b].vessel, paths[b].name, line.abscissa, line.radius, line.points, {}, {}, {}, {}};
    for (std::size_t k = 0; k < phases.size(); ++k) {
      BranchPath there = paths[b];
      for (auto& segment : there.segments) segment = &same_segment(*segment, at_phases[k], k);
      branch.places.push_back(joined(there).points);
    }
    const motion::CyclicSpline spline(phases, branch.places);
    for (const double phase : phases) branch.rates.push_back(spline.rate(phase));
    tree.branches.push_back(std::move(branch));
  }
  tree.joints = joints_of(paths, node_s, tree.branches);
  validate(tree);
  return tree;
}

}  // namespace ostia::analysis
