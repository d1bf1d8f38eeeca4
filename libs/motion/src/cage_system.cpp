#include "cage_system.h"

#include "ostia/core/parallel.h"

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::motion {
namespace {

using geometry::CageCell;
using geometry::Mat3;
using geometry::Vec3;

constexpr double solver_tolerance = 1e-4;
constexpr int follow_sweeps = 40;

/// Calls body(cell) for the cells between those of two points, and those that share a corner with them.
template <class Body>
void for_cells_about(const geometry::CageGrid& grid, const geometry::Box3& box, const Body& body) {
  const auto n = static_cast<std::uint32_t>(grid.cells);
  const std::uint32_t low = cage_point(grid, box.min()).cell, high = cage_point(grid, box.max()).cell;
  std::array<int, 3> from{}, to{};
  std::uint32_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis, stride *= n) {
    from[axis] = std::max(0, static_cast<int>(low / stride % n) - 1);
    to[axis] = std::min(grid.cells - 1, static_cast<int>(high / stride % n) + 1);
  }
  for (int k = from[2]; k <= to[2]; ++k)
    for (int j = from[1]; j <= to[1]; ++j)
      for (int i = from[0]; i <= to[0]; ++i)
        body(static_cast<std::size_t>(i + grid.cells * (j + grid.cells * k)));
}

}  // namespace

CageSystem::CageSystem(const geometry::CageGrid& grid, const geometry::TriMesh& surface_at_rest,
                       const CageCost& cost)
    : grid_(grid),
      cost_(cost),
      cell_(grid.cell_mm),
      solved_cell_(grid.cell_count(), -1),
      unknown_(grid.point_count(), -1) {
  std::vector<char> near(grid.cell_count(), 0);
  for (const geometry::Triangle& t : surface_at_rest.triangles) {
    geometry::Box3 box;
    for (const std::int32_t p : t) box.extend(surface_at_rest.points[static_cast<std::size_t>(p)]);
    for_cells_about(grid, box, [&](std::size_t cell) { near[cell] = 1; });
  }
  for (std::size_t cell = 0; cell < near.size(); ++cell) {
    if (near[cell] == 0) continue;
    solved_cell_[cell] = static_cast<std::int32_t>(cells_.size());
    cells_.push_back(static_cast<std::uint32_t>(cell));
    for (const std::int32_t p : grid.corners(cell)) unknown_[static_cast<std::size_t>(p)] = 0;
  }
  for (std::int32_t& u : unknown_)
    if (u == 0) u = static_cast<std::int32_t>(unknowns_++);
}

std::array<Vec3, 8> CageSystem::corners(std::size_t cell, const std::vector<Vec3>& points) const {
  std::array<Vec3, 8> corners;
  const CageCell numbers = grid_.corners(cell);
  for (std::size_t c = 0; c < 8; ++c) corners[c] = points[static_cast<std::size_t>(numbers[c])];
  return corners;
}

CageSystem::Cells CageSystem::pairs_of_cells(const std::vector<SurfacePair>& pairs) const {
  Cells cells(cells_.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].weight > 0.0)
      cells[static_cast<std::size_t>(solved_cell_[pairs[i].source.cell])].push_back(
          static_cast<std::uint32_t>(i));
  return cells;
}

CellEnergy CageSystem::whole_cell(std::size_t solved, const std::vector<Vec3>& points,
                                  const std::vector<SurfacePair>& pairs,
                                  const std::vector<std::uint32_t>& own, Derivatives derivatives) const {
  const std::array<Vec3, 8> at = corners(cells_[solved], points);
  CellEnergy out;
  if (cost_.elastic) out = cell_.energy(at, cost_.energy, derivatives);
  for (const std::uint32_t i : own) {
    const SurfacePair& pair = pairs[i];
    Vec3 off = -pair.target;
    for (std::size_t c = 0; c < 8; ++c) off += pair.source.weights[c] * at[c];
    const double weight = cost_.data_weight * pair.weight;
    const Mat3 metric = weight * ((1.0 - cost_.point_share) * pair.normal * pair.normal.transpose() +
                                  cost_.point_share * Mat3::Identity());
    const Vec3 force = metric * off;
    out.energy += 0.5 * off.dot(force);
    if (derivatives == Derivatives::none) continue;
    for (std::size_t c = 0; c < 8; ++c) {
      const auto row = static_cast<Eigen::Index>(3 * c);
      out.gradient.segment<3>(row) += pair.source.weights[c] * force;
      if (derivatives == Derivatives::second)
        for (std::size_t d = 0; d < 8; ++d)
          out.hessian.block<3, 3>(row, static_cast<Eigen::Index>(3 * d)) +=
              pair.source.weights[c] * pair.source.weights[d] * metric;
    }
  }
  return out;
}

