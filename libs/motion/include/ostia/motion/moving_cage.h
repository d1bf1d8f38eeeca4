#pragma once
/// \file A cage at any time of the cycle, and what it carries. See docs/methods/motion.md.

#include "ostia/geometry/cage_motion.h"
#include "ostia/motion/cyclic_spline.h"

#include <string>
#include <vector>

namespace ostia::motion {

/// The control points between the phases: periodic cubic splines ([Yi] 4), prepared once.
class MovingCage {
 public:
  /// Throws InvalidInput (geometry::validate; fewer than three phases).
  explicit MovingCage(const geometry::CageMotion& motion);
  const geometry::CageGrid& grid() const { return grid_; }
  double template_phase() const { return template_phase_; }
  /// Control points at any phase, mm; 1.25 is 0.25.
  std::vector<geometry::Vec3> at(double phase) const { return spline_.at(phase); }
  /// Their derivatives by the phase: mm a cycle.
  std::vector<geometry::Vec3> rate(double phase) const { return spline_.rate(phase); }

 private:
  geometry::CageGrid grid_;
  double template_phase_;
  CyclicSpline spline_;
};

/// Points given where the cage is at rest: weights prepared once. What is outside of the cage goes as its
/// nearest place in the cage does.
class CarriedPoints {
 public:
  /// Throws InvalidInput with the number, from 0 on, of a point that is not finite.
  CarriedPoints(const geometry::CageGrid& grid, const std::vector<geometry::Vec3>& points);
  std::size_t size() const { return points_.size(); }
  const std::vector<geometry::CagePoint>& weights() const { return points_; }
  std::size_t outside() const { return outside_; }
  double farthest_outside_mm() const;  ///< from the cage; 0 where none is outside
  /// Their places for these control points, mm.
  std::vector<geometry::Vec3> places(const std::vector<geometry::Vec3>& control_points) const;
  /// Their velocities for those of the control points (MovingCage::rate), in the same unit.
  std::vector<geometry::Vec3> rates(const std::vector<geometry::Vec3>& control_rates) const;

 private:
  geometry::CageGrid grid_;
  std::vector<geometry::CagePoint> points_;
  std::vector<geometry::Vec3> beyond_;  ///< from the nearest place in the cage
  std::size_t outside_ = 0;
};

/// Empty where all points lie in the cage, else a warning with the share that does not and how far off it is.
/// `what` are the points ("the axes"). Throws InvalidInput where more than half of them are outside.
std::string judge_outside(const CarriedPoints& points, const std::string& what);

}  // namespace ostia::motion
