#include "inner_points.h"

#include <Eigen/Cholesky>

namespace ostia::motion {
namespace {

using geometry::Mat3;
using geometry::Vec3;
using Quad = std::array<Vec3, 4>;

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Side e = q[i+1] - q[i] squares the area with p as (p - q[i])^T side_square (p - q[i]).
Mat3 side_square(const Vec3& e) {
  return e.squaredNorm() * Mat3::Identity() - e * e.transpose();
}

/// Small cells and flat quadrilaterals have no unique point: then the one nearest the mean.
Mat3 inverse_of(Mat3 m) {
  m.diagonal().array() += 1e-12 * m.trace() + 1e-300;
  return m.ldlt().solve(Mat3::Identity());
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

PointMotion point_motion(const CellPoints& points) {
  PointMotion motion = PointMotion::Zero();
  motion.topRows<24>().setIdentity();
  for (std::size_t face = 0; face < 6; ++face) {
    const auto by = face_point_motion(face_quad(points, face), points[8 + face]);
    for (std::size_t i = 0; i < 4; ++i)
      motion.block<3, 3>(static_cast<Eigen::Index>(24 + 3 * face), 3 * cell_faces[face][i]) = by[i];
  }
  Eigen::Matrix<double, 3, 24> volume_point = Eigen::Matrix<double, 3, 24>::Zero();
  for_bases([&](std::size_t a, std::size_t b, std::size_t f) {
    const Vec3 side = points[b] - points[a], up = points[f] - points[a], n = side.cross(up);
    const Vec3 w = points[a] - points[14];
    // d(n (n.w)) = (n.w) dn + n (w.dn) + n (n.da)
    const Mat3 by_normal = n.dot(w) * Mat3::Identity() + n * w.transpose();
    const Mat3 by_side = by_normal * -cross_matrix(up), by_up = by_normal * cross_matrix(side);
    const auto rows = [&](std::size_t p) { return motion.middleRows<3>(static_cast<Eigen::Index>(3 * p)); };
    volume_point += by_side * rows(b) + by_up * rows(f) + (n * n.transpose() - by_side - by_up) * rows(a);
  });
  motion.bottomRows<3>() = inverse_of(volume_matrix(points)) * volume_point;
  return motion;
}

}  // namespace ostia::motion