double CageSystem::energy(const std::vector<Vec3>& points, const std::vector<SurfacePair>& pairs) const {
  const Cells own = pairs_of_cells(pairs);
  return core::parallel_reduce(
      cells_.size(), 16, 0.0,
      [&](std::size_t first, std::size_t last) {
        double sum = 0.0;
        for (std::size_t i = first; i < last; ++i)
          sum += whole_cell(i, points, pairs, own[i], Derivatives::none).energy;
        return sum;
      },
      [](double a, double b) { return a + b; });
}

std::vector<Vec3> CageSystem::gradient(const std::vector<Vec3>& points,
                                       const std::vector<SurfacePair>& pairs) const {
  const Cells own = pairs_of_cells(pairs);
  std::vector<Eigen::Matrix<double, 24, 1>> by_cells(cells_.size());
  core::parallel_for(cells_.size(), 16, [&](std::size_t i) {
    by_cells[i] = whole_cell(i, points, pairs, own[i], Derivatives::first).gradient;
  });
  std::vector<Vec3> gradient(points.size(), Vec3::Zero());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const CageCell numbers = grid_.corners(cells_[i]);
    for (std::size_t c = 0; c < 8; ++c)
      gradient[static_cast<std::size_t>(numbers[c])] +=
          by_cells[i].segment<3>(static_cast<Eigen::Index>(3 * c));
  }
  return gradient;
}

double CageSystem::greatest_curvature(const std::vector<SurfacePair>& pairs) const {
  std::vector<double> sums(grid_.point_count(), 0.0);  // a row's, since a point's weights add up to 1
  for (const SurfacePair& pair : pairs) {
    const CageCell numbers = grid_.corners(pair.source.cell);
    for (std::size_t c = 0; c < 8; ++c)
      sums[static_cast<std::size_t>(numbers[c])] += cost_.data_weight * pair.weight * pair.source.weights[c];
  }
  const double greatest = *std::max_element(sums.begin(), sums.end());
  return greatest > 0.0 ? greatest : 1.0;
}

std::vector<Vec3> CageSystem::step(const std::vector<Vec3>& points,
                                   const std::vector<SurfacePair>& pairs) const {
  const Cells own = pairs_of_cells(pairs);
  std::vector<CellEnergy> energies(cells_.size());
  core::parallel_for(cells_.size(), 16, [&](std::size_t i) {
    energies[i] = whole_cell(i, points, pairs, own[i], Derivatives::second);
  });
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(cells_.size() * 576);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * unknowns_));
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const CageCell numbers = grid_.corners(cells_[i]);
    const auto row = [&](int k) {
      return 3 * unknown_[static_cast<std::size_t>(numbers[static_cast<std::size_t>(k / 3)])] + k % 3;
    };
    for (int a = 0; a < 24; ++a) {
      gradient[row(a)] += energies[i].gradient[a];
      for (int b = 0; b < 24; ++b) entries.emplace_back(row(a), row(b), energies[i].hessian(a, b));
    }
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(gradient.size(), gradient.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(solver_tolerance);
  solver.compute(matrix);
  const Eigen::VectorXd solution = solver.solve(-gradient);
  std::vector<Vec3> step(points.size(), Vec3::Zero());
  for (std::size_t p = 0; p < points.size(); ++p)
    if (unknown_[p] >= 0) step[p] = solution.segment<3>(3 * unknown_[p]);
  return step;
}

void CageSystem::follow(std::vector<Vec3>& points) const {
  if (unknowns_ == points.size()) return;
  const int n = grid_.points_a_side();
  const auto displacement = [&](int i, int j, int k) -> Vec3 {
    const std::int32_t p = grid_.point(i, j, k);
    return points[static_cast<std::size_t>(p)] - grid_.place(p);
  };
  for (int sweep = 0; sweep < follow_sweeps; ++sweep)
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const std::int32_t p = grid_.point(i, j, k);
          if (unknown_[static_cast<std::size_t>(p)] >= 0) continue;
          Vec3 sum = Vec3::Zero();
          int count = 0;
          const int at[3] = {i, j, k};
          for (int axis = 0; axis < 3; ++axis)
            for (const int by : {-1, 1}) {
              int next[3] = {i, j, k};
              next[axis] = at[axis] + by;
              if (next[axis] < 0 || next[axis] >= n) continue;
              sum += displacement(next[0], next[1], next[2]);
              ++count;
            }
          points[static_cast<std::size_t>(p)] = grid_.place(p) + sum / count;
        }
}

double CageSystem::least_jacobian(const std::vector<Vec3>& points) const {
  return core::parallel_reduce(
      grid_.cell_count(), 64, std::numeric_limits<double>::infinity(),
      [&](std::size_t first, std::size_t last) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t cell = first; cell < last; ++cell)
          least = std::min(least, geometry::jacobian_bounds(corners(cell, points), grid_.cell_mm)[0]);
        return least;
      },
      [](double a, double b) { return std::min(a, b); });
}

}  // namespace ostia::motion
