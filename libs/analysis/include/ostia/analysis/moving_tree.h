#pragma once
/// \file A tree's axes over the cycle of the heart: what motion is measured on. See
/// docs/methods/motion-measures.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/motion/moving_cage.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::analysis {

using geometry::Vec3;

/// The points of all phases: [phase][point].
using PhasePoints = std::vector<std::vector<Vec3>>;

/// The part of a vessel that no vessel before it in the tree has, followed by points of its axis that keep
/// their place in the tissue.
struct MovingBranch {
  std::int32_t vessel = 0;              ///< its id; 0 where a segment belongs to no vessel
  std::string name;                     ///< of the vessel, made different from all others
  std::vector<double> s_mm, radius_mm;  ///< at the template: from 0 at the proximal end, rising
  std::vector<Vec3> rest;               ///< at the template, mm
  PhasePoints places;                   ///< mm
  PhasePoints rates;                    ///< velocities, mm a cycle
  PhasePoints shape;                    ///< what lengths, bends and angles are taken from; empty: `places`
  PhasePoints beside;  ///< carried from one radius along the frame's normal at rest, with `shape`; may be
                       ///< empty: no twist
};

/// A branch as it leaves a joint.
struct JointArm {
  std::size_t branch = 0;
  double s_mm = 0.0;   ///< where the joint is on it
  bool distal = true;  ///< the way that it goes from there
};

/// A node of the tree with at least two arms; those that lead to the root first.
struct Joint {
  std::int32_t node = 0;
  double radius_mm = 0.0;  ///< the widest there, at the template
  std::vector<JointArm> arms;
};

/// Branches in the tree's order of vessels, then segments without one.
struct MovingTree {
  double template_phase = 0.75;
  std::vector<double> phases;  ///< shares of the cycle, rising, in [0, 1)
  std::vector<MovingBranch> branches;
  std::vector<Joint> joints;
  std::vector<std::string> warnings;
};

/// Throws InvalidInput that names what is missing: fewer than three phases, phases that do not rise from 0 to
/// below 1, a branch of fewer than two points, of another number of points at a phase, or not finite.
void validate(const MovingTree& tree);

/// `count` phases evenly spaced from 0 on. Throws InvalidInput for fewer than three, and for more than 1000.
std::vector<double> even_phases(int count);

/// From trees that are the same but for their places: the same segments and as many points on each at each
/// phase, which are the same places of the tissue. Velocities by periodic cubic splines. Throws InvalidInput
/// that names phase and segment; geometry::find_fault.
MovingTree followed_tree(const geometry::VesselTree& rest, double template_phase,
                         const std::vector<double>& phases,
                         const std::vector<geometry::VesselTree>& at_phases);

/// From a tree at the template's phase that goes with a cage. Axes are sampled at equal steps of at most
/// `step_mm`, at least 16 a branch. Places are trilinear, as a surface's are; `shape` and `beside` are read
/// off the same control points with the weights of uniform cubic B-splines, which have no kinks between
/// cells. A warning says how much lies outside of the cage; throws InvalidInput where that is more than half,
/// for a faulty tree, fewer than three phases, and a step not in [0.05, 5].
MovingTree carried_tree(const geometry::VesselTree& rest, const motion::MovingCage& cage,
                        const std::vector<double>& phases, double step_mm = 0.5,
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
