#include "interpolation/interpolation_system.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::lumen {
namespace {

using core::cut_text;

constexpr double tolerance_mm = 1e-7;
constexpr double enough_mm = 1e-12;
constexpr int refinements = 4;

struct RightSide {
  Eigen::VectorXd h;
  Eigen::MatrixXd p;  // of the linear far field, about the centre of the places, in units of 10 mm
  Vec3 centre = Vec3::Zero();
};
constexpr double unit_mm = 10.0;

RightSide right_side(const std::vector<Constraint>& constraints, const InterpolationOptions& options) {
  const auto n = static_cast<Eigen::Index>(constraints.size());
  RightSide side;
  side.h.resize(n);
  const bool linear = options.far_field == FarField::linear;
  for (Eigen::Index i = 0; i < n; ++i)
    side.h[i] = constraints[static_cast<std::size_t>(i)].value - (linear ? 0.0 : options.offset_mm);
  if (!linear) return side;
  for (const Constraint& constraint : constraints) side.centre += constraint.place / static_cast<double>(n);
  side.p.resize(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 from_centre = (constraints[static_cast<std::size_t>(i)].place - side.centre) / unit_mm;
    side.p.row(i) << 1.0, from_centre.x(), from_centre.y(), from_centre.z();
  }
  return side;
}

// What the triangle and its factor would take, from some rows: a row of the factor reaches back to its first
// neighbour in the order along the vessel.
void refuse_what_does_not_fit(const std::vector<Constraint>& constraints, const InterpolationOptions& options,
                              const FactorLimits& limits) {
  const double reach2 = options.support_radius_mm * options.support_radius_mm;
  const std::size_t step = std::max<std::size_t>(1, constraints.size() / 64);
  double entries = 0.0, filled = 0.0, operations = 0.0, rows = 0.0;
  for (std::size_t i = step / 2; i < constraints.size(); i += step, ++rows) {
    std::size_t first = i;
    for (std::size_t j = i; j-- > 0;) {
      if ((constraints[j].place - constraints[i].place).squaredNorm() >= reach2) continue;
      ++entries;
      first = j;
    }
    const auto width = static_cast<double>(i - first + 1);
    filled += width;
    operations += width * width;
  }
  const double scale = static_cast<double>(constraints.size()) / std::max(1.0, rows);
  // An entry of the triangle is held twice while it is made: 12 + 16 bytes.
  const double bytes = scale * (28.0 * entries + 8.0 * filled);
  if (bytes <= limits.memory_bytes && scale * operations <= limits.operations) return;
  throw ResourceError("the system of a wall with " + std::to_string(constraints.size()) +
                      " constraints fills up: with a support radius of " +
                      cut_text(options.support_radius_mm, 2) + " mm it would take about " +
                      cut_text(bytes / (1 << 20), 2) + " MiB and " + cut_text(1e-9 * scale * operations, 2) +
                      "e9 operations (limits " + cut_text(limits.memory_bytes / (1 << 20), 2) + " and " +
                      cut_text(1e-9 * limits.operations, 2) +
                      "e9); reduce the support radius or the number of samples");
}

}  // namespace

