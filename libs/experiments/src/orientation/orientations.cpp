#include "ostia/experiments/orientations.h"

#include "orientation/orientation_lines.h"

#include "ostia/centerline/skeleton_radius.h"
#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

using centerline::MeasuredSkeleton;
using centerline::SkeletonEdge;

double distance_of(const PhantomTube& tube, const Mat3& turn, const Vec3& point) {
  const std::vector<Vec3> axis{turn * tube.from, turn * tube.to};
  return (geometry::closest(axis, point).point - point).norm();
}

/// The tube that most points of a line are nearest to; -1 where most lie outside of all.
int tube_of(const SkeletonEdge& line, const std::vector<PhantomTube>& tubes, const Mat3& turn) {
  std::vector<int> votes(tubes.size() + 1, 0);
  for (const Vec3& point : line.points) {
    std::size_t best = tubes.size();
    double least = 1e300;
    for (std::size_t t = 0; t < tubes.size(); ++t) {
      const double d = distance_of(tubes[t], turn, point);
      if (d < least && d <= tubes[t].radius_mm + 1.0) {
        least = d;
        best = t;
      }
    }
    ++votes[best];
  }
  const auto most = std::max_element(votes.begin(), votes.end());
  return most + 1 == votes.end() ? -1 : static_cast<int>(most - votes.begin());
}

/// Mean radius of a line, away from what other vessels and the ends do to it.
double mean_radius(const MeasuredSkeleton& skeleton, std::size_t line) {
  const SkeletonEdge& edge = skeleton.graph.edges[line];
  const std::vector<double> s = geometry::abscissas(edge.points);
  const double from = centerline::node(skeleton.graph, edge.from).radius_mm;
  const double to = centerline::node(skeleton.graph, edge.to).radius_mm;
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!skeleton.sections[line][i].measured || s[i] < from || s[i] > s.back() - to) continue;
    sum += edge.radius_mm[i];
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

struct Found {
  double weight = 0.0, radius = 0.0, grey_radius = 0.0;
};

OrientationRun measured_run(const std::vector<PhantomTube>& tubes, const Orientation& orientation,
                            const pipeline::SkeletonResult& lines, const MeasuredSkeleton& grey) {
  OrientationRun run;
  run.name = orientation.name;
  run.components = lines.components;
  run.loops = lines.loops;
  for (const PhantomTube& tube : tubes)
    run.tubes.push_back({tube.name, orientation.name, tube.length_mm(), tube.radius_mm});
  std::vector<Found> found(tubes.size());
  const auto& edges = lines.skeleton.graph.edges;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const int t = tube_of(edges[e], tubes, orientation.turn);
    if (t < 0) {
      ++run.other_lines;
      continue;
    }
    TubeMeasure& tube = run.tubes[static_cast<std::size_t>(t)];
    const double length = centerline::length_mm(edges[e]);
    ++tube.lines;
    tube.length_mm += length;
    const double radius = mean_radius(lines.skeleton, e), by_grey = mean_radius(grey, e);
    if (radius <= 0.0 || by_grey <= 0.0) continue;
    Found& f = found[static_cast<std::size_t>(t)];
    f.weight += length;
    f.radius += length * radius;
    f.grey_radius += length * by_grey;
  }
  for (std::size_t t = 0; t < tubes.size(); ++t) {
    if (found[t].weight <= 0.0) continue;
    run.tubes[t].radius_mm = found[t].radius / found[t].weight;
    run.tubes[t].grey_radius_mm = found[t].grey_radius / found[t].weight;
  }
  return run;
}

}  // namespace

void validate(const OrientationsOptions& o) {
  validate(o.scan);
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("orientations: ") + what);
  };
  require(o.vessel_sigma_hu > 0.0, "vessel_sigma_hu must be positive");
  require(o.tau > 0.0 && o.tau < 1.0, "tau must be in (0, 1)");
  require(o.iterations >= 0, "iterations must not be negative");
  require(o.diffusion_iterations >= 0 && o.diffusion_iterations <= 1000,
          "diffusion_iterations must be in [0, 1000]");
}

