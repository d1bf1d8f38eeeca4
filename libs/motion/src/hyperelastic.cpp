#include "ostia/motion/hyperelastic.h"

#include "inner_points.h"

#include <Eigen/LU>

#include <limits>

namespace ostia::motion {
namespace {

using geometry::Mat3;
using geometry::Vec3;
using Tetrahedron = std::array<int, 4>;
using Row9 = Eigen::Matrix<double, 9, 1>;  // a 3 x 3 matrix, column by column

std::array<Tetrahedron, 24> made_tetrahedra() {
  std::array<Tetrahedron, 24> tets{};
  std::size_t k = 0;
  for (int face = 0; face < 6; ++face)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& corners = cell_faces[static_cast<std::size_t>(face)];
      tets[k++] = {14, corners[i], corners[(i + 1) % 4], 8 + face};
    }
  return tets;
}

/// Edges from the volume point to the three others.
Mat3 edges(const CellPoints& points, const Tetrahedron& tet) {
  Mat3 d;
  for (int i = 0; i < 3; ++i)
    d.col(i) = points[static_cast<std::size_t>(tet[static_cast<std::size_t>(i + 1)])] -
               points[static_cast<std::size_t>(tet[0])];
  return d;
}

/// Density of a deformation gradient, with derivatives by its nine entries.
struct Density {
  double energy = 0.0;
  Row9 gradient = Row9::Zero();
  Eigen::Matrix<double, 9, 9> hessian = Eigen::Matrix<double, 9, 9>::Zero();
};

void add_length(const Mat3& f, double weight, Density& out) {
  const Mat3 u = f - Mat3::Identity();
  out.energy += 0.5 * weight * u.squaredNorm();
  out.gradient += weight * u.reshaped();
  out.hessian.diagonal().array() += weight;
}

void add_area(const Mat3& f, double weight, Density& out) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 c = f.col(j).cross(f.col(k));  // a column of the cofactors
    const double over = c.squaredNorm() - 1.0;
    if (over <= 0.0) continue;
    out.energy += weight * over * over;
    Row9 g = Row9::Zero();  // of |c|^2
    g.segment<3>(3 * j) = 2.0 * f.col(k).cross(c);
    g.segment<3>(3 * k) = 2.0 * c.cross(f.col(j));
    out.gradient += 2.0 * weight * over * g;
    out.hessian += 2.0 * weight * g * g.transpose();
  }
}

/// False where the determinant is not positive.
bool add_volume(const Mat3& f, double weight, Density& out) {
  Mat3 cofactors;
  for (int i = 0; i < 3; ++i) cofactors.col(i) = f.col((i + 1) % 3).cross(f.col((i + 2) % 3));
  const double v = f.col(0).dot(cofactors.col(0));
  if (!(v > 0.0)) return false;
  const double q = (v - 1.0) * (v - 1.0) / v;  // = v - 2 + 1/v
  const double q1 = 1.0 - 1.0 / (v * v), q2 = 2.0 / (v * v * v);
  const Row9 g = cofactors.reshaped();
  out.energy += weight * q * q;
  out.gradient += 2.0 * weight * q * q1 * g;
  out.hessian += 2.0 * weight * (q1 * q1 + q * q2) * g * g.transpose();
  return true;
}

/// The tetrahedron's entries of F by its four points' coordinates: F = D D0^-1.
Eigen::Matrix<double, 9, 12> gradient_map(const Mat3& rest_inverse) {
  Eigen::Matrix<double, 9, 12> map = Eigen::Matrix<double, 9, 12>::Zero();
  for (int column = 0; column < 3; ++column)
    for (int point = 0; point < 3; ++point)
      for (int axis = 0; axis < 3; ++axis) {
        map(3 * column + axis, 3 * (point + 1) + axis) = rest_inverse(point, column);
        map(3 * column + axis, axis) -= rest_inverse(point, column);
      }
  return map;
}

/// What the cell is at rest, the same for all cells of a grid.
struct RestCell {
  explicit RestCell(const Vec3& cell_mm) : tetrahedron_mm3(cell_mm.prod() / 24.0) {
    std::array<Vec3, 8> corners;
    for (int c = 0; c < 8; ++c)
      corners[static_cast<std::size_t>(c)] = cell_mm.cwiseProduct(Vec3(c & 1, c >> 1 & 1, c >> 2 & 1));
    const CellPoints points = cell_points(corners);
    for (std::size_t t = 0; t < 24; ++t) inverse[t] = edges(points, cell_tetrahedra()[t]).inverse();
  }
  double tetrahedron_mm3;
  std::array<Mat3, 24> inverse;
};

/// Energy with derivatives by all 15 points.
struct PointEnergy {
  Eigen::Matrix<double, 45, 1> gradient = Eigen::Matrix<double, 45, 1>::Zero();
  Eigen::Matrix<double, 45, 45> hessian = Eigen::Matrix<double, 45, 45>::Zero();

  void add(const Tetrahedron& tet, const Density& density, const Mat3& rest_inverse, double volume,
           bool second) {
    const Eigen::Matrix<double, 9, 12> map = gradient_map(rest_inverse);
    const Eigen::Matrix<double, 12, 1> g = volume * map.transpose() * density.gradient;
    for (int i = 0; i < 4; ++i)
      gradient.segment<3>(3 * tet[static_cast<std::size_t>(i)]) += g.segment<3>(3 * i);
    if (!second) return;
    const Eigen::Matrix<double, 12, 12> h = volume * map.transpose() * density.hessian * map;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 4; ++k)
        hessian.block<3, 3>(3 * tet[static_cast<std::size_t>(i)], 3 * tet[static_cast<std::size_t>(k)]) +=
            h.block<3, 3>(3 * i, 3 * k);
  }
};

}  // namespace

const std::array<std::array<int, 4>, 24>& cell_tetrahedra() {
  static const std::array<Tetrahedron, 24> tets = made_tetrahedra();
  return tets;
}

CellEnergy cell_energy(const std::array<Vec3, 8>& corners, const Vec3& cell_mm,
                       const HyperelasticWeights& weights, Derivatives derivatives) {
  const RestCell rest(cell_mm);
  const CellPoints points = cell_points(corners);
  CellEnergy out;
  PointEnergy by_points;
  for (std::size_t t = 0; t < 24; ++t) {
    const Tetrahedron& tet = cell_tetrahedra()[t];
    const Mat3 f = edges(points, tet) * rest.inverse[t];
    Density density;
    add_length(f, weights.length, density);
    add_area(f, weights.area, density);
    if (!add_volume(f, weights.volume, density)) {
      out.energy = std::numeric_limits<double>::infinity();
      return out;
    }
    out.energy += rest.tetrahedron_mm3 * density.energy;
    if (derivatives != Derivatives::none)
      by_points.add(tet, density, rest.inverse[t], rest.tetrahedron_mm3, derivatives == Derivatives::second);
  }
  if (derivatives == Derivatives::none) return out;
  const PointMotion motion = point_motion(points);
  out.gradient = motion.transpose() * by_points.gradient;
  if (derivatives == Derivatives::second) out.hessian = motion.transpose() * by_points.hessian * motion;
  return out;
}

}  // namespace ostia::motion