SymmetricMatrix interpolation_matrix(const std::vector<Constraint>& constraints,
                                     const InterpolationOptions& options, const FactorLimits& limits) {
  refuse_what_does_not_fit(constraints, options, limits);
  const double alpha = options.support_radius_mm;
  PointGrid grid(std::clamp(0.5 * alpha, 0.25, 5.0));
  // From the last to the first, so that the grid holds the rows below the diagonal.
  std::vector<std::vector<std::pair<std::int32_t, double>>> columns(constraints.size());
  std::size_t stored = constraints.size();
  for (std::size_t i = constraints.size(); i-- > 0;) {
    auto& column = columns[i];
    grid.near(constraints[i].place, alpha,
              [&](std::int32_t j, const Vec3&, double d2) { column.emplace_back(j, d2); });
    std::sort(column.begin(), column.end());
    for (auto& [j, d2] : column) {
      if (d2 < 1e-16)
        throw InvalidInput("two constraints of the wall fall on one place at " +
                           cut_text(constraints[i].s_mm, 2) +
                           " mm along the vessel; remove one of the samples there");
      d2 = phi(options.kernel, std::sqrt(d2) / alpha);
    }
    stored += column.size();
    grid.insert(static_cast<std::int32_t>(i), constraints[i].place);
  }
  SymmetricMatrix matrix;
  matrix.size = static_cast<int>(constraints.size());
  matrix.row.reserve(stored);
  matrix.value.reserve(stored);
  matrix.column_start.push_back(0);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    matrix.row.push_back(static_cast<int>(i));
    matrix.value.push_back(1.0);
    for (const auto& [j, value] : columns[i]) {
      matrix.row.push_back(j);
      matrix.value.push_back(value);
    }
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  return matrix;
}

Solution solve_system(const std::vector<Constraint>& constraints, const InterpolationOptions& options,
                      const MatrixAction& inverse, const MatrixAction& forward) {
  const RightSide side = right_side(constraints, options);
  const bool linear = side.p.cols() > 0;
  Eigen::MatrixXd inverse_p;
  Eigen::LLT<Eigen::Matrix4d> schur;
  if (linear) {
    inverse_p = inverse(side.p);
    schur.compute(side.p.transpose() * inverse_p);
    if (schur.info() != Eigen::Success)
      throw NumericalError(
          "the linear far field of a wall is not determined: its samples lie in a plane; choose "
          "the constant far field");
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(side.h.size());
  Eigen::Vector4d q = Eigen::Vector4d::Zero();
  Eigen::VectorXd residual = side.h;
  double worst = residual.lpNorm<Eigen::Infinity>();
  for (int round = 0; round <= refinements && !(worst < enough_mm); ++round) {
    Eigen::VectorXd step = inverse(residual);
    Eigen::Vector4d q_step = Eigen::Vector4d::Zero();
    if (linear) {
      // P^T c = 0 of all the weights, not of the step alone.
      q_step = schur.solve(side.p.transpose() * (weights + step));
      step -= inverse_p * q_step;
    }
    const Eigen::VectorXd tried = weights + step;
    Eigen::VectorXd left = side.h - forward(tried);
    if (linear) left -= side.p * (q + q_step);
    const double now = left.lpNorm<Eigen::Infinity>();
    if (!(now < worst)) break;
    weights = tried;
    q += q_step;
    residual = left;
    worst = now;
  }
  if (!(worst <= tolerance_mm))
    throw NumericalError("the system of a wall is solved to " + std::to_string(worst * 1e6) +
                         " nm only, which is more than " + std::to_string(tolerance_mm * 1e6) +
                         " nm: samples contradict each other or lie too near; remove some");
  Solution solution;
  solution.weights = weights;
  solution.residual = worst;
  if (linear) {
    const Vec3 slope = q.tail<3>() / unit_mm;
    solution.polynomial = {q[0] - slope.dot(side.centre), slope.x(), slope.y(), slope.z()};
  } else {
    solution.polynomial = {options.offset_mm, 0.0, 0.0, 0.0};
  }
  return solution;
}

ImplicitSurface surface_of(const std::vector<Constraint>& constraints, const InterpolationOptions& options,
                           const Solution& solution) {
  ImplicitCoefficients coefficients;
  coefficients.kernel = options.kernel;
  coefficients.support_radius_mm = options.support_radius_mm;
  coefficients.polynomial = solution.polynomial;
  coefficients.centres.reserve(constraints.size());
  for (const Constraint& constraint : constraints) coefficients.centres.push_back(constraint.place);
  coefficients.weights.assign(solution.weights.begin(), solution.weights.end());
  return ImplicitSurface(std::move(coefficients));
}

}  // namespace ostia::lumen
