#include "ostia/motion/hyperelastic.h"

#include "inner_points.h"

#include <Eigen/LU>

#include <cmath>
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

/// Density of a deformation gradient, with derivatives by its nine entries. The second ones are `diagonal`
/// times the unit matrix plus a sum of squares: of the first `squares` vectors with themselves.
struct Density {
  double energy = 0.0;
  Row9 gradient = Row9::Zero();
  double diagonal = 0.0;
  std::array<Row9, 4> square;
  std::size_t squares = 0;
};

void add_length(const Mat3& f, double weight, Density& out) {
  const Mat3 u = f - Mat3::Identity();
  out.energy += 0.5 * weight * u.squaredNorm();
  out.gradient += weight * u.reshaped();
  out.diagonal += weight;
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
    out.square[out.squares++] = std::sqrt(2.0 * weight) * g;
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
  out.square[out.squares++] = std::sqrt(2.0 * weight * (q1 * q1 + q * q2)) * g;
  return true;
}

/// Derivatives by the points of one face's four tetrahedra, whose coordinates are together: the volume point,
/// the face's corners, the face point.
struct FaceEnergy {
  using Vector = Eigen::Matrix<double, 18, 1>;
  using Matrix = Eigen::Matrix<double, 18, 18>;
  Vector gradient = Vector::Zero();
  Matrix hessian = Matrix::Zero();

  /// The tetrahedron over the face's side `i`: points 0, 1 + i, 2 + i, 5. F is edges times `inverse`.
  void add(std::size_t i, const Density& density, const Mat3& inverse, double volume, bool second) {
    const std::array<Eigen::Index, 3> rows = {static_cast<Eigen::Index>(3 + 3 * i),
                                              static_cast<Eigen::Index>(3 + 3 * ((i + 1) % 4)), 15};
    const auto by_edges = [&](const Row9& by_f) {
      Mat3 out;  // a column for each edge
      out.noalias() = by_f.reshaped(3, 3).lazyProduct(inverse.transpose());
      return out;
    };
    const Mat3 g = volume * by_edges(density.gradient);
    for (std::size_t p = 0; p < 3; ++p) gradient.segment<3>(rows[p]) += g.col(static_cast<Eigen::Index>(p));
    gradient.head<3>() -= g.rowwise().sum();
    if (!second) return;
    const Mat3 length = volume * density.diagonal * inverse * inverse.transpose();
    std::array<Mat3, 4> square;
    for (std::size_t k = 0; k < density.squares; ++k)
      square[k] = std::sqrt(volume) * by_edges(density.square[k]);
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) {
        Mat3 h = length(p, q) * Mat3::Identity();
        for (std::size_t k = 0; k < density.squares; ++k)
          h += square[k].col(p) * square[k].col(q).transpose();
        add_block(rows[static_cast<std::size_t>(p)], rows[static_cast<std::size_t>(q)], h);
      }
  }

  /// The face point goes with its corners: what is left are derivatives by the first five points.
  void eliminate(const std::array<Mat3, 4>& motion, bool second) {
    Eigen::Matrix<double, 3, 12> by;
    for (Eigen::Index i = 0; i < 4; ++i) by.middleCols<3>(3 * i) = motion[static_cast<std::size_t>(i)];
    gradient.segment<12>(3) += by.transpose().lazyProduct(gradient.tail<3>());
    if (!second) return;
    // H + C by + by^T C^T with C = H_f + by^T H_ff / 2.
    Eigen::Matrix<double, 15, 3> half = hessian.topRightCorner<15, 3>();
    half.bottomRows<12>() += 0.5 * by.transpose().lazyProduct(hessian.bottomRightCorner<3, 3>());
    const Eigen::Matrix<double, 15, 12> added = half.lazyProduct(by);
    hessian.block<15, 12>(0, 3) += added;
    hessian.block<12, 15>(3, 0) += added.transpose();
  }

 private:
  /// Of two edges from the volume point, which moves them the other way.
  void add_block(Eigen::Index p, Eigen::Index q, const Mat3& h) {
    hessian.block<3, 3>(p, q) += h;
    hessian.block<3, 3>(0, q) -= h;
    hessian.block<3, 3>(p, 0) -= h;
    hessian.block<3, 3>(0, 0) += h;
  }
};

