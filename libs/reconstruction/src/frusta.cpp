#include "ostia/reconstruction/frusta.h"

#include "ostia/core/error.h"
#include "ostia/geometry/frame.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::reconstruction {
namespace {

using geometry::Vec3;

/// Two cones' mitre reaches at most so far, in radii: beyond it the joint turns back.
constexpr double longest_mitre = 2.0;

struct Axis {
  std::vector<Vec3> points;
  std::vector<double> radius;       ///< at each point
  std::vector<std::int32_t> edges;  ///< of each cone
};

Axis axis_of(const geometry::VesselGraph& graph, const geometry::GraphBranch& branch,
             const FrustaOptions& options) {
  const auto edge = [&](std::size_t i) { return graph.edges[static_cast<std::size_t>(branch.edges[i])]; };
  std::vector<Vec3> given{graph.points[static_cast<std::size_t>(edge(0).from)]};
  for (std::size_t i = 0; i < branch.edges.size(); ++i)
    given.push_back(graph.points[static_cast<std::size_t>(edge(i).to)]);
  Axis axis;
  if (options.smooth) {
    axis.points = b_spline_axis(given, options.pieces);
  } else {
    for (std::size_t i = 0; i + 1 < given.size(); ++i)
      for (int k = 0; k < options.pieces; ++k)
        axis.points.push_back(given[i] + (given[i + 1] - given[i]) * k / options.pieces);
    axis.points.push_back(given.back());
  }
  for (std::size_t i = 0; i < branch.edges.size(); ++i)
    for (int k = 0; k < options.pieces; ++k) {
      const double t = static_cast<double>(k) / options.pieces;
      const double r = (1.0 - t) * edge(i).radius_from + t * edge(i).radius_to;
      // One circle is shared: where two segments differ, it has their mean radius.
      axis.radius.push_back(k == 0 && i > 0 ? 0.5 * (r + edge(i - 1).radius_to) : r);
      axis.edges.push_back(branch.edges[i]);
    }
  axis.radius.push_back(edge(branch.edges.size() - 1).radius_to);
  return axis;
}

/// The corners of the section shared by the cones before and after point i: the circle across the first
/// cone, carried along it into the bisecting plane.
void add_section(const Axis& axis, const std::vector<geometry::Frame>& frames, std::size_t i, double abscissa,
                 const FrustaOptions& options, FrustaMesh& out) {
  const std::size_t n = axis.points.size();
  const Vec3 before = i > 0 ? Vec3((axis.points[i] - axis.points[i - 1]).normalized())
                            : Vec3((axis.points[1] - axis.points[0]).normalized());
  const Vec3 after = i + 1 < n ? Vec3((axis.points[i + 1] - axis.points[i]).normalized()) : before;
  const double nearest = std::min(i > 0 ? (axis.points[i] - axis.points[i - 1]).norm() : 1e300,
                                  i + 1 < n ? (axis.points[i + 1] - axis.points[i]).norm() : 1e300);
  const Vec3 sum = before + after;
  // A joint that turns right back has no bisecting plane across the vessel: the frame's own is taken.
  const Vec3 plane = sum.norm() > 1e-3 ? Vec3(sum.normalized()) : frames[i].tangent;
  const double slope = std::max(0.05, plane.dot(before));
  const double reach = std::min({1.0 / slope, longest_mitre, std::max(1.0, 0.5 * nearest / axis.radius[i])});
  const Vec3 turn = after - before;
  const Vec3 inward = turn - turn.dot(plane) * plane;
  const Vec3 long_way = inward.norm() > 1e-9 ? Vec3(inward.normalized()) : Vec3::Zero();
  const double r = axis.radius[i];
  const double growth = i + 1 < n ? (axis.radius[i + 1] - r) / (axis.points[i + 1] - axis.points[i]).norm()
                                  : (r - axis.radius[i - 1]) / (axis.points[i] - axis.points[i - 1]).norm();
  Vec3 u = frames[i].normal - frames[i].normal.dot(plane) * plane;
  u.normalize();
  const Vec3 v = plane.cross(u);
  for (int k = 0; k <= options.sides; ++k) {  // the seam is there twice, with 0 and 1 around
    const double angle = 2.0 * std::numbers::pi * k / options.sides;
    const Vec3 d = std::cos(angle) * u + std::sin(angle) * v;
    const Vec3 offset = r * (d + (reach - 1.0) * d.dot(long_way) * long_way);
    out.mesh.points.push_back(axis.points[i] + offset);
    out.normals.push_back((d - growth * plane).normalized());
    out.texture.emplace_back(abscissa, static_cast<double>(k) / options.sides);
  }
}

void add_branch(const Axis& axis, const FrustaOptions& options, FrustaMesh& out) {
  const std::vector<geometry::Frame> frames = geometry::rotation_minimising_frames(axis.points);
  const std::vector<double> s = geometry::abscissas(axis.points);
  const auto first = static_cast<std::int32_t>(out.mesh.points.size());
  for (std::size_t i = 0; i < axis.points.size(); ++i) add_section(axis, frames, i, s[i], options, out);
  const std::int32_t row = options.sides + 1;
  for (std::size_t i = 0; i + 1 < axis.points.size(); ++i)
    for (std::int32_t k = 0; k < options.sides; ++k) {
      const std::int32_t a = first + static_cast<std::int32_t>(i) * row + k;
      out.mesh.triangles.push_back({a, a + 1, a + row + 1});
      out.mesh.triangles.push_back({a, a + row + 1, a + row});
      out.edge_of_triangle.insert(out.edge_of_triangle.end(), 2, axis.edges[i]);
    }
}

}  // namespace

void validate(const FrustaOptions& o) {
  if (o.sides < 3 || o.sides > 256) throw InvalidInput("frusta: sides must be 3 to 256");
  if (o.pieces < 1 || o.pieces > 64) throw InvalidInput("frusta: pieces must be 1 to 64");
}

std::vector<Vec3> b_spline_axis(const std::vector<Vec3>& points, int pieces) {
  if (points.size() < 2) throw InvalidInput("a vessel's axis needs at least two points");
  // One control point beyond either end, mirrored there: the curve begins and ends at the points given.
  std::vector<Vec3> control{2.0 * points.front() - points[1]};
  control.insert(control.end(), points.begin(), points.end());
  control.push_back(2.0 * points.back() - points[points.size() - 2]);
  std::vector<Vec3> curve;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces, u = 1.0 - t;
      curve.push_back((u * u * u * control[i] + (3.0 * t * t * t - 6.0 * t * t + 4.0) * control[i + 1] +
                       (3.0 * u * u * u - 6.0 * u * u + 4.0) * control[i + 2] + t * t * t * control[i + 3]) /
                      6.0);
    }
  curve.front() = points.front();
  curve.push_back(points.back());
  return curve;
}

FrustaMesh frusta(const geometry::VesselGraph& graph, const FrustaOptions& options,
                  const core::TaskContext& task) {
  validate(options);
  geometry::require_sound(graph, "the network of vessels", false, task.sub(0.0, 0.1));
  const geometry::GraphIncidence incidence(graph);
  FrustaMesh out;
  std::size_t done = 0, since = 0;
  for (const geometry::GraphBranch& branch : geometry::branches(graph, incidence)) {
    if (since++ % 256 == 0) {
      task.throw_if_cancelled();
      task.set_progress(0.1 + 0.9 * static_cast<double>(done) / static_cast<double>(graph.edges.size()));
    }
    done += branch.edges.size();
    add_branch(axis_of(graph, branch, options), options, out);
  }
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::reconstruction
