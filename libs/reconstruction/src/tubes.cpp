#include "tubes.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"

#include <algorithm>
#include <cmath>

namespace ostia::reconstruction {
namespace {

struct Line {
  std::vector<Vec3> points;
  std::vector<double> radius;
};

/// The branch's own points; between two edges the mean of their radii.
Line line_of(const geometry::VesselGraph& graph, const geometry::GraphBranch& branch) {
  const auto edge = [&](std::size_t i) { return graph.edges[static_cast<std::size_t>(branch.edges[i])]; };
  const auto point = [&](std::int32_t i) { return graph.points[static_cast<std::size_t>(i)]; };
  Line line{{point(edge(0).from)}, {edge(0).radius_from}};
  for (std::size_t i = 0; i < branch.edges.size(); ++i) {
    line.points.push_back(point(edge(i).to));
    const bool last = i + 1 == branch.edges.size();
    line.radius.push_back(last ? edge(i).radius_to : 0.5 * (edge(i).radius_to + edge(i + 1).radius_from));
  }
  return line;
}

/// A circle without a fork goes on beyond its joint, so that it is smooth there too.
std::size_t lengthen_circle(Line& line) {
  const std::size_t more = std::min<std::size_t>(4, line.points.size() - 2);
  const Line once = line;
  const std::size_t n = once.points.size();
  for (std::size_t i = 1; i <= more; ++i) {
    line.points.push_back(once.points[i]);
    line.radius.push_back(once.radius[i]);
    line.points.insert(line.points.begin(), once.points[n - 1 - i]);
    line.radius.insert(line.radius.begin(), once.radius[n - 1 - i]);
  }
  return more;
}

Tube tube_of(const Line& given, bool circle) {
  Line line = given;
  const std::size_t beyond = circle && line.points.size() > 3 ? lengthen_circle(line) : 0;
  const std::vector<double> chord = geometry::abscissas(line.points);
  const std::size_t last = line.points.size() - 1 - beyond;
  Tube tube;
  const auto add = [&](const Vec3& point, double radius) {
    tube.points.push_back(point);
    tube.radius.push_back(radius);
  };
  const bool straight = line.points.size() == 2;
  const geometry::ArcLengthSpline spline(line.points);
  // The spline's arc lengths at its points: between two of them the chord's share is near enough.
  std::vector<double> arc(line.points.size(), 0.0);
  const double stretch = chord.back() > 0.0 ? spline.length() / chord.back() : 1.0;
  for (std::size_t i = 0; i < arc.size(); ++i) arc[i] = chord[i] * stretch;
  for (std::size_t i = beyond; i < last; ++i) {
    tube.knots.push_back(tube.points.size());
    const double r = std::min(line.radius[i], line.radius[i + 1]);
    const int steps = std::clamp(static_cast<int>(std::ceil((chord[i + 1] - chord[i]) / (0.75 * r))), 1, 400);
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const Vec3 p = straight || (k == 0 && i == beyond)
                         ? Vec3((1.0 - t) * line.points[i] + t * line.points[i + 1])
                         : spline.point((1.0 - t) * arc[i] + t * arc[i + 1]);
      add(p, (1.0 - t) * line.radius[i] + t * line.radius[i + 1]);
    }
  }
  tube.knots.push_back(tube.points.size());
  add(line.points[last], line.radius[last]);
  if (tube.points.size() == 2) {  // a place to narrow
    tube.points.insert(tube.points.begin() + 1, 0.5 * (tube.points[0] + tube.points[1]));
    tube.radius.insert(tube.radius.begin() + 1, 0.5 * (tube.radius[0] + tube.radius[1]));
    tube.knots.back() = 2;
  }
  tube.factor.assign(tube.points.size(), 1.0);
  measure(tube);
  return tube;
}

/// At a point of the branch; between two edges the mean of theirs.
Stretch stretch_at(const EllipticSections& sections, const geometry::GraphBranch& branch, std::size_t knot,
                   const geometry::Frame& frame) {
  const auto of = [&](std::size_t edge, std::size_t end) {
    return stretch_of(sections.of_edge[static_cast<std::size_t>(branch.edges[edge])][end], frame);
  };
  if (knot == 0) return of(0, 0);
  if (knot == branch.edges.size()) return of(knot - 1, 1);
  return of(knot - 1, 1) * 0.5 + of(knot, 0) * 0.5;
}

/// From one of the graph's points to the next evenly, in frames that do not turn about the axis. A branch of
/// circles stays as it is.
void add_shapes(Tube& tube, const EllipticSections& sections, const geometry::GraphBranch& branch) {
  std::vector<Stretch> given;
  for (std::size_t k = 0; k < tube.knots.size(); ++k)
    given.push_back(stretch_at(sections, branch, k, tube.frames[tube.knots[k]]));
  if (std::all_of(given.begin(), given.end(), [](const Stretch& s) { return s.round(); })) return;
  tube.shapes.resize(tube.points.size());
  for (std::size_t k = 0; k + 1 < given.size(); ++k)
    for (std::size_t i = tube.knots[k]; i <= tube.knots[k + 1]; ++i) {
      const double t =
          static_cast<double>(i - tube.knots[k]) / static_cast<double>(tube.knots[k + 1] - tube.knots[k]);
      tube.shapes[i] = section_of(given[k] * (1.0 - t) + given[k + 1] * t, tube.frames[i]);
    }
  measure(tube);
}

}  // namespace

