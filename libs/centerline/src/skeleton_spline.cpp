#include "graph_editor.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/geometry/polyline.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::centerline {
namespace {

constexpr int degree = 3;
// Weight of the control points' third differences, which settles pieces without a point of their own.
constexpr double ridge = 1e-9;

// A clamped cubic B-spline over [0, length] with equal pieces.
class Basis {
 public:
  Basis(double length, int pieces) : length_(length), pieces_(pieces) {}
  Eigen::Index count() const { return pieces_ + degree; }

  // The four values at t, which belong to the control points from `first` on (de Boor).
  std::array<double, degree + 1> values(double t, Eigen::Index& first) const {
    const int piece = std::clamp(static_cast<int>(t / length_ * pieces_), 0, pieces_ - 1);
    first = piece;
    std::array<double, degree + 1> b{1.0, 0.0, 0.0, 0.0}, left{}, right{};
    for (int d = 1; d <= degree; ++d) {
      const auto at = static_cast<std::size_t>(d);
      left[at] = t - knot(piece + 1 - d);
      right[at] = knot(piece + d) - t;
      double carried = 0.0;
      for (std::size_t r = 0; r < at; ++r) {
        const double share = b[r] / (right[r + 1] + left[at - r]);
        b[r] = carried + right[r + 1] * share;
        carried = left[at - r] * share;
      }
      b[at] = carried;
    }
    return b;
  }

 private:
  double knot(int i) const { return length_ * std::clamp(i, 0, pieces_) / pieces_; }
  double length_;
  int pieces_;
};

// Control points of the least-squares spline, the first and the last fixed at the ends of the line.
Eigen::MatrixX3d fit(const Basis& basis, const std::vector<double>& t, const std::vector<Vec3>& points) {
  const Eigen::Index n = basis.count();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(n, 3);
  for (std::size_t i = 0; i < t.size(); ++i) {
    Eigen::Index first = 0;
    const auto b = basis.values(t[i], first);
    for (Eigen::Index r = 0; r <= degree; ++r) {
      const double br = b[static_cast<std::size_t>(r)];
      right.row(first + r) += br * points[i].transpose();
      for (Eigen::Index c = 0; c <= degree; ++c)
        normal(first + r, first + c) += br * b[static_cast<std::size_t>(c)];
    }
  }
  const Eigen::Vector4d difference(-1.0, 3.0, -3.0, 1.0);
  for (Eigen::Index i = 0; i + degree < n; ++i)
    normal.block<4, 4>(i, i) += ridge * difference * difference.transpose();
  Eigen::MatrixX3d control(n, 3);
  control.row(0) = points.front().transpose();
  control.row(n - 1) = points.back().transpose();
  const Eigen::Index inner = n - 2;
  const Eigen::MatrixX3d known = right.middleRows(1, inner) - normal.block(1, 0, inner, 1) * control.row(0) -
                                 normal.block(1, n - 1, inner, 1) * control.row(n - 1);
  control.middleRows(1, inner) = normal.block(1, 1, inner, inner).ldlt().solve(known);
  return control;
}

struct Line {
  std::vector<Vec3> points;
  std::vector<double> radius_mm;
};

double value_at(const std::vector<double>& s, const std::vector<double>& values, double at) {
  const auto above = std::upper_bound(s.begin(), s.end(), at);
  if (above == s.begin()) return values.front();
  if (above == s.end()) return values.back();
  const auto i = static_cast<std::size_t>(above - s.begin());
  const double t = (at - s[i - 1]) / (s[i] - s[i - 1]);
  return (1.0 - t) * values[i - 1] + t * values[i];
}

Line smooth_line(const Line& line, const SplineOptions& options) {
  const std::vector<double> s = geometry::abscissas(line.points);
  const double length = s.back();
  // No more pieces than points can settle.
  const int most = std::max(1, static_cast<int>(line.points.size()) / 2 - 1);
  const int pieces = std::clamp(static_cast<int>(std::lround(length / options.knot_spacing_mm)), 1, most);
  const Basis basis(length, pieces);
  const Eigen::MatrixX3d control = fit(basis, s, line.points);
  std::vector<double> at = s;
  if (options.step_mm > 0.0) {
    const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil(length / options.step_mm - 1e-9)));
    at.assign(steps + 1, 0.0);
    for (std::size_t i = 0; i <= steps; ++i)
      at[i] = length * static_cast<double>(i) / static_cast<double>(steps);
  }
  Line result;
  for (const double t : at) {
    Eigen::Index first = 0;
    const auto b = basis.values(t, first);
    Vec3 p = Vec3::Zero();
    for (Eigen::Index r = 0; r <= degree; ++r)
      p += b[static_cast<std::size_t>(r)] * control.row(first + r).transpose();
    result.points.push_back(p);
    result.radius_mm.push_back(value_at(s, line.radius_mm, t));
  }
  result.points.front() = line.points.front();
  result.points.back() = line.points.back();
  return result;
}

// The closed line begun at its point `first`.
Line turned(const Line& line, std::size_t first) {
  const std::size_t n = line.points.size() - 1;
  Line result;
  for (std::size_t i = 0; i <= n; ++i) {
    result.points.push_back(line.points[(first + i) % n]);
    result.radius_mm.push_back(line.radius_mm[(first + i) % n]);
  }
  return result;
}

// Smoothed once, and again from the opposite point, where the first turn is smooth: it becomes the anchor.
Line smooth_ring(const Line& ring, const SplineOptions& options) {
  if (ring.points.size() < 6) return ring;
  const std::size_t half = (ring.points.size() - 1) / 2;
  SplineOptions same = options;
  same.step_mm = 0.0;
  Line opened = turned(ring, half);
  opened.points.front() = opened.points.back() = smooth_line(ring, same).points[half];
  return smooth_line(opened, options);
}

}  // namespace

void validate(const SplineOptions& o) {
  detail::require(o.knot_spacing_mm >= 0.1 && o.knot_spacing_mm <= 1000.0, "B-spline", "knot_spacing_mm",
                  o.knot_spacing_mm, "[0.1, 1000] mm");
  detail::require(o.step_mm >= 0.0 && o.step_mm <= 10.0, "B-spline", "step_mm", o.step_mm, "[0, 10] mm");
}

SkeletonGraph smoothed(const SkeletonGraph& graph, const SplineOptions& options) {
  validate(options);
  detail::require_sound(graph, "B-spline");
  detail::GraphEditor editor(graph);
  for (const SkeletonEdge& e : graph.edges) {
    const bool ring = node(graph, e.from).kind == SkeletonNodeKind::loop_anchor;
    Line line{e.points, e.radius_mm};
    line = ring ? smooth_ring(line, options) : smooth_line(line, options);
    if (ring) editor.node(e.from).position = line.points.front();
    editor.replace_line(e.id, std::move(line.points), std::move(line.radius_mm));
  }
  SkeletonGraph result = editor.graph();
  result.oriented = graph.oriented;
  return result;
}

}  // namespace ostia::centerline
