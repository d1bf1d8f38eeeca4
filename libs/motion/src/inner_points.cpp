#include "inner_points.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>

namespace ostia::motion {
namespace {

using geometry::Mat3;
using geometry::Vec3;
using Quad = std::array<Vec3, 4>;

/// m times the matrix that takes x to x cross v.
Mat3 columns_crossed(const Mat3& m, const Vec3& v) {
  Mat3 out;
  out.col(0) = m.col(2) * v.y() - m.col(1) * v.z();
  out.col(1) = m.col(0) * v.z() - m.col(2) * v.x();
  out.col(2) = m.col(1) * v.x() - m.col(0) * v.y();
  return out;
}

/// Side e = q[i+1] - q[i] squares the area with p as (p - q[i])^T side_square (p - q[i]).
Mat3 side_square(const Vec3& e) {
  return e.squaredNorm() * Mat3::Identity() - e * e.transpose();
}

/// Small cells and flat quadrilaterals have no unique point: then the one nearest the mean.
Mat3 inverse_of(Mat3 m) {
  m.diagonal().array() += 1e-12 * m.trace() + 1e-300;
  Mat3 inverse;
  bool well = false;
  m.computeInverseWithCheck(inverse, well, 1e-9 * std::pow(m.trace(), 3));
  return well ? inverse : Mat3(m.ldlt().solve(Mat3::Identity()));
}

Quad face_quad(const CellPoints& points, std::size_t face) {
  Quad quad;
  for (std::size_t i = 0; i < 4; ++i) quad[i] = points[static_cast<std::size_t>(cell_faces[face][i])];
  return quad;
}

Mat3 area_matrix(const Quad& quad) {
  Mat3 sum = Mat3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += side_square(quad[(i + 1) % 4] - quad[i]);
  return sum;
}

/// Motion of a face's point by its four corners: the derivative of the normal equations.
std::array<Mat3, 4> face_point_motion(const Quad& quad, const Vec3& point) {
  std::array<Mat3, 4> by;
  by.fill(Mat3::Zero());
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 e = quad[(i + 1) % 4] - quad[i], w = quad[i] - point;
    // d(|e|^2 w - e (e.w)) by e
    const Mat3 by_side = 2.0 * w * e.transpose() - e.dot(w) * Mat3::Identity() - e * w.transpose();
    by[(i + 1) % 4] += by_side;
    by[i] += side_square(e) - by_side;
  }
  const Mat3 inverse = inverse_of(area_matrix(quad));
  for (Mat3& m : by) m = inverse * m;
  return by;
}

/// Calls body(a, b, f) for the base of each of the 24 tetrahedra: two corners and the face point.
template <class Body>
void for_bases(const Body& body) {
  for (std::size_t face = 0; face < 6; ++face)
    for (std::size_t i = 0; i < 4; ++i)
      body(static_cast<std::size_t>(cell_faces[face][i]),
           static_cast<std::size_t>(cell_faces[face][(i + 1) % 4]), 8 + face);
}

Vec3 base_normal(const CellPoints& p, std::size_t a, std::size_t b, std::size_t f) {
  return (p[b] - p[a]).cross(p[f] - p[a]);
}

Mat3 volume_matrix(const CellPoints& points) {
  Mat3 sum = Mat3::Zero();
  for_bases([&](std::size_t a, std::size_t b, std::size_t f) {
    const Vec3 n = base_normal(points, a, b, f);
    sum += n * n.transpose();
  });
  return sum;
}

Vec3 equal_volume_point(const CellPoints& points) {
  Vec3 mean = Vec3::Zero(), sum = Vec3::Zero();
  for (std::size_t c = 0; c < 8; ++c) mean += points[c] / 8.0;
  for_bases([&](std::size_t a, std::size_t b, std::size_t f) {
    const Vec3 n = base_normal(points, a, b, f);
    sum += n * n.dot(points[a] - mean);
  });
  return mean + inverse_of(volume_matrix(points)) * sum;
}

}  // namespace

Vec3 equal_area_point(const Quad& quad) {
  const Vec3 mean = (quad[0] + quad[1] + quad[2] + quad[3]) / 4.0;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += side_square(quad[(i + 1) % 4] - quad[i]) * (quad[i] - mean);
  return mean + inverse_of(area_matrix(quad)) * sum;
}

CellPoints cell_points(const std::array<Vec3, 8>& corners) {
  CellPoints points;
  std::copy(corners.begin(), corners.end(), points.begin());
  for (std::size_t face = 0; face < 6; ++face) points[8 + face] = equal_area_point(face_quad(points, face));
  points[14] = equal_volume_point(points);
  return points;
}

InnerMotion inner_motion(const CellPoints& points) {
  InnerMotion motion;
  Eigen::Matrix<double, 3, 24> sum = Eigen::Matrix<double, 3, 24>::Zero();
  Mat3 square = Mat3::Zero();
  const auto of_corner = [&](int corner) { return sum.middleCols<3>(3 * corner); };
  for (std::size_t face = 0; face < 6; ++face) {
    motion.face[face] = face_point_motion(face_quad(points, face), points[8 + face]);
    Mat3 by_face_point = Mat3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      const int a = cell_faces[face][i], b = cell_faces[face][(i + 1) % 4];
      const Vec3 &corner = points[static_cast<std::size_t>(a)], &next = points[static_cast<std::size_t>(b)];
      const Vec3 side = next - corner, up = points[8 + face] - corner, n = side.cross(up);
      const Vec3 w = corner - points[14];
      // d(n (n.w)) = (n.w) dn + n (w.dn) + n (n.da)
      const Mat3 by_normal = n.dot(w) * Mat3::Identity() + n * w.transpose();
      const Mat3 by_side = columns_crossed(by_normal, up), by_up = columns_crossed(by_normal, -side);
      const Mat3 own = n * n.transpose();
      square += own;
      of_corner(b) += by_side;
      of_corner(a) += own - by_side - by_up;
      by_face_point += by_up;
    }
    for (std::size_t i = 0; i < 4; ++i)
      of_corner(cell_faces[face][i]) += by_face_point.lazyProduct(motion.face[face][i]);
  }
  motion.volume = inverse_of(square).lazyProduct(sum);
  return motion;
}

}  // namespace ostia::motion
