#include "ostia/evaluation/motion_error.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::evaluation {
namespace {

constexpr double same_phase_percent = 1e-6;

void check(const PointMotion& motion, const char* what) {
  if (motion.phases.empty() || motion.percent.size() != motion.phases.size())
    throw InvalidInput(std::string(what) + " has no phases, or other numbers of phases and percentages");
  for (std::size_t k = 0; k < motion.phases.size(); ++k) {
    if (motion.phases[k].empty() || motion.phases[k].size() != motion.phases[0].size())
      throw InvalidInput(std::string(what) + ": phase " + std::to_string(k) + " has " +
                         std::to_string(motion.phases[k].size()) + " points, the first has " +
                         std::to_string(motion.phases[0].size()));
    for (const geometry::Vec3& p : motion.phases[k])
      if (!p.allFinite())
        throw InvalidInput(std::string(what) + ": a point of phase " + std::to_string(k) + " is not finite");
  }
}

}  // namespace

MotionError compare_motion(const PointMotion& reference, const PointMotion& result) {
  check(reference, "the reference motion");
  check(result, "the motion");
  if (reference.phases.size() != result.phases.size() ||
      reference.phases[0].size() != result.phases[0].size())
    throw InvalidInput("the motions differ in phases or points: " + std::to_string(reference.phases.size()) +
                       " x " + std::to_string(reference.phases[0].size()) + " and " +
                       std::to_string(result.phases.size()) + " x " +
                       std::to_string(result.phases[0].size()));
  MotionError out;
  const auto points = static_cast<double>(reference.phases[0].size());
  double squares = 0.0;
  for (std::size_t k = 0; k < reference.phases.size(); ++k) {
    if (std::abs(reference.percent[k] - result.percent[k]) > same_phase_percent)
      throw InvalidInput("phase " + std::to_string(k) + " is at " + std::to_string(reference.percent[k]) +
                         " % in the reference and at " + std::to_string(result.percent[k]) +
                         " % in the result");
    PhaseError phase{reference.percent[k], 0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < reference.phases[k].size(); ++i) {
      const double d = (result.phases[k][i] - reference.phases[k][i]).norm();
      phase.mean_mm += d / points;
      phase.rms_mm += d * d / points;
      phase.max_mm = std::max(phase.max_mm, d);
      out.amplitude_mm = std::max(out.amplitude_mm, (reference.phases[k][i] - reference.phases[0][i]).norm());
    }
    squares += phase.rms_mm;
    phase.rms_mm = std::sqrt(phase.rms_mm);
    out.mean_mm += phase.mean_mm;
    out.max_mm = std::max(out.max_mm, phase.max_mm);
    out.phases.push_back(phase);
  }
  const auto phases = static_cast<double>(reference.phases.size());
  out.mean_mm /= phases;
  out.rms_mm = std::sqrt(squares / phases);
  out.relative =
      out.amplitude_mm > 0.0 ? out.rms_mm / out.amplitude_mm : std::numeric_limits<double>::quiet_NaN();
  return out;
}

}  // namespace ostia::evaluation
