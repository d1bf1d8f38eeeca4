#pragma once
/// \file How a coronary tree moves over the beat: displacement, speed, stretch, curvature, torsion and twist
/// of its branches, their distances, the angles between them, and when they rest. See
/// docs/methods/motion-measures.md.

#include "ostia/analysis/moving_tree.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace ostia::analysis {

struct MotionMeasureOptions {
  double rr_s = 0.8;                     ///< duration of the cycle, [0.1, 10]
  double reach_mm = 4.0;                 ///< half of the piece of axis that a bend is taken from, [0.5, 50]
  double least_curvature_per_mm = 0.01;  ///< torsion is measured where the axis bends as much, (0, 1]
  double arm_mm = 5.0;                   ///< of a branch, for angles, [1, 50]
  double least_way_mm = 10.0;  ///< along the tree, between places whose distance is measured, [0, 1000]
  double rest_mm = 1.0;        ///< motion within a rest period, (0, 100]
};
void validate(const MotionMeasureOptions& options);  ///< throws InvalidInput

/// What is measured of a branch, one value a phase. Means are over its length at the template.
enum class MotionMeasure {
  displacement_mean,  ///< mm, from the template's place
  displacement_max,
  speed_mean,  ///< mm/s
  speed_max,
  length,            ///< mm
  stretch,           ///< length over that at the template
  stretch_least,     ///< of the local ones
  stretch_largest,   ///< of the local ones
  curvature_mean,    ///< 1/mm
  curvature_max,     ///< 1/mm
  curvature_change,  ///< 1/mm: mean of the local absolute changes
  torsion_mean,      ///< 1/mm, of Frenet and Serret, positive for a right-handed screw
  torsion_change,    ///< 1/mm: mean of the local absolute changes
  torsion_total,     ///< degrees that the osculating plane turns over the branch
  torsion_size,   ///< 1/mm: mean of the torsion without its sign, weighted by the curvature squared, of the
                  ///< axis moved by what all branches' motion has in common over 80 mm: what a fitted
                  ///< motion tells
  torsion_share,  ///< of the branch on which it bends enough for torsion
  twist,          ///< degrees that the distal end has turned about the axis against the proximal one
};
inline constexpr std::size_t branch_measure_count = 17;

/// What is measured along a branch, one value a phase and point.
enum class LocalMeasure { displacement, speed, stretch, curvature, torsion, twist };
inline constexpr std::size_t local_measure_count = 6;

/// How a measure is written.
struct MeasureName {
  std::string name;  ///< "torsion_mean"
  std::string unit;  ///< "1/mm"; empty for ratios
  std::string text;  ///< "mean torsion"
};
const MeasureName& name_of(MotionMeasure measure);
const MeasureName& name_of(LocalMeasure measure);

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// A value at the template, and at each phase; NaN where it cannot be measured.
struct TimeCurve {
  double at_template = not_measured;
  std::vector<double> values;
};
/// A value at each point at the template, and at each phase; empty where the branch is too short.
struct AlongCurve {
  std::vector<double> at_template;
  std::vector<std::vector<double>> values;  ///< [phase][point]
};

/// A stretch of the cycle within which all points together (their mean) are never farther than
/// MotionMeasureOptions::rest_mm from where they were at any other time of it.
struct RestPeriod {
  double from = 0.0, to = 0.0;  ///< shares of the cycle, from in [0, 1), to > from, may be above 1
  double motion_mm = 0.0;       ///< largest mean distance within it
};

struct BranchMotion {
  std::int32_t vessel = 0;
  std::string name;
  double length_mm = 0.0;    ///< at the template
  std::vector<double> s_mm;  ///< of its points, at the template
  std::array<TimeCurve, branch_measure_count> over_time;
  std::array<AlongCurve, local_measure_count> along;
  std::vector<RestPeriod> rests;  ///< the longest first

  const TimeCurve& operator[](MotionMeasure m) const { return over_time[static_cast<std::size_t>(m)]; }
  const AlongCurve& operator[](LocalMeasure m) const { return along[static_cast<std::size_t>(m)]; }
};

/// The least distance of two branches' axes, between places that are at least
/// MotionMeasureOptions::least_way_mm apart along the tree.
struct BranchDistance {
  std::size_t first = 0, second = 0;  ///< branches
  TimeCurve distance;                 ///< mm
  TimeCurve s_first, s_second;        ///< where: template's abscissas, mm
};

/// The angle between two arms of a joint, degrees: 0 where they run together, 180 where one goes on from the
/// other.
struct JointAngle {
  std::int32_t node = 0;
  JointArm first, second;
  std::string name;  ///< "LAD proximal | D1"
  TimeCurve angle;
};

struct TreeMotion {
  MotionMeasureOptions options;
  double template_phase = 0.75;
  std::vector<double> phases;
  std::vector<BranchMotion> branches;
  std::vector<BranchDistance> distances;
  std::vector<JointAngle> angles;
  std::vector<RestPeriod> rests;  ///< of the whole tree, the longest first
  std::vector<std::string> warnings;
};

/// Measures everything. Where a branch is too short for a bend (`reach_mm`) or for torsion (twice that), or
/// an arm for an angle, values are NaN or lists empty, and a warning says so. Throws InvalidInput (validate),
/// Cancelled.
TreeMotion measure_motion(const MovingTree& tree, const MotionMeasureOptions& options = {},
                          const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