void measure(Tube& tube) {
  tube.abscissa = geometry::abscissas(tube.points);
  tube.frames = geometry::rotation_minimising_frames(tube.points);
  const std::size_t n = tube.points.size();
  tube.curvature.assign(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 a = (tube.points[i] - tube.points[i - 1]).normalized();
    const Vec3 b = (tube.points[i + 1] - tube.points[i]).normalized();
    tube.curvature[i] = 2.0 * (b - a).norm() / (tube.abscissa[i + 1] - tube.abscissa[i - 1]);
  }
  tube.curvature.front() = tube.curvature[1];
  tube.curvature.back() = tube.curvature[n - 2];
  tube.stretch.resize(tube.shapes.size());
  for (std::size_t i = 0; i < tube.shapes.size(); ++i)
    tube.stretch[i] = stretch_of(tube.shapes[i], tube.frames[i]);
}

TubePlace at(const Tube& tube, double abscissa) {
  const auto next = std::upper_bound(tube.abscissa.begin() + 1, tube.abscissa.end() - 1, abscissa);
  const auto i = static_cast<std::size_t>(next - tube.abscissa.begin());
  const double t =
      std::clamp((abscissa - tube.abscissa[i - 1]) / (tube.abscissa[i] - tube.abscissa[i - 1]), 0.0, 1.0);
  const auto mix = [&](double a, double b) { return (1.0 - t) * a + t * b; };
  const Stretch stretch =
      tube.stretch.empty() ? Stretch() : tube.stretch[i - 1] * (1.0 - t) + tube.stretch[i] * t;
  return {(1.0 - t) * tube.points[i - 1] + t * tube.points[i],
          mix(tube.radius[i - 1] * tube.factor[i - 1], tube.radius[i] * tube.factor[i]),
          geometry::interpolated(tube.frames[i - 1], tube.frames[i], t), stretch};
}

std::vector<Tube> tubes_of(const geometry::VesselGraph& graph, const EllipticSections* sections) {
  const geometry::GraphIncidence incidence(graph);
  const std::vector<geometry::GraphBranch> branches = geometry::branches(graph, incidence);
  std::vector<Tube> tubes(branches.size());
  const auto joined = [&](std::int32_t point) {
    return incidence.leaving(point).size() + incidence.arriving(point).size();
  };
  core::parallel_for(branches.size(), 16, [&](std::size_t b) {
    const std::int32_t start = graph.edges[static_cast<std::size_t>(branches[b].edges.front())].from;
    const std::int32_t end = graph.edges[static_cast<std::size_t>(branches[b].edges.back())].to;
    tubes[b] = tube_of(line_of(graph, branches[b]), start == end && joined(start) == 2);
    if (sections != nullptr) add_shapes(tubes[b], *sections, branches[b]);
    tubes[b].start = start;
    tubes[b].end = end;
    tubes[b].inlet = joined(start) == 1;
    tubes[b].outlet = joined(end) == 1;
  });
  return tubes;
}

TubeEnds ends_of(const std::vector<Tube>& tubes, std::size_t points) {
  TubeEnds ends(points);
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    if (!tubes[i].inlet) ends[static_cast<std::size_t>(tubes[i].start)].push_back({index, false});
    if (!tubes[i].outlet) ends[static_cast<std::size_t>(tubes[i].end)].push_back({index, true});
  }
  return ends;
}

}  // namespace ostia::reconstruction
