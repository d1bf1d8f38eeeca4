#include "ostia/evaluation/surface_motion.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/evaluation/volume_overlap.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <limits>

namespace ostia::evaluation {
namespace {

using geometry::TriMesh;

constexpr double no_distance = std::numeric_limits<double>::quiet_NaN();

void check(const SurfaceMotion& motion, const std::string& what) {
  if (motion.names.size() != motion.phases.size())
    throw InvalidInput(what + " has other numbers of names and phases");
  if (motion.phases.size() < 2)
    throw InvalidInput(what + " has " + std::to_string(motion.phases.size()) +
                       " phase(s): a motion needs two at least");
  for (std::size_t k = 0; k < motion.phases.size(); ++k) {
    if (motion.phases[k].triangles.empty())
      throw InvalidInput(what + ": phase " + motion.names[k] + " has no triangle");
    for (const geometry::Vec3& p : motion.phases[k].points)
      if (!p.allFinite())
        throw InvalidInput(what + ": phase " + motion.names[k] + " has a point that is not finite");
  }
}

bool same_triangles(const TriMesh& a, const TriMesh& b) {
  return a.points.size() == b.points.size() && a.triangles == b.triangles;
}

bool corresponds(const SurfaceMotion& motion, const TriMesh& first) {
  return std::all_of(motion.phases.begin(), motion.phases.end(),
                     [&](const TriMesh& mesh) { return same_triangles(mesh, first); });
}

double mean_step(const TriMesh& a, const TriMesh& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.points.size(); ++i) sum += (b.points[i] - a.points[i]).norm();
  return sum / static_cast<double>(a.points.size());
}

CycleFigures cycle_of(const SurfaceMotion& motion) {
  const TriMesh& first = motion.phases.front();
  if (!corresponds(motion, first)) return {no_distance, no_distance, no_distance};
  CycleFigures out;
  double largest = 0.0;
  for (std::size_t k = 0; k + 1 < motion.phases.size(); ++k) {
    const double step = mean_step(motion.phases[k], motion.phases[k + 1]);
    out.path_mm += step;
    largest = std::max(largest, step);
    for (std::size_t i = 0; i < first.points.size(); ++i)
      out.amplitude_mm =
          std::max(out.amplitude_mm, (motion.phases[k + 1].points[i] - first.points[i]).norm());
  }
  const double closing = mean_step(motion.phases.back(), first);
  out.path_mm += closing;
  out.closing_ratio = largest > 0.0 ? closing / largest : no_distance;
  return out;
}

bool closed(const TriMesh& mesh) {
  return geometry::find_faults(mesh, false).open_edges == 0;
}

SurfacePhaseError phase_error(const TriMesh& reference, const TriMesh& result, bool corresponding,
                              const SurfaceMotionOptions& options, const core::TaskContext& task) {
  SurfaceDistanceOptions how;
  how.sample_mm = options.sample_mm;
  const SurfaceDistances d = compare_surfaces(reference, result, how);
  SurfacePhaseError out{"", d.msd_mm, d.max_sd_mm, no_distance, no_distance, no_distance};
  task.throw_if_cancelled();
  if (closed(reference) && closed(result))
    out.dice = compare_enclosed(reference, result, options.resolution_mm, {}).dice;
  if (!corresponding) return out;
  out.displacement_mm = mean_step(reference, result);
  out.max_displacement_mm = 0.0;
  for (std::size_t i = 0; i < reference.points.size(); ++i)
    out.max_displacement_mm =
        std::max(out.max_displacement_mm, (result.points[i] - reference.points[i]).norm());
  return out;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The run of digits from `at`, without leading zeros; `at` is moved behind it.
std::string digits_from(const std::string& text, std::size_t& at) {
  std::string run;
  for (; at < text.size() && is_digit(text[at]); ++at)
    if (!run.empty() || text[at] != '0') run += text[at];
  return run;
}

}  // namespace

SurfaceMotionError compare_surface_motion(const SurfaceMotion& reference, const SurfaceMotion& result,
                                          const SurfaceMotionOptions& options,
                                          const core::TaskContext& task) {
  check(reference, "the reference motion");
  check(result, "the motion");
  for (const std::string& name : reference.names)
    if (std::find(result.names.begin(), result.names.end(), name) == result.names.end())
      throw InvalidInput("the motion lacks phase " + name + " of the reference");
  if (reference.names != result.names)
    throw InvalidInput("the motion has phases that the reference lacks, or in another order: " +
                       std::to_string(result.names.size()) + " against " +
                       std::to_string(reference.names.size()));
  SurfaceMotionError out;
  out.corresponding =
      corresponds(reference, reference.phases.front()) && corresponds(result, reference.phases.front());
  const auto count = static_cast<double>(reference.phases.size());
  for (std::size_t k = 0; k < reference.phases.size(); ++k) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(k) / count);
    out.phases.push_back(
        phase_error(reference.phases[k], result.phases[k], out.corresponding, options, task));
    SurfacePhaseError& phase = out.phases.back();
    phase.name = reference.names[k];
    out.msd_mm += phase.msd_mm / count;
    out.dice += phase.dice / count;  // NaN where one phase has none
    out.displacement_mm += phase.displacement_mm / count;
    out.max_sd_mm = std::max(out.max_sd_mm, phase.max_sd_mm);
  }
  out.reference = cycle_of(reference);
  out.result = cycle_of(result);
  out.path_difference_mm = out.result.path_mm - out.reference.path_mm;
  return out;
}

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string x = digits_from(a, i), y = digits_from(b, j);
      if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;  // "01" and "1"
}

}  // namespace ostia::evaluation
