#include "ostia/centerline/extract_centerlines.h"

#include "ostia/centerline/axis_fit.h"
#include "ostia/centerline/eikonal.h"
#include "ostia/centerline/end_points.h"
#include "ostia/centerline/lumen_surface.h"
#include "ostia/centerline/tree_builder.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/parallel_invoke.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace ostia::centerline {
namespace {

// From the source's to the target's end; at openings the line reaches the barycentre.
Axis with_ends(DiagramPath path, const EndPoint& source, const EndPoint& target) {
  std::reverse(path.points.begin(), path.points.end());
  std::reverse(path.radius.begin(), path.radius.end());
  std::size_t first = 0, last = path.points.size();
  const auto near = [&](std::size_t i, const EndPoint& end) {
    return end.at_opening && (path.points[i] - end.position).norm() < 0.25 * path.radius[i];
  };
  while (first + 1 < last && near(first, source)) ++first;
  while (last > first + 1 && near(last - 1, target)) --last;
  Axis axis;
  if (source.at_opening) {
    axis.points.push_back(source.position);
    axis.radius.push_back(path.radius[first]);
  }
  axis.points.insert(axis.points.end(), path.points.begin() + static_cast<std::ptrdiff_t>(first),
                     path.points.begin() + static_cast<std::ptrdiff_t>(last));
  axis.radius.insert(axis.radius.end(), path.radius.begin() + static_cast<std::ptrdiff_t>(first),
                     path.radius.begin() + static_cast<std::ptrdiff_t>(last));
  if (target.at_opening) {
    axis.points.push_back(target.position);
    axis.radius.push_back(path.radius[last - 1]);
  }
  return axis;
}

struct Paths {
  std::vector<Axis> axes;          // one a target
  std::vector<std::size_t> order;  // farthest first
};

double working_step(const std::vector<Axis>& axes, double step_mm) {
  double longest = 0.0;
  std::vector<double> radii;
  for (const Axis& axis : axes) {
    longest = std::max(longest, geometry::length(axis.points));
    radii.insert(radii.end(), axis.radius.begin(), axis.radius.end());
  }
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return std::max(std::min(step_mm, 0.1 * *middle), longest / 50000.0);
}

Paths trace(const InnerVoronoi& diagram, const EndPoints& ends, const ArrivalTimes& arrival, double step_mm) {
  Paths paths;
  for (std::size_t i = 0; i < ends.targets.size(); ++i) {
    const EndPoint& target = ends.targets[i];
    if (!std::isfinite(arrival.time[static_cast<std::size_t>(target.diagram_point)]))
      throw GeometryError(describe_point("target " + std::to_string(i), target.position) +
                          " cannot be reached from the source" + describe_point("", ends.source.position) +
                          ": they lie in parts of the lumen that are not connected");
    paths.axes.push_back(with_ends(descend(diagram, arrival, target.diagram_point), ends.source, target));
  }
  const double step = working_step(paths.axes, step_mm);
  for (Axis& axis : paths.axes) axis = at_equal_steps(axis, step);
  paths.order.resize(paths.axes.size());
  std::iota(paths.order.begin(), paths.order.end(), std::size_t{0});
  std::stable_sort(paths.order.begin(), paths.order.end(), [&](std::size_t a, std::size_t b) {
    const auto time = [&](std::size_t i) {
      return arrival.time[static_cast<std::size_t>(ends.targets[i].diagram_point)];
    };
    return time(a) > time(b);
  });
  return paths;
}

// The points of a parent within about two radii before a branch leaves it.
std::vector<Vec3> lead_in(const Axis& parent, std::size_t at) {
  std::size_t first = at;
  double length = 0.0;
  while (first > 0 && length < 2.0 * parent.radius[at]) {
    length += (parent.points[first] - parent.points[first - 1]).norm();
    --first;
  }
  return {parent.points.begin() + static_cast<std::ptrdiff_t>(first),
          parent.points.begin() + static_cast<std::ptrdiff_t>(at) + 1};
}

// Smooths and centres the chains, parents first, so that each begins on its parent's final line.
void fit_chains(ChainTree& tree, const Wall& wall, const CenterlineOptions& options,
                const core::TaskContext& task) {
  for (std::size_t c = 0; c < tree.chains.size(); ++c) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(c) / static_cast<double>(tree.chains.size()));
    Chain& chain = tree.chains[c];
    if (chain.parent >= 0)
      chain.axis.points.front() = tree.chains[static_cast<std::size_t>(chain.parent)].axis.points[chain.at];
    const std::vector<double> bound = wall.spacing_along(chain.axis);
    chain.axis = smoothed_axis(chain.axis, options.smoothing_radii, bound);
    if (options.recentre)
      chain.axis = recentred_axis(chain.axis, wall, bound, 0.5 * options.smoothing_radii, task);
    if (chain.parent >= 0)
      chain.axis = led_out_of(lead_in(tree.chains[static_cast<std::size_t>(chain.parent)].axis, chain.at),
                              chain.axis, options.smoothing_radii);
  }
}

