#include "cage_system.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::motion {
namespace {

using geometry::CageCell;
using geometry::Mat3;
using geometry::Vec3;

constexpr double solver_tolerance = 1e-4;
constexpr int most_solver_steps = 2000;
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

/// Of a cell's corner `c` with its corner `d`.
std::size_t block_between(std::size_t c, std::size_t d) {
  const auto step = [&](unsigned axis) {
    return static_cast<int>(d >> axis & 1U) - static_cast<int>(c >> axis & 1U);
  };
  return block_at(step(0), step(1), step(2));
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
  find_neighbours();
}

void CageSystem::find_neighbours() {
  cells_about_.resize(unknowns_);
  neighbours_.resize(unknowns_);
  for (auto& cells : cells_about_) cells.fill(-1);
  for (auto& row : neighbours_) row.fill(-1);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const CageCell numbers = grid_.corners(cells_[i]);
    for (std::size_t c = 0; c < 8; ++c) {
      const auto row = static_cast<std::size_t>(unknown_[static_cast<std::size_t>(numbers[c])]);
      cells_about_[row][c] = static_cast<std::int32_t>(i);
      for (std::size_t d = 0; d < 8; ++d)
        neighbours_[row][block_between(c, d)] = unknown_[static_cast<std::size_t>(numbers[d])];
    }
  }
  const int n = grid_.points_a_side();
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(unknown_.size()); ++p) {
    if (unknown_[static_cast<std::size_t>(p)] >= 0) continue;
    Follower follower;
    follower.point = p;
    std::int32_t stride = 1;
    for (int axis = 0; axis < 3; ++axis, stride *= n) {
      const int at = p / stride % n;
      if (at > 0) follower.beside[static_cast<std::size_t>(follower.count++)] = p - stride;
      if (at < n - 1) follower.beside[static_cast<std::size_t>(follower.count++)] = p + stride;
    }
    followers_.push_back(follower);
  }
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
  const double along = cost_.data_weight * (1.0 - cost_.point_share);
  const double all_ways = cost_.data_weight * cost_.point_share;
  Eigen::Matrix<double, 8, 8> products = Eigen::Matrix<double, 8, 8>::Zero();  // the same along each axis
  for (const std::uint32_t i : own) {
    const SurfacePair& pair = pairs[i];
    Vec3 off = -pair.target;
    for (std::size_t c = 0; c < 8; ++c) off += pair.source.weights[c] * at[c];
    const double height = pair.normal.dot(off);
    const Vec3 force = pair.weight * (along * height * pair.normal + all_ways * off);
    out.energy += 0.5 * off.dot(force);
    if (derivatives == Derivatives::none) continue;
    const Eigen::Map<const Eigen::Matrix<double, 8, 1>> weights(pair.source.weights.data());
    out.gradient += (force * weights.transpose()).reshaped();
    if (derivatives != Derivatives::second) continue;
    const Eigen::Matrix<double, 24, 1> lever = (pair.normal * weights.transpose()).reshaped();
    out.hessian.noalias() += (along * pair.weight * lever) * lever.transpose();
    products.noalias() += (all_ways * pair.weight * weights) * weights.transpose();
  }
  if (derivatives == Derivatives::second)
    for (Eigen::Index c = 0; c < 8; ++c)
      for (Eigen::Index d = 0; d < 8; ++d)
        out.hessian.block<3, 3>(3 * c, 3 * d).diagonal().array() += products(c, d);
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
  GridMatrix matrix(neighbours_);
  std::vector<Vec3> force(unknowns_, Vec3::Zero());
  core::parallel_for(unknowns_, 64, [&](std::size_t row) {
    for (std::size_t c = 0; c < 8; ++c) {
      const std::int32_t cell = cells_about_[row][c];
      if (cell < 0) continue;
      const CellEnergy& one = energies[static_cast<std::size_t>(cell)];
      const auto at = static_cast<Eigen::Index>(3 * c);
      force[row] -= one.gradient.segment<3>(at);
      for (std::size_t d = 0; d < 8; ++d)
        matrix.blocks[GridMatrix::row_blocks * row + block_between(c, d)] +=
            one.hessian.block<3, 3>(at, static_cast<Eigen::Index>(3 * d));
    }
  });
  const std::vector<Vec3> solution = solved(matrix, force, solver_tolerance, most_solver_steps);
  std::vector<Vec3> step(points.size(), Vec3::Zero());
  for (std::size_t p = 0; p < points.size(); ++p)
    if (unknown_[p] >= 0) step[p] = solution[static_cast<std::size_t>(unknown_[p])];
  return step;
}

void CageSystem::follow(std::vector<Vec3>& points) const {
  if (followers_.empty()) return;
  std::vector<Vec3> displacements(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    displacements[i] = points[i] - grid_.place(static_cast<std::int32_t>(i));
  for (int sweep = 0; sweep < follow_sweeps; ++sweep)
    for (const Follower& one : followers_) {
      Vec3 sum = Vec3::Zero();
      for (int k = 0; k < one.count; ++k)
        sum += displacements[static_cast<std::size_t>(one.beside[static_cast<std::size_t>(k)])];
      displacements[static_cast<std::size_t>(one.point)] = sum / one.count;
    }
  for (const Follower& one : followers_) {
    const auto p = static_cast<std::size_t>(one.point);
    points[p] = grid_.place(one.point) + displacements[p];
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
