#include "winding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::geometry::detail {
namespace {

// Distance, in radii of a cluster, from which its expansion stands in for it: the sum's error stays near
// 1e-3.
constexpr double far_in_radii = 2.3;

/// A sum of half solid angles (van Oosterom and Strackee 1983), each the argument of a complex number. The
/// arguments of small ones add up in a product, which takes one arctangent for many triangles.
class AngleSum {
 public:
  void add(const CornerPoints& p, const Vec3& query) {
    const Vec3 a = p[0] - query, b = p[1] - query, c = p[2] - query;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double above = a.dot(b.cross(c));
    const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    if (std::abs(above) < small_tangent * below) {
      const double tangent = above / below;
      const double real = real_ - imaginary_ * tangent;
      imaginary_ += real_ * tangent;
      real_ = real;
      if (++factors_ == most_factors) flush();
    } else if (above != 0.0 || below != 0.0) {
      sum_ += std::atan2(above, below);
    }
  }

  double total() {
    flush();
    return sum_;
  }

 private:
  // Together the arguments stay below 8 atan(0.4) = 3.04, within half a turn.
  static constexpr double small_tangent = 0.4;
  static constexpr int most_factors = 8;

  void flush() {
    sum_ += std::atan2(imaginary_, real_);
    real_ = 1.0;
    imaginary_ = 0.0;
    factors_ = 0;
  }

  double sum_ = 0.0;
  double real_ = 1.0;
  double imaginary_ = 0.0;
  int factors_ = 0;
};

// The places of the symmetric tensors' components.
constexpr int first_index[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
constexpr int second_index[10][3] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 0, 1}, {1, 1, 2},
                                     {2, 2, 0}, {0, 1, 1}, {1, 2, 2}, {2, 0, 0}, {0, 1, 2}};
constexpr int first_place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

