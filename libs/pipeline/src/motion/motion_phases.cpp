#include "motion/motion_phases.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using geometry::Box3;
using geometry::Vec3;

// Across the whole surface, mm: from a short piece of a vessel to more than a chest.
constexpr double smallest_mm = 2.0, largest_mm = 1000.0;
constexpr double most_ratio = 4.0;  // of two phases' sizes: no heart, another unit or another thing

std::string named(const PhaseSurface& phase) {
  return "phase " + percent_text(phase.phase) + (phase.name.empty() ? "" : " (" + phase.name + ")");
}

Box3 box_of(const PhaseSurface& phase) {
  Box3 box;
  for (const Vec3& p : phase.surface.points) {
    if (!p.allFinite()) throw InvalidInput(named(phase) + " has a point that is not a number");
    box.extend(p);
  }
  return box;
}

std::string mm(double value) {
  const double steps = value < 10.0 ? 100.0 : 1.0;
  return core::trimmed_text(std::round(value * steps) / steps, 6) + " mm";
}

/// How far ahead of another phase one is, in [0, 1).
double time_ahead(double one, double other) {
  const double d = one - other;
  return d - std::floor(d);
}

}  // namespace

// One measure decides: the times ahead and behind, both rounded, may both be half a cycle.
std::array<Way, 2> ways(const std::vector<double>& phases, std::size_t from) {
  std::array<Way, 2> out;
  const std::size_t n = phases.size();
  for (std::size_t k = 1; k < n; ++k) {
    const std::size_t later = (from + k) % n, earlier = (from + n - k) % n;
    if (time_ahead(phases[later], phases[from]) <= 0.5) out[0].phases.push_back(later);
    if (time_ahead(phases[earlier], phases[from]) > 0.5) out[1].phases.push_back(earlier);
  }
  return out;
}

bool is_sound(const MotionFit& fit) {
  return std::ranges::all_of(fit.phases, [](const PhaseFit& one) {
    const bool bridged = one.origin == geometry::PhaseOrigin::bridged;
    const bool crossed = one.origin == geometry::PhaseOrigin::fitted &&
                         one.report.self_intersections > one.report.source_self_intersections;
    return !crossed && (!bridged || one.gap) && one.report.least_jacobian > 0.0;
  });
}

bool is_same_phase(double a, double b) {
  constexpr double moment = 0.002;
  const double off = std::abs(a - b);
  return std::min(off, 1.0 - off) < moment;
}

void require_phases(const std::vector<PhaseSurface>& phases) {
  std::size_t with_surface = 0;
  for (const PhaseSurface& one : phases) {
    if (!(one.phase >= 0.0 && one.phase < 1.0))
      throw InvalidInput(named(one) + ": phases are from 0 to below 100 % of the cycle");
    for (const PhaseSurface& other : phases)
      if (&other < &one && is_same_phase(other.phase, one.phase))
        throw InvalidInput(named(other) + " and " + named(one) +
                           " are the same phase; leave one of the two out");
    if (one.surface.triangles.empty()) continue;
    ++with_surface;
    const double size = box_of(one).sizes().norm();
    if (size < smallest_mm || size > largest_mm)
      throw InvalidInput(named(one) + " is " + mm(size) +
                         " across: its unit is hardly the millimetre; say which it is with --units m, cm or "
                         "mm");
  }
  if (with_surface >= least_phases) return;
  std::string reasons;
  for (const PhaseSurface& one : phases)
    if (!one.why.empty()) reasons += "; " + percent_text(one.phase) + ": " + one.why;
  throw InvalidInput("a motion needs three phases with a surface at least; there " +
                     std::string(with_surface == 1 ? "is " : "are ") + std::to_string(with_surface) + " (" +
                     std::to_string(phases.size()) + " in all)" + reasons);
}

void require_like(const std::vector<PhaseSurface>& phases, std::size_t template_index) {
  const Box3 own = box_of(phases[template_index]);
  const double size = own.sizes().norm();
  for (const PhaseSurface& one : phases) {
    if (one.surface.triangles.empty()) continue;
    const Box3 box = box_of(one);
    const double ratio = box.sizes().norm() / size;
    if (ratio > most_ratio || ratio < 1.0 / most_ratio)
      throw InvalidInput(named(one) + " is " + mm(box.sizes().norm()) + " across, the template, " +
                         named(phases[template_index]) + ", " + mm(size) +
                         ": they are in different units, or do not show the same");
    const double off = (box.center() - own.center()).norm();
    if (off > size)
      throw InvalidInput(named(one) + " lies " + mm(off) + " off the template, " +
                         named(phases[template_index]) + ", which is " + mm(size) +
                         " across: it is of another patient or in another frame; leave it out, or bring "
                         "both into one frame");
  }
}

void require_enough(const std::vector<PhaseFit>& phases, std::size_t usable) {
  if (usable >= least_phases) return;
  std::string why;
  for (const PhaseFit& one : phases)
    if (!one.why.empty()) why += "; " + percent_text(one.phase) + ": " + one.why;
  throw InvalidInput("a motion needs three phases that can be registered at least; there are " +
                     std::to_string(usable) + why);
}

std::vector<double> missing_phases(const std::vector<double>& phases) {
  constexpr double tolerance = 0.002;  // of the cycle
  constexpr double least_there = 2.0 / 3.0;
  constexpr double rounding = 1e-9;  // of the cycle
  if (phases.size() < least_phases) return {};
  double step = 1.0;
  for (std::size_t k = 0; k < phases.size(); ++k) {
    const bool last = k + 1 == phases.size();
    step = std::min(step, (last ? phases[0] + 1.0 : phases[k + 1]) - phases[k]);
  }
  const double count = std::round(1.0 / step);
  step = 1.0 / count;
  if (static_cast<double>(phases.size()) < least_there * count) return {};
  std::vector<double> missing;
  std::size_t next = 0;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    const double phase = phases[0] + k * step;
    if (next < phases.size() && std::abs(phases[next] - phase) < tolerance) {
      ++next;
    } else {
      const double within = phase - std::floor(phase);
      missing.push_back(within > 1.0 - rounding ? 0.0 : within);
    }
  }
  if (next != phases.size()) return {};
  std::ranges::sort(missing);
  return missing;
}

}  // namespace ostia::pipeline
