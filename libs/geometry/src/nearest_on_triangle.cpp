#include "nearest_on_triangle.h"

#include <algorithm>

namespace ostia::geometry::detail {
namespace {

/// Keeps the point of segment (corner i, corner j) nearest to `query` when it beats `best`.
void consider_segment(const CornerPoints& p, int i, int j, const Vec3& query, Nearest& best) {
  const Vec3 direction = p[j] - p[i];
  const double length2 = direction.squaredNorm();
  double t = length2 > 0.0 ? (query - p[i]).dot(direction) / length2 : 0.0;
  t = std::clamp(t, 0.0, 1.0);
  const double squared = (query - ((1.0 - t) * p[i] + t * p[j])).squaredNorm();
  if (squared >= best.squared) return;
  best.squared = squared;
  best.weights.setZero();
  best.weights[i] = 1.0 - t;
  best.weights[j] += t;
}

Nearest nearest_on_edges(const CornerPoints& p, const Vec3& query) {
  Nearest best;
  consider_segment(p, 0, 1, query, best);
  consider_segment(p, 1, 2, query, best);
  consider_segment(p, 2, 0, query, best);
  return best;
}

}  // namespace

Nearest nearest_on_triangle(const CornerPoints& p, bool needle, const Vec3& query) {
  if (needle) return nearest_on_edges(p, query);
  const Vec3 ab = p[1] - p[0], ac = p[2] - p[0];
  const Vec3 aq = query - p[0], bq = query - p[1], cq = query - p[2];
  const double d1 = ab.dot(aq), d2 = ac.dot(aq);
  const double d3 = ab.dot(bq), d4 = ac.dot(bq);
  const double d5 = ab.dot(cq), d6 = ac.dot(cq);
  const double to_c = d1 * d4 - d3 * d2;
  const double to_b = d5 * d2 - d1 * d6;
  const double to_a = d3 * d6 - d5 * d4;
  Nearest result;
  if (d1 <= 0.0 && d2 <= 0.0) {
    result.weights = {1.0, 0.0, 0.0};
  } else if (d3 >= 0.0 && d4 <= d3) {
    result.weights = {0.0, 1.0, 0.0};
  } else if (d6 >= 0.0 && d5 <= d6) {
    result.weights = {0.0, 0.0, 1.0};
  } else if (to_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    result.weights = {1.0 - t, t, 0.0};
  } else if (to_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    result.weights = {1.0 - t, 0.0, t};
  } else if (to_a <= 0.0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    result.weights = {0.0, 1.0 - t, t};
  } else {
    const double sum = to_a + to_b + to_c;
    result.weights = {to_a / sum, to_b / sum, to_c / sum};
    if (!(result.weights.minCoeff() >= 0.0)) return nearest_on_edges(p, query);
  }
  const Vec3 point = result.weights[0] * p[0] + result.weights[1] * p[1] + result.weights[2] * p[2];
  result.squared = (query - point).squaredNorm();
  return result;
}

bool is_needle(const CornerPoints& p) {
  const Vec3 u = p[1] - p[0], v = p[2] - p[1], w = p[0] - p[2];
  const double longest2 = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
  return !(u.cross(v).norm() > 1e-10 * longest2);
}

TrianglePlane::TrianglePlane(const CornerPoints& p) {
  constexpr double sliver = 1e-3;  // of the longest edge squared: twice the area
  const Vec3 u = p[1] - p[0], v = p[2] - p[1], w = p[0] - p[2];
  const Vec3 normal = u.cross(v);
  const double length = normal.norm();
  if (!(length > sliver * std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()}))) return;
  normal_ = normal / length;
  along_ = normal_.dot(p[0]);
}

void search_nearest(const Bvh& bvh, const std::vector<CornerPoints>& triangles,
                    const std::vector<char>& needles, const std::vector<TrianglePlane>& planes,
                    const Vec3& query, Nearest& best, std::int32_t& best_place) {
  struct Waiting {
    std::int32_t node;
    double squared;
  };
  Waiting stack[bvh_stack_size];
  int size = 0;
  stack[size++] = {0, bvh.nodes[0].box.squared_distance(query)};
  while (size > 0) {
    const Waiting top = stack[--size];
    if (!(top.squared < best.squared)) continue;
    const BvhNode& node = bvh.nodes[static_cast<std::size_t>(top.node)];
    if (node.count > 0) {
      for (std::int32_t place = node.next; place < node.next + node.count; ++place) {
        const auto i = static_cast<std::size_t>(place);
        if (planes[i].is_beyond(query, best.squared)) continue;
        const Nearest candidate = nearest_on_triangle(triangles[i], needles[i] != 0, query);
        if (candidate.squared < best.squared) {
          best = candidate;
          best_place = place;
        }
      }
      continue;
    }
    Waiting near{top.node + 1, bvh.nodes[static_cast<std::size_t>(top.node) + 1].box.squared_distance(query)};
    Waiting far{node.next, bvh.nodes[static_cast<std::size_t>(node.next)].box.squared_distance(query)};
    if (far.squared < near.squared) std::swap(near, far);
    if (far.squared < best.squared) stack[size++] = far;
    if (near.squared < best.squared) stack[size++] = near;
  }
}

SurfacePoint surface_point(const Bvh& bvh, const std::vector<CornerPoints>& triangles, const Vec3& query,
                           const Nearest& best, std::int32_t place) {
  SurfacePoint result;
  if (place < 0) return result;
  const CornerPoints& p = triangles[static_cast<std::size_t>(place)];
  result.triangle = bvh.order[static_cast<std::size_t>(place)];
  result.barycentric = best.weights;
  result.point = best.weights[0] * p[0] + best.weights[1] * p[1] + best.weights[2] * p[2];
  result.distance = (query - result.point).norm();
  return result;
}

}  // namespace ostia::geometry::detail