OrientationRun measure_orientation(const std::vector<PhantomTube>& tubes, const Orientation& orientation,
                                   const OrientationsOptions& options, const core::TaskContext& task) {
  validate(options);
  const ScannedLines found = scanned_lines(tubes, orientation, options, task.sub(0.0, 0.9));
  const MeasuredSkeleton grey =
      centerline::measured(found.lines.skeleton.graph, found.scanned, found.sections, task.sub(0.9, 1.0));
  OrientationRun run = measured_run(tubes, orientation, found.lines, grey);
  run.iterations = found.surface.iterations;
  return run;
}

std::vector<OrientationRun> measure_orientations(const std::vector<PhantomTube>& tubes,
                                                 const std::vector<Orientation>& orientations,
                                                 const OrientationsOptions& options,
                                                 const core::TaskContext& task) {
  std::vector<OrientationRun> runs;
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(1, orientations.size()));
  for (std::size_t i = 0; i < orientations.size(); ++i)
    runs.push_back(
        measure_orientation(tubes, orientations[i], options,
                            task.sub(share * static_cast<double>(i), share * static_cast<double>(i + 1))));
  return runs;
}

double value_of(const TubeMeasure& m, TubeQuantity quantity) {
  switch (quantity) {
    case TubeQuantity::length:
      return m.length_mm;
    case TubeQuantity::radius:
      return m.radius_mm;
    default:
      return m.grey_radius_mm;
  }
}

QuantityPairs against_mean(const std::vector<OrientationRun>& runs, TubeQuantity quantity) {
  QuantityPairs pairs;
  for (std::size_t t = 0; !runs.empty() && t < runs.front().tubes.size(); ++t) {
    double sum = 0.0;
    std::vector<double> values;
    for (const OrientationRun& run : runs) {
      if (run.tubes[t].lines == 0) continue;
      values.push_back(value_of(run.tubes[t], quantity));
      sum += values.back();
    }
    for (const double value : values) {
      pairs.reference.push_back(sum / static_cast<double>(values.size()));
      pairs.result.push_back(value);
    }
  }
  return pairs;
}

QuantityPairs against_truth(const std::vector<OrientationRun>& runs, TubeQuantity quantity) {
  QuantityPairs pairs;
  for (const OrientationRun& run : runs)
    for (const TubeMeasure& tube : run.tubes) {
      if (tube.lines == 0) continue;
      pairs.reference.push_back(quantity == TubeQuantity::length ? tube.true_length_mm : tube.true_radius_mm);
      pairs.result.push_back(value_of(tube, quantity));
    }
  return pairs;
}

OrientationsSummary summarize(const std::vector<OrientationRun>& runs, TubeQuantity quantity) {
  OrientationsSummary summary;
  for (const OrientationRun& run : runs)
    for (const TubeMeasure& tube : run.tubes) {
      summary.missing += tube.lines == 0 ? 1U : 0U;
      summary.split += tube.lines > 1 ? 1U : 0U;
    }
  const QuantityPairs mean = against_mean(runs, quantity);
  summary.pairs = mean.result.size();
  const std::size_t tubes = runs.empty() ? 0 : runs.front().tubes.size();
  if (summary.pairs <= tubes)
    throw InvalidInput("orientations: two orientations are needed in which tubes are found");
  double squares = 0.0;
  for (std::size_t i = 0; i < mean.result.size(); ++i) {
    const double off = std::abs(mean.result[i] - mean.reference[i]);
    squares += off * off;
    summary.farthest_mm = std::max(summary.farthest_mm, off);
  }
  summary.two_sd_mm = 2.0 * std::sqrt(squares / static_cast<double>(summary.pairs - tubes));
  for (std::size_t i = 0; i < mean.result.size(); ++i)
    summary.beyond += std::abs(mean.result[i] - mean.reference[i]) > summary.two_sd_mm ? 1U : 0U;
  const QuantityPairs truth = against_truth(runs, quantity);
  const evaluation::BlandAltman agreement = evaluation::bland_altman(truth.reference, truth.result);
  summary.bias_mm = agreement.bias;
  summary.two_sd_truth_mm = 2.0 * agreement.sd;
  return summary;
}

}  // namespace ostia::experiments
