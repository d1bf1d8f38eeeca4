#include "ostia/pipeline/motion_fit.h"

#include "motion/motion_phases.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/motion/cage_descent.h"
#include "ostia/motion/cyclic_spline.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace ostia::pipeline {
namespace {

using geometry::CagePhase;
using geometry::PhaseOrigin;
using geometry::TriMesh;
using geometry::Vec3;
using Points = std::vector<Vec3>;

// Of what the other phases reach: below and above it a registration has failed.
constexpr double least_share = 0.5;
constexpr double most_distance = 4.0;
constexpr double fine_distance_mm = 0.1;  // never worth a word
constexpr double failed_share = 0.01;     // of the template's size: a distance above it is a failure
constexpr double fine_jacobian = 1e-6;

double time_between(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, 1.0 - d);
}

/// The phase with a surface that is nearest to the one asked for.
std::size_t template_of(const std::vector<PhaseSurface>& phases, double wanted) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const double off = time_between(phases[i].phase, wanted);
    if (phases[i].surface.triangles.empty() || off >= least) continue;
    best = i;
    least = off;
  }
  return best;
}

struct Fitted {
  motion::RegistrationReport report;
  Points control_points;  ///< empty: not registered
  double stiffness = 1.0;
};

/// A phase that has gone wrong must not lead its neighbour astray.
bool can_lead(const motion::RegistrationReport& report, const motion::RegistrationReport& before) {
  return report.paired_share >= least_share * before.paired_share;
}

Fitted descended(const TriMesh& shape, const TriMesh& target, const motion::RegistrationOptions& options,
                 const core::TaskContext& task) {
  motion::DescentOptions how;
  how.depth = options.depth;
  how.margin = options.margin;
  how.max_angle_deg = options.max_angle_deg;
  how.energy = options.energy;
  motion::Registration one = motion::register_cage_by_descent(shape, target, how, task);
  return {one.report, std::move(one.control_points)};
}

/// One phase. Where it is stuck, a stiffer cage, which presses more cells less, goes on: from the neighbour's
/// cage and from rest.
Fitted registered(const TriMesh& shape, const TriMesh& target, const motion::RegistrationOptions& options,
                  const core::TaskContext& task) {
  const auto fitted = [&](double stiffness, bool from_rest) {
    motion::RegistrationOptions how = options;
    how.energy.length *= stiffness;
    how.energy.area *= stiffness;
    how.energy.volume *= stiffness;
    if (from_rest) how.start.clear();
    motion::Registration one = motion::register_cage(shape, target, how, task);
    return Fitted{one.report, std::move(one.control_points), stiffness};
  };
  Fitted best = fitted(1.0, false);
  for (const double stiffness : {10.0, 100.0}) {
    for (const bool from_rest : {false, true}) {
      if (!motion::is_stuck(best.report)) return best;
      if (from_rest && options.start.empty()) continue;
      Fitted other = fitted(stiffness, from_rest);
      const double least = least_share * best.report.paired_share;
      if (other.report.paired_share >= least && other.report.mean_distance_mm < best.report.mean_distance_mm)
        best = std::move(other);
    }
  }
  return best;
}

/// Each registration has its own part of the whole, in the order in which they begin.
class Progress {
 public:
  Progress(std::size_t count, const core::TaskContext& task)
      : count_(static_cast<double>(count)), task_(task) {}
  core::TaskContext next() {
    const auto begun = static_cast<double>(begun_++);
    return task_.sub(begun / count_, std::min((begun + 1.0) / count_, 1.0));
  }

 private:
  std::atomic<std::size_t> begun_{0};
  double count_;
  const core::TaskContext& task_;
};