/// Derivatives by the corners and, apart, by the volume point.
struct CornerEnergy {
  Vec3 by_volume_point = Vec3::Zero();
  Mat3 volume_point_twice = Mat3::Zero();
  Eigen::Matrix<double, 24, 3> mixed = Eigen::Matrix<double, 24, 3>::Zero();

  void add(const FaceEnergy& face, const std::array<int, 4>& corners, bool second, CellEnergy& out) {
    by_volume_point += face.gradient.head<3>();
    for (Eigen::Index i = 0; i < 4; ++i)
      out.gradient.segment<3>(3 * corners[static_cast<std::size_t>(i)]) +=
          face.gradient.segment<3>(3 + 3 * i);
    if (!second) return;
    volume_point_twice += face.hessian.topLeftCorner<3, 3>();
    for (Eigen::Index i = 0; i < 4; ++i) {
      const Eigen::Index row = 3 * corners[static_cast<std::size_t>(i)];
      mixed.middleRows<3>(row) += face.hessian.block<3, 3>(3 + 3 * i, 0);
      for (Eigen::Index k = 0; k < 4; ++k)
        out.hessian.block<3, 3>(row, 3 * corners[static_cast<std::size_t>(k)]) +=
            face.hessian.block<3, 3>(3 + 3 * i, 3 + 3 * k);
    }
  }

  void eliminate(const Eigen::Matrix<double, 3, 24>& motion, bool second, CellEnergy& out) const {
    out.gradient += motion.transpose().lazyProduct(by_volume_point);
    if (!second) return;
    const Eigen::Matrix<double, 24, 3> half =
        mixed + 0.5 * motion.transpose().lazyProduct(volume_point_twice);
    const Eigen::Matrix<double, 24, 24> added = half.lazyProduct(motion);
    out.hessian += added + added.transpose();
  }
};

}  // namespace

const std::array<std::array<int, 4>, 24>& cell_tetrahedra() {
  static const std::array<Tetrahedron, 24> tets = made_tetrahedra();
  return tets;
}

ElasticCell::ElasticCell(const Vec3& cell_mm) : tetrahedron_mm3_(cell_mm.prod() / 24.0) {
  std::array<Vec3, 8> corners;
  for (int c = 0; c < 8; ++c)
    corners[static_cast<std::size_t>(c)] = cell_mm.cwiseProduct(Vec3(c & 1, c >> 1 & 1, c >> 2 & 1));
  const CellPoints points = cell_points(corners);
  for (std::size_t t = 0; t < 24; ++t) inverse_[t] = edges(points, cell_tetrahedra()[t]).inverse();
}

CellEnergy ElasticCell::energy(const std::array<Vec3, 8>& corners, const HyperelasticWeights& weights,
                               Derivatives derivatives) const {
  const CellPoints points = cell_points(corners);
  const bool first = derivatives != Derivatives::none, second = derivatives == Derivatives::second;
  CellEnergy out;
  InnerMotion motion;
  if (first) motion = inner_motion(points);
  CornerEnergy apart;
  for (std::size_t face = 0; face < 6; ++face) {
    FaceEnergy by_face;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t t = 4 * face + i;
      const Mat3 f = edges(points, cell_tetrahedra()[t]).lazyProduct(inverse_[t]);
      Density density;
      add_length(f, weights.length, density);
      add_area(f, weights.area, density);
      if (!add_volume(f, weights.volume, density)) {
        out.energy = std::numeric_limits<double>::infinity();
        return out;
      }
      out.energy += tetrahedron_mm3_ * density.energy;
      if (first) by_face.add(i, density, inverse_[t], tetrahedron_mm3_, second);
    }
    if (!first) continue;
    by_face.eliminate(motion.face[face], second);
    apart.add(by_face, cell_faces[face], second, out);
  }
  if (first) apart.eliminate(motion.volume, second, out);
  return out;
}

}  // namespace ostia::motion