void measure_radii(VesselTree& tree, const Wall& wall, const core::TaskContext& task) {
  for (geometry::TreeSegment& segment : tree.segments) {
    task.throw_if_cancelled();
    core::parallel_for(segment.axis.size(), 64, [&](std::size_t i) {
      segment.axis.radius[i] = wall.inscribed_radius(segment.axis.points[i]);
    });
  }
}

VoronoiDisplay display_of(InnerVoronoi diagram, ArrivalTimes arrival) {
  return {std::move(diagram.points), std::move(diagram.radius), std::move(arrival.time),
          std::move(diagram.polygon_first), std::move(diagram.corners)};
}

}  // namespace

void validate(const CenterlineOptions& options) {
  const auto fail = [](const std::string& name, double value, const std::string& rule) {
    throw InvalidInput("centerline option " + name + " must be " + rule + ", not " + std::to_string(value));
  };
  if (!(options.step_mm > 0.0) || !std::isfinite(options.step_mm))
    fail("step_mm", options.step_mm, "positive (mm)");
  if (!(options.smoothing_radii >= 0.0) || !std::isfinite(options.smoothing_radii))
    fail("smoothing_radii", options.smoothing_radii, "zero or more (radii)");
  if (!(options.merge_fraction > 0.0 && options.merge_fraction < 1.0))
    fail("merge_fraction", options.merge_fraction, "between 0 and 1");
}

CenterlineResult extract_centerlines(const TriMesh& lumen, std::optional<Vec3> source,
                                     const std::vector<Vec3>& targets, const CenterlineOptions& options,
                                     const core::TaskContext& task, const KnownSurface* known) {
  validate(options);
  task.set_stage("surface");
  if (known != nullptr && !is_of(*known, lumen)) known = nullptr;
  const LumenSurface surface = prepare_lumen(lumen, known);
  task.throw_if_cancelled();
  task.set_stage("Voronoi diagram");
  InnerVoronoi diagram =
      inner_voronoi(surface.sampled, surface.on_border, surface.only_in_caps, task.sub(0.05, 0.6), known);
  const EndPoints ends = choose_ends(diagram, surface.openings, source, targets);
  if (!options.vessel_names.empty() && options.vessel_names.size() != ends.targets.size())
    throw InvalidInput(std::to_string(options.vessel_names.size()) + " vessel names for " +
                       std::to_string(ends.targets.size()) + " targets: give one a target, or none");

  task.throw_if_cancelled();
  task.set_stage("arrival times");
  std::vector<std::int32_t> target_points;
  for (const EndPoint& target : ends.targets) target_points.push_back(target.diagram_point);
  if (options.keep_voronoi) target_points.clear();
  ArrivalTimes arrival;
  Paths paths;
  std::optional<Wall> wall;
  // The march has one thread alone: what comes after it is made ready beside it.
  core::parallel_invoke(
      [&] {
        arrival = arrival_times(diagram, ends.source.diagram_point, target_points, task.sub(0.6, 0.8));
        paths = trace(diagram, ends, arrival, options.step_mm);
      },
      [&] {
        const bool without_caps = known != nullptr && known->loops.empty();
        wall.emplace(surface.wall, without_caps ? known->tree : nullptr);
      });

  task.set_stage("axes");
  ChainTree chains = merge_paths(paths.axes, paths.order, options.merge_fraction);
  task.throw_if_cancelled();
  fit_chains(chains, *wall, options, task.sub(0.8, 0.95));

  CenterlineResult result;
  SplitTree split = split_tree(chains, options.step_mm, options.vessel_names);
  result.tree = std::move(split.tree);
  measure_radii(result.tree, *wall, task);
  for (std::size_t i = 0; i < ends.targets.size(); ++i) {
    const std::string role = "target " + std::to_string(i);
    if (split.target_segments[i].empty())
      throw GeometryError(describe_point(role, ends.targets[i].position) +
                          " lies at the source: give points farther apart");
    result.lines.push_back(geometry::vessel_axis(result.tree, {0, role, split.target_segments[i]}));
    result.ends.push_back(result.lines.back().points.back());
    result.end_radii.push_back(result.lines.back().radius.back());
  }
  result.source = result.lines.front().points.front();
  result.source_radius = result.lines.front().radius.front();
  std::vector<std::string> warnings = surface.warnings;
  warnings.insert(warnings.end(), ends.warnings.begin(), ends.warnings.end());
  for (const std::size_t i : split.passed_targets)
    warnings.push_back(describe_point("target " + std::to_string(i), ends.targets[i].position) +
                       " lies on the way to another one: it has a line, but ends no vessel of the tree");
  result.diagnostics = {surface.wall.points.size(), surface.welded_points, diagram.dropped_points,
                        diagram.delaunay_cells,     diagram.points.size(), diagram.doubtful_cells,
                        diagram.polygon_count(),    std::move(warnings)};
  if (options.keep_voronoi) result.voronoi = display_of(std::move(diagram), std::move(arrival));
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::centerline