void register_way(const std::vector<PhaseSurface>& phases, const TriMesh& shape, const Way& way,
                  const MotionFitOptions& options, std::vector<Fitted>& fitted, Progress& progress,
                  const core::TaskContext& task) {
  motion::RegistrationOptions how = options.registration;
  how.start.clear();
  motion::RegistrationReport before;
  before.paired_share = 1.0;
  for (const std::size_t i : way.phases) {
    task.throw_if_cancelled();
    const core::TaskContext own = progress.next();
    if (phases[i].surface.triangles.empty()) continue;
    task.set_stage("registering " + percent_text(phases[i].phase));
    if (!phases[i].start.empty()) how.start = phases[i].start;
    fitted[i] = options.method == MotionMethod::gradient_descent
                    ? descended(shape, phases[i].surface, how, own)
                    : registered(shape, phases[i].surface, how, own);
    if (!can_lead(fitted[i].report, before)) continue;
    before = fitted[i].report;
    how.start = fitted[i].control_points;
  }
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string rounded(double value) {
  return core::trimmed_text(std::round(value * 1e3) / 1e3, 6);
}

/// What phases of this motion are like.
struct Usual {
  double share = 0.0, distance_mm = 0.0;  ///< medians
  double size_mm = 0.0;                   ///< of the template
};

std::string distance_text(const motion::RegistrationReport& report, const Usual& usual) {
  return "it stays " + rounded(report.mean_distance_mm) + " mm off, other phases " +
         rounded(usual.distance_mm) + " mm";
}

/// Why a phase's registration cannot be used; empty where it can.
std::string failure(const motion::RegistrationReport& report, const Usual& usual) {
  if (report.least_jacobian <= 0.0) return "a cell of its cage would be inverted";
  if (report.paired_share < least_share * usual.share)
    return "only " + std::to_string(std::lround(100.0 * report.paired_share)) +
           " % of the template found its like, " + std::to_string(std::lround(100.0 * usual.share)) +
           " % do in other phases";
  if (report.mean_distance_mm > std::max(failed_share * usual.size_mm, most_distance * usual.distance_mm))
    return distance_text(report, usual);
  return {};
}

PhaseFit told(const PhaseSurface& phase, const Fitted& fitted, const Usual& usual) {
  PhaseFit one;
  one.phase = phase.phase;
  one.name = phase.name;
  one.report = fitted.report;
  one.stiffness = fitted.stiffness;
  one.why = !fitted.control_points.empty() ? failure(fitted.report, usual)
            : phase.why.empty()            ? "no vessel"
                                           : phase.why;
  if (!one.why.empty()) one.origin = PhaseOrigin::bridged;
  return one;
}

Usual usual_of(const TriMesh& shape, const std::vector<Fitted>& fitted) {
  std::vector<double> shares, distances;
  for (const Fitted& one : fitted) {
    if (one.control_points.empty()) continue;
    shares.push_back(one.report.paired_share);
    distances.push_back(one.report.mean_distance_mm);
  }
  return {median(shares), median(distances), geometry::bounds(shape.points).sizes().norm()};
}

void judge(const std::vector<PhaseSurface>& phases, std::size_t shape, const std::vector<Fitted>& fitted,
           MotionFit& fit) {
  const Usual usual = usual_of(phases[shape].surface, fitted);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    PhaseFit one = told(phases[i], fitted[i], usual);
    if (i == shape) {
      one.origin = PhaseOrigin::at_rest;
      one.why.clear();
      one.report.paired_share = one.report.least_jacobian = 1.0;
    }
    if (one.origin == PhaseOrigin::fitted &&
        one.report.mean_distance_mm > std::max(fine_distance_mm, most_distance * usual.distance_mm))
      fit.warnings.push_back("phase " + percent_text(one.phase) + ": " + distance_text(one.report, usual));
    fit.phases.push_back(std::move(one));
  }
}

void add_gaps(std::vector<PhaseFit>& phases) {
  std::vector<double> there;
  for (const PhaseFit& one : phases) there.push_back(one.phase);
  for (const double phase : missing_phases(there)) {
    PhaseFit gap;
    gap.phase = phase;
    gap.origin = PhaseOrigin::bridged;
    gap.gap = true;
    gap.why = "a gap: there is no such phase";
    phases.push_back(std::move(gap));
  }
  std::ranges::sort(phases, {}, &PhaseFit::phase);
}

double least_jacobian_with(const geometry::CageGrid& grid, const Points& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const geometry::CageCell corners = grid.corners(cell);
    std::array<Vec3, 8> places;
    for (std::size_t c = 0; c < 8; ++c) places[c] = points[static_cast<std::size_t>(corners[c])];
    least = std::min(least, geometry::jacobian_bounds(places, grid.cell_mm)[0]);
  }
  return least;
}

