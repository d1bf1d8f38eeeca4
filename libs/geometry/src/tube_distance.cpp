#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

constexpr std::int32_t leaf_size = 4;

/// Squared distance of a point from a box, 0 inside; without the branches of Eigen's, which are guessed
/// wrong.
double squared_distance(const Box3& box, const Vec3& p) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0.0).squaredNorm();
}

}  // namespace

TubeDistance::TubeDistance(const AnalyticShape& shape) {
  for (std::size_t tube = 0; tube < shape.tubes.size(); ++tube) {
    const Centerline& axis = shape.tubes[tube].axis;
    if (axis.radius.size() != axis.size() || axis.abscissa.size() != axis.size()) {
      throw InvalidInput("tube " + shape.tubes[tube].name + " has not one radius and abscissa a point");
    }
    for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
      pieces_.push_back({axis.points[i], axis.points[i + 1], axis.radius[i], axis.radius[i + 1],
                         axis.abscissa[i], axis.abscissa[i + 1], tube});
    }
  }
  if (pieces_.empty()) throw InvalidInput("the analytic shape has no tube with two points or more");
  build(0, static_cast<std::int32_t>(pieces_.size()));
}

std::int32_t TubeDistance::build(std::int32_t first, std::int32_t last) {
  Node node{Box3(), 0.0, -1, -1, first, last};
  for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
    node.box.extend(pieces_[i].a).extend(pieces_[i].b);
    node.radius = std::max({node.radius, pieces_[i].ra, pieces_[i].rb});
  }
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back(node);
  if (last - first <= leaf_size) return index;
  Eigen::Index widest = 0;
  node.box.sizes().maxCoeff(&widest);
  const std::int32_t middle = (first + last) / 2;
  std::nth_element(
      pieces_.begin() + first, pieces_.begin() + middle, pieces_.begin() + last,
      [&](const Piece& p, const Piece& q) { return p.a[widest] + p.b[widest] < q.a[widest] + q.b[widest]; });
  const std::int32_t left = build(first, middle), right = build(middle, last);
  nodes_[static_cast<std::size_t>(index)].left = left;
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

// Along a piece, with x the foot of the point and y its distance from the line, sqrt((s - x)^2 + y^2) - r - k
// s is convex in s and least at s = x + k y / sqrt(1 - k^2); where the radius grows faster than the axis (k
// >= 1), at an end.
TubeDistance::Nearest TubeDistance::nearest_on(const Piece& piece, const Vec3& point) const {
  const Vec3 along = piece.b - piece.a, to_point = point - piece.a;
  const double length = along.norm();
  double t = 0.0;
  if (length > 0.0) {
    const double k = (piece.rb - piece.ra) / length;
    if (k >= 1.0) {
      t = 1.0;
    } else if (k > -1.0) {
      const double x = to_point.dot(along) / length;
      const double y = (to_point - (x / length) * along).norm();
      t = std::clamp((x + k * y / std::sqrt(1.0 - k * k)) / length, 0.0, 1.0);
    }
  }
  Nearest result{piece.tube, (1.0 - t) * piece.sa + t * piece.sb, (1.0 - t) * piece.ra + t * piece.rb,
                 (1.0 - t) * piece.a + t * piece.b, 0.0};
  result.distance = (point - result.axis_point).norm() - result.radius;
  return result;
}

TubeDistance::Nearest TubeDistance::nearest(const Vec3& point) const {
  const auto bound = [&](std::int32_t i) {
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    return std::sqrt(squared_distance(node.box, point)) - node.radius;
  };
  struct Waiting {
    std::int32_t node;
    double bound;
  };
  std::array<Waiting, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, bound(0)};
  Nearest best{};
  best.distance = std::numeric_limits<double>::infinity();
  while (depth > 0) {
    const Waiting next = stack[--depth];
    if (next.bound >= best.distance) continue;
    const Node& node = nodes_[static_cast<std::size_t>(next.node)];
    if (node.left < 0) {
      for (auto i = static_cast<std::size_t>(node.first); i < static_cast<std::size_t>(node.last); ++i) {
        const Nearest here = nearest_on(pieces_[i], point);
        if (here.distance < best.distance) best = here;
      }
      continue;
    }
    Waiting near{node.left, bound(node.left)}, far{node.right, bound(node.right)};
    if (far.bound < near.bound) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return best;
}

double TubeDistance::operator()(const Vec3& point) const {
  return nearest(point).distance;
}

}  // namespace ostia::geometry
