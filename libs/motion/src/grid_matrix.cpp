#include "grid_matrix.h"

#include "ostia/core/parallel.h"

#include <Eigen/LU>

namespace ostia::motion {
namespace {

using geometry::Mat3;
using geometry::Vec3;
using Vector = std::vector<Vec3>;

constexpr std::size_t grain = 128;

double sum(double a, double b) {
  return a + b;
}

double dot(const Vector& a, const Vector& b) {
  double total = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) total += a[i].dot(b[i]);
  return total;
}

/// out = matrix x; returns x . out.
double multiply(const GridMatrix& matrix, const Vector& x, Vector& out) {
  return core::parallel_reduce(
      x.size(), grain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double total = 0.0;
        for (std::size_t i = first; i < last; ++i) {
          Vec3 row = Vec3::Zero();
          const Mat3* blocks = &matrix.blocks[GridMatrix::row_blocks * i];
          for (std::size_t k = 0; k < GridMatrix::row_blocks; ++k) {
            const std::int32_t n = matrix.neighbours[i][k];
            if (n >= 0) row += blocks[k] * x[static_cast<std::size_t>(n)];
          }
          out[i] = row;
          total += x[i].dot(row);
        }
        return total;
      },
      sum);
}

}  // namespace

GridMatrix::GridMatrix(const std::vector<std::array<std::int32_t, row_blocks>>& neighbours_of_unknowns)
    : neighbours(neighbours_of_unknowns), blocks(row_blocks * neighbours.size(), Mat3::Zero()) {}

Vector solved(const GridMatrix& matrix, const Vector& right, double tolerance, int most) {
  const std::size_t n = right.size();
  Vector x(n, Vec3::Zero()), residual = right, better(n), direction(n), image(n);
  std::vector<Mat3> inverse(n);
  for (std::size_t i = 0; i < n; ++i)
    inverse[i] = matrix.blocks[GridMatrix::row_blocks * i + GridMatrix::diagonal].inverse();
  const auto improve = [&] {
    for (std::size_t i = 0; i < n; ++i) better[i] = inverse[i] * residual[i];
  };
  const double enough = tolerance * tolerance * dot(right, right);
  improve();
  direction = better;
  double slope = dot(residual, better);
  for (int step = 0; step < most && dot(residual, residual) > enough; ++step) {
    const double curvature = multiply(matrix, direction, image);
    if (!(curvature > 0.0)) break;
    const double length = slope / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += length * direction[i];
      residual[i] -= length * image[i];
    }
    improve();
    const double next = dot(residual, better), share = next / slope;
    slope = next;
    for (std::size_t i = 0; i < n; ++i) direction[i] = better[i] + share * direction[i];
  }
  return x;
}

}  // namespace ostia::motion