/// Phases that hold nothing of their own go on the spline through the others.
void bridge(MotionFit& fit, const std::vector<double>& known, const std::vector<Points>& places) {
  const motion::CyclicSpline spline(known, places);
  std::size_t next = 0;
  for (PhaseFit& one : fit.phases) {
    const bool own = one.origin != PhaseOrigin::bridged;
    CagePhase phase{one.phase, own ? places[next] : spline.at(one.phase), one.origin};
    if (own) {
      ++next;
    } else {
      one.report.least_jacobian = least_jacobian_with(fit.motion.grid, phase.control_points);
      fit.warnings.push_back("phase " + percent_text(one.phase) + ": " + one.why +
                             "; it is bridged from its neighbours in time");
      if (one.report.least_jacobian <= fine_jacobian)
        fit.warnings.push_back("phase " + percent_text(one.phase) +
                               ": cells of the cage are inverted where it is bridged");
    }
    fit.motion.phases.push_back(std::move(phase));
  }
}

void warn_of_holes(MotionFit& fit) {
  constexpr double wide = 0.25;  // of the cycle
  for (std::size_t k = 0; k < fit.phases.size(); ++k) {
    const double from = fit.phases[k].phase, to = fit.phases[(k + 1) % fit.phases.size()].phase;
    const double way = to > from ? to - from : to + 1.0 - from;
    if (way > wide)
      fit.warnings.push_back("there is nothing between the phases " + percent_text(from) + " and " +
                             percent_text(to) + ": what the heart does there is not known");
  }
}

void warn_of_intersections(MotionFit& fit) {
  for (const PhaseFit& one : fit.phases)
    if (one.report.self_intersections > one.report.source_self_intersections)
      fit.warnings.push_back("phase " + percent_text(one.phase) + ": " +
                             std::to_string(one.report.self_intersections) +
                             " pairs of triangles intersect, " +
                             std::to_string(one.report.source_self_intersections) + " of the template do");
}

}  // namespace

MotionFit fit_motion(std::vector<PhaseSurface> phases, const MotionFitOptions& options,
                     const core::TaskContext& task) {
  motion::validate(options.registration);
  require_phases(phases);
  std::ranges::sort(phases, {}, &PhaseSurface::phase);
  const std::size_t shape = template_of(phases, options.template_phase);
  require_like(phases, shape);
  std::vector<Fitted> fitted(phases.size());
  std::vector<double> times;
  for (const PhaseSurface& one : phases) times.push_back(one.phase);
  const std::array<Way, 2> both = ways(times, shape);
  Progress progress(phases.size() - 1, task);  // the template is there already
  core::parallel_for(2, 1, [&](std::size_t k) {
    register_way(phases, phases[shape].surface, both[k], options, fitted, progress, task);
  });
  MotionFit fit;
  fit.motion.grid = geometry::cage_around(phases[shape].surface.points, options.registration.depth,
                                          options.registration.margin);
  fit.motion.template_phase = phases[shape].phase;
  if (time_between(phases[shape].phase, options.template_phase) > 1e-9)
    fit.warnings.push_back("there is no phase " + percent_text(options.template_phase) + ": " +
                           percent_text(phases[shape].phase) + " is the template");
  judge(phases, shape, fitted, fit);
  fitted[shape].control_points = geometry::rest_points(fit.motion.grid);
  std::vector<double> known;
  std::vector<Points> places;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (fit.phases[i].origin == PhaseOrigin::bridged) continue;
    known.push_back(phases[i].phase);
    places.push_back(std::move(fitted[i].control_points));
  }
  require_enough(fit.phases, known.size());
  add_gaps(fit.phases);
  bridge(fit, known, places);
  warn_of_holes(fit);
  warn_of_intersections(fit);
  for (std::size_t k = 0; k < fit.phases.size(); ++k)
    if (fit.phases[k].origin == PhaseOrigin::at_rest) fit.template_index = k;
  fit.template_shape = std::move(phases[shape].surface);
  task.set_progress(1.0);
  return fit;
}

}  // namespace ostia::pipeline