double farthest_corner(const BvhBox& box, const Vec3& point) {
  double sum = 0.0;
  for (int a = 0; a < 3; ++a) {
    const double gap = std::max(point[a] - box.lower[a], box.upper[a] - point[a]);
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

}  // namespace

/// A dipole that stands `offset` from the centre.
void WindingTree::add(Moments& moments, const Vec3& offset, const Vec3& dipole) {
  for (int n = 0; n < 6; ++n) {
    const auto [i, j] = first_index[n];
    moments.first[n] += 0.5 * (offset[i] * dipole[j] + offset[j] * dipole[i]);
  }
  for (int n = 0; n < 10; ++n) {
    const auto [i, j, k] = second_index[n];
    moments.second[n] += (offset[i] * offset[j] * dipole[k] + offset[j] * offset[k] * dipole[i] +
                          offset[k] * offset[i] * dipole[j]) /
                         3.0;
  }
}

/// The moments of a part whose centre stands `offset` from this one.
void WindingTree::add_shifted(Moments& moments, const Vec3& offset, const Moments& part) {
  add(moments, offset, part.dipole);
  for (int n = 0; n < 6; ++n) moments.first[n] += part.first[n];
  for (int n = 0; n < 10; ++n) {
    const auto [i, j, k] = second_index[n];
    const double cross = offset[i] * part.first[first_place[j][k]] +
                         offset[j] * part.first[first_place[k][i]] +
                         offset[k] * part.first[first_place[i][j]];
    moments.second[n] += part.second[n] + 2.0 / 3.0 * cross;
  }
}

WindingTree::WindingTree(const Bvh& bvh, const std::vector<CornerPoints>& triangles)
    : moments_(bvh.nodes.size()) {
  std::vector<double> areas(bvh.nodes.size(), 0.0);
  // Children stand behind their parents: backwards, they come first.
  for (std::size_t n = bvh.nodes.size(); n-- > 0;) {
    const BvhNode& node = bvh.nodes[n];
    Moments& own = moments_[n];
    own.next = node.next;
    own.count = node.count;
    const Vec3 box_center = 0.5 * (Vec3(node.box.lower) + Vec3(node.box.upper));
    Vec3 weighted = Vec3::Zero();
    double radius = 0.0;
    if (node.count > 0) {
      const auto first = static_cast<std::size_t>(node.next),
                 last = first + static_cast<std::size_t>(node.count);
      for (std::size_t i = first; i < last; ++i) {
        const CornerPoints& p = triangles[i];
        const Vec3 normal = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
        areas[n] += normal.norm();
        weighted += normal.norm() * (p[0] + p[1] + p[2]) / 3.0;
        own.dipole += normal;
      }
      own.center = areas[n] > 0.0 ? Vec3(weighted / areas[n]) : box_center;
      for (std::size_t i = first; i < last; ++i) {
        const CornerPoints& p = triangles[i];
        // A third at each edge's middle has the moments of the whole triangle up to the second.
        const Vec3 third = (p[1] - p[0]).cross(p[2] - p[0]) / 6.0;
        for (std::size_t k = 0; k < 3; ++k) {
          add(own, 0.5 * (p[k] + p[(k + 1) % 3]) - own.center, third);
          radius = std::max(radius, (p[k] - own.center).norm());
        }
      }
    } else {
      const std::size_t children[2] = {n + 1, static_cast<std::size_t>(node.next)};
      for (const std::size_t child : children) {
        areas[n] += areas[child];
        weighted += areas[child] * moments_[child].center;
        own.dipole += moments_[child].dipole;
      }
      own.center = areas[n] > 0.0 ? Vec3(weighted / areas[n]) : box_center;
      for (const std::size_t child : children) {
        const Moments& part = moments_[child];
        const Vec3 offset = part.center - own.center;
        add_shifted(own, offset, part);
        radius = std::max(radius, offset.norm() + std::sqrt(part.far2) / far_in_radii);
      }
    }
    radius = std::min(radius, farthest_corner(node.box, own.center));
    own.far2 = far_in_radii * far_in_radii * radius * radius;
  }
}

double WindingTree::at(const Vec3& query, const std::vector<CornerPoints>& triangles) const {
  std::int32_t stack[bvh_stack_size];
  int size = 0;
  stack[size++] = 0;
  AngleSum near;     // of half solid angles
  double far = 0.0;  // sum of solid angles
  while (size > 0) {
    const auto n = static_cast<std::size_t>(stack[--size]);
    const Moments& own = moments_[n];
    const Vec3 d = own.center - query;
    const double d2 = d.squaredNorm();
    if (d2 > own.far2) {
      const double inverse3 = 1.0 / (d2 * std::sqrt(d2));
      const double x = d.x(), y = d.y(), z = d.z();
      const double* f = own.first;
      const double* s = own.second;
      const double along1 =
          x * x * f[0] + y * y * f[1] + z * z * f[2] + 2.0 * (x * y * f[3] + y * z * f[4] + z * x * f[5]);
      const double along2 = x * x * (x * s[0] + 3.0 * (y * s[3] + z * s[8])) +
                            y * y * (y * s[1] + 3.0 * (z * s[4] + x * s[6])) +
                            z * z * (z * s[2] + 3.0 * (x * s[5] + y * s[7])) + 6.0 * x * y * z * s[9];
      const double trace2 = x * (s[0] + s[6] + s[5]) + y * (s[3] + s[1] + s[7]) + z * (s[8] + s[4] + s[2]);
      const double inverse2 = 1.0 / d2;
      far += inverse3 * (d.dot(own.dipole) + f[0] + f[1] + f[2] - 3.0 * along1 * inverse2 +
                         (7.5 * along2 * inverse2 - 4.5 * trace2) * inverse2);
    } else if (own.count > 0) {
      for (std::int32_t i = own.next; i < own.next + own.count; ++i) {
        near.add(triangles[static_cast<std::size_t>(i)], query);
      }
    } else {
      stack[size++] = own.next;
      stack[size++] = static_cast<std::int32_t>(n) + 1;
    }
  }
  return (near.total() + 0.5 * far) / (2.0 * std::numbers::pi);
}

}  // namespace ostia::geometry::detail
