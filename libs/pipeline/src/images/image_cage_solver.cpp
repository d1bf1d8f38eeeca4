#include "images/image_cage_solver.h"

#include "images/cancellable_solve.h"

#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ostia::pipeline {

using geometry::CageGrid;
using geometry::Vec3;
using Points = std::vector<Vec3>;

namespace {

constexpr int most_rounds = 8, most_halvings = 4;
constexpr double small_step_mm = 0.02;
constexpr double huber = 1.5;  // deviations: beyond, differences count in proportion
constexpr double solver_tolerance = 1e-6;

double median_size(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double least_jacobian_of(const CageGrid& grid, const Points& points) {
  return core::parallel_reduce(
      grid.cell_count(), 64, std::numeric_limits<double>::infinity(),
      [&](std::size_t first, std::size_t last) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t cell = first; cell < last; ++cell) {
          const geometry::CageCell numbers = grid.corners(cell);
          std::array<Vec3, 8> corners;
          for (std::size_t c = 0; c < 8; ++c) corners[c] = points[static_cast<std::size_t>(numbers[c])];
          least = std::min(least, geometry::jacobian_bounds(corners, grid.cell_mm)[0]);
        }
        return least;
      },
      [](double a, double b) { return std::min(a, b); });
}

ImageCageSolver::ImageCageSolver(const ImageCageLevel& level, const CageGrid& grid, const CageGrid& whole,
                                 const imaging::FloatVolume& image)
    : level_(level), grid_(grid), whole_(whole), image_(image), springs_(grid, whole) {}

void ImageCageSolver::run(Points& control_points, const core::TaskContext& task) const {
  const Points begin = control_points;
  Points moved(grid_.point_count(), Vec3::Zero());
  std::vector<double> off = differences(begin);
  const double noise = std::max(least_noise_hu, 1.4826 * median_size(off));
  for (int round = 0; round < most_rounds; ++round) {
    task.throw_if_cancelled();
    const System system = system_of(begin, control_points, moved, off, noise);
    const Eigen::VectorXd step = solved(system.matrix, system.right, solver_tolerance, task);
    // Of the same springs before and after: their stiffness follows the images' terms, round by round.
    const double cost = cost_of(off, noise) + springs_.energy(system.stiffness, begin, moved);
    double share = 1.0, taken = 0.0;
    bool better = false;
    for (int halving = 0; halving <= most_halvings && !better; ++halving, share *= 0.5) {
      Points next = moved;
      for (std::size_t p = 0; p < next.size(); ++p)
        next[p] += share * step.segment<3>(static_cast<Eigen::Index>(3 * p));
      Points places = added(begin, next);
      std::vector<double> now = differences(places);
      const double now_cost = cost_of(now, noise) + springs_.energy(system.stiffness, begin, next);
      if (now_cost >= cost || least_jacobian_of(whole_, places) < least_jacobian) continue;
      better = true;
      taken = share;
      moved = std::move(next);
      control_points = std::move(places);
      off = std::move(now);
    }
    if (!better || taken * step.cwiseAbs().maxCoeff() < small_step_mm) return;
  }
}

std::vector<double> ImageCageSolver::values(const Points& control_points) const {
  std::vector<double> out(level_.places.size());
  core::parallel_for(out.size(), 1024, [&](std::size_t i) {
    out[i] = imaging::sample(image_, geometry::carried(whole_, level_.fine[i], control_points));
  });
  return out;
}

std::vector<double> ImageCageSolver::differences(const Points& control_points) const {
  std::vector<double> out = values(control_points);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= level_.values[i];
  return out;
}

double ImageCageSolver::cost_of(const std::vector<double>& off, double noise) {
  double sum = 0.0;
  for (const double one : off) {
    const double r = std::abs(one) / noise;
    sum += r <= huber ? r * r : huber * (2.0 * r - huber);
  }
  return sum;
}

Points ImageCageSolver::added(const Points& begin, const Points& moved) const {
  CageGrid grid = grid_;
  Points points = geometry::rest_points(grid);
  for (std::size_t p = 0; p < points.size(); ++p) points[p] += moved[p];
  while (grid.cells < whole_.cells) {
    points = geometry::refined(grid, points);
    grid = geometry::refined(grid);
  }
  const Points rest = geometry::rest_points(whole_);
  for (std::size_t p = 0; p < points.size(); ++p) points[p] += begin[p] - rest[p];
  return points;
}

ImageCageSolver::CellTerms ImageCageSolver::terms_of(std::size_t cell, const Points& control_points,
                                                     const std::vector<double>& off, double noise) const {
  CellTerms terms;
  Eigen::Matrix<double, 24, 1> row;
  for (const std::int32_t place : level_.of[cell]) {
    const auto i = static_cast<std::size_t>(place);
    const Vec3 slope =
        imaging::sample_gradient(image_, geometry::carried(whole_, level_.fine[i], control_points)) / noise;
    const double r = off[i] / noise, weight = std::min(1.0, huber / std::max(1e-12, std::abs(r)));
    for (std::size_t c = 0; c < 8; ++c)
      row.segment<3>(static_cast<Eigen::Index>(3 * c)) = level_.own[i].weights[c] * slope;
    terms.hessian.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    terms.gradient += weight * r * row;
  }
  terms.hessian = terms.hessian.selfadjointView<Eigen::Lower>();
  return terms;
}

ImageCageSolver::System ImageCageSolver::system_of(const Points& begin, const Points& control_points,
                                                   const Points& moved, const std::vector<double>& off,
                                                   double noise) const {
  std::vector<CellTerms> terms(grid_.cell_count());
  core::parallel_for(terms.size(), 4, [&](std::size_t cell) {
    if (!level_.of[cell].empty()) terms[cell] = terms_of(cell, control_points, off, noise);
  });
  const auto size = static_cast<Eigen::Index>(3 * grid_.point_count());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  double trace = 0.0;
  std::vector<bool> seen(grid_.point_count(), false);
  for (std::size_t cell = 0; cell < terms.size(); ++cell) {
    if (level_.of[cell].empty()) continue;
    const geometry::CageCell numbers = grid_.corners(cell);
    const auto row = [&](int k) { return 3 * numbers[static_cast<std::size_t>(k / 3)] + k % 3; };
    for (int a = 0; a < 24; ++a) {
      seen[static_cast<std::size_t>(row(a) / 3)] = true;
      right[row(a)] -= terms[cell].gradient[a];
      trace += terms[cell].hessian(a, a);
      for (int b = 0; b < 24; ++b) entries.emplace_back(row(a), row(b), terms[cell].hessian(a, b));
    }
  }
  const auto known = static_cast<double>(std::max<std::ptrdiff_t>(1, std::ranges::count(seen, true)));
  const double stiffness = std::max(1e-9, trace / (3.0 * known));
  springs_.add(stiffness, begin, moved, entries, right);
  Matrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return {std::move(matrix), std::move(right), stiffness};
}

}  // namespace ostia::pipeline
