#include "image_cage.h"

#include "cancellable_solve.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/sampling.h"

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ostia::pipeline {

using geometry::CageGrid;
using geometry::CagePoint;
using geometry::Vec3;
using imaging::FloatVolume;
using Points = std::vector<Vec3>;

namespace {

struct Stage {
  int depth;
  double sigma_mm, reach_mm;  ///< blur; how far outside of the wall values are compared
};
// Far and blurred first: between two phases of twenty the right coronary artery goes 5 mm.
constexpr std::array<Stage, 7> stages{{{0, 4.0, 8.0},
                                       {1, 4.0, 8.0},
                                       {2, 2.5, 8.0},
                                       {3, 1.5, 5.0},
                                       {3, 0.8, 3.0},
                                       {4, 0.8, 3.0},
                                       {5, 0.8, 3.0}}};
// From the wall along its normal, mm: denser where the edge is.
constexpr std::array<double, 9> offsets_mm{-1.0, -0.4, 0.0, 0.4, 0.8, 1.6, 3.0, 5.0, 8.0};
constexpr std::size_t most_wall_points = 6000;
constexpr double image_margin_mm = 20.0;  // about what is looked for: further than a phase's step
// Of the cage, against the mean of the images' terms. A smooth tube does not tell how far it goes along
// itself: bending of the whole motion is what decides there, and linear motion costs nothing.
constexpr double bending = 1.0, stretching = 0.01;
constexpr double ridge = 1e-4;
constexpr int most_rounds = 8, most_halvings = 4;
constexpr double small_step_mm = 0.02;
constexpr double least_noise_hu = 5.0;
constexpr double huber = 1.5;            // deviations: beyond, differences count in proportion
constexpr double least_jacobian = 0.05;  // of a cell that a step may leave behind
constexpr double solver_tolerance = 1e-6;

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

double median_size(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<Eigen::Index>(a.size());
  if (n < 2) return 0.0;
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), n), y(b.data(), n);
  const Eigen::ArrayXd dx = x - x.mean(), dy = y - y.mean();
  const double size = std::sqrt(dx.square().sum() * dy.square().sum());
  return size > 0.0 ? (dx * dy).sum() / size : 0.0;
}

}  // namespace

FloatVolume part_about(const imaging::ImageVolume& image, const geometry::Box3& box, double margin_mm) {
  geometry::Box3 inside;
  for (int c = 0; c < 8; ++c)
    inside.extend(image.geometry.index(box.corner(static_cast<geometry::Box3::CornerType>(c))));
  imaging::Region region;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double margin = margin_mm / image.geometry.spacing[axis];
    const auto last = static_cast<double>(image.geometry.size[a]);
    region.lower[a] =
        static_cast<std::int64_t>(std::clamp(std::floor(inside.min()[axis] - margin), 0.0, last));
    region.upper[a] =
        static_cast<std::int64_t>(std::clamp(std::ceil(inside.max()[axis] + margin) + 1.0, 0.0, last));
    if (region.lower[a] >= region.upper[a]) return {};
  }
  const imaging::ImageVolume part = imaging::cropped(image, region);
  return {part.geometry, std::vector<float>(part.voxels.begin(), part.voxels.end())};
}

/// One level's least squares: displacements of its control points beyond where it began.
class ImageCage::Solver {
 public:
  Solver(const Level& level, const CageGrid& grid, const CageGrid& whole, const FloatVolume& image)
      : level_(level), grid_(grid), whole_(whole), image_(image) {}

  /// `control_points` of the whole grid, improved.
  void run(Points& control_points, const core::TaskContext& task) const {
    const Points begin = control_points;
    Points moved(grid_.point_count(), Vec3::Zero());
    std::vector<double> off = differences(begin);
    const double noise = std::max(least_noise_hu, 1.4826 * median_size(off));
    for (int round = 0; round < most_rounds; ++round) {
      task.throw_if_cancelled();
      const System system = system_of(begin, control_points, moved, off, noise);
      const Eigen::VectorXd step = solved(system.matrix, system.right, solver_tolerance, task);
      // Of the same springs before and after: their stiffness follows the images' terms, round by round.
      const double cost = cost_of(off, noise) + spring_energy(system.stiffness, begin, moved);
      double share = 1.0, taken = 0.0;
      bool better = false;
      for (int halving = 0; halving <= most_halvings && !better; ++halving, share *= 0.5) {
        Points next = moved;
        for (std::size_t p = 0; p < next.size(); ++p)
          next[p] += share * step.segment<3>(static_cast<Eigen::Index>(3 * p));
        Points places = added(begin, next);
        std::vector<double> now = differences(places);
        const double now_cost = cost_of(now, noise) + spring_energy(system.stiffness, begin, next);
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

  std::vector<double> values(const Points& control_points) const {
    std::vector<double> out(level_.places.size());
    core::parallel_for(out.size(), 1024, [&](std::size_t i) {
      out[i] = imaging::sample(image_, geometry::carried(whole_, level_.fine[i], control_points));
    });
    return out;
  }
  std::vector<double> differences(const Points& control_points) const {
    std::vector<double> out = values(control_points);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] -= level_.values[i];
    return out;
  }
  /// Huber's.
  static double cost_of(const std::vector<double>& off, double noise) {
    double sum = 0.0;
    for (const double one : off) {
      const double r = std::abs(one) / noise;
      sum += r <= huber ? r * r : huber * (2.0 * r - huber);
    }
    return sum;
  }

 private:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  struct System {
    Matrix matrix;
    Eigen::VectorXd right;
    double stiffness = 0.0;  ///< of the springs: the mean diagonal of the images' terms
  };
  struct CellTerms {
    Eigen::Matrix<double, 24, 24> hessian = Eigen::Matrix<double, 24, 24>::Zero();
    Eigen::Matrix<double, 24, 1> gradient = Eigen::Matrix<double, 24, 1>::Zero();
  };

  /// The cage `begin` with this level's displacements.
  Points added(const Points& begin, const Points& moved) const {
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

  CellTerms terms_of(std::size_t cell, const Points& control_points, const std::vector<double>& off,
                     double noise) const {
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

  /// Gauss-Newton's equations with springs between neighbouring control points.
  System system_of(const Points& begin, const Points& control_points, const Points& moved,
                   const std::vector<double>& off, double noise) const {
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
    for_springs(stiffness, begin, moved, [&](const Spring& spring, const Points& displaced) {
      add_spring(spring, displaced, entries, right);
    });
    Matrix matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return {std::move(matrix), std::move(right), stiffness};
  }

  /// A term `stiffness` |sum of factors times displacements|^2 / 2.
  struct Spring {
    std::array<std::int32_t, 3> points{};
    std::array<double, 3> factors{};
    double stiffness = 0.0;
  };
  static Vec3 sum_of(const Spring& one, const Points& displaced) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t p = 0; p < 3; ++p)
      sum += one.factors[p] * displaced[static_cast<std::size_t>(one.points[p])];
    return sum;
  }
  static void add_spring(const Spring& one, const Points& displaced,
                         std::vector<Eigen::Triplet<double>>& entries, Eigen::VectorXd& right) {
    const Vec3 sum = sum_of(one, displaced);
    for (std::size_t p = 0; p < 3; ++p)
      for (int a = 0; a < 3; ++a) {
        right[3 * one.points[p] + a] -= one.stiffness * one.factors[p] * sum[a];
        for (std::size_t q = 0; q < 3; ++q)
          entries.emplace_back(3 * one.points[p] + a, 3 * one.points[q] + a,
                               one.stiffness * one.factors[p] * one.factors[q]);
      }
  }

  /// The whole displacement at this level's control points.
  Points whole_displacement(const Points& begin, const Points& moved) const {
    Points out = moved;
    const int n = grid_.points_a_side(), every = whole_.cells / grid_.cells;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const std::int32_t p = whole_.point(every * i, every * j, every * k);
          out[static_cast<std::size_t>(grid_.point(i, j, k))] +=
              begin[static_cast<std::size_t>(p)] - whole_.place(p);
        }
    return out;
  }

  /// Twice that of all springs, as cost_of is twice that of the images' terms.
  double spring_energy(double stiffness, const Points& begin, const Points& moved) const {
    double sum = 0.0;
    for_springs(stiffness, begin, moved, [&](const Spring& spring, const Points& displaced) {
      sum += spring.stiffness * sum_of(spring, displaced).squaredNorm();
    });
    return sum;
  }

  /// Against bending of the whole displacement and stretching of this level's.
  template <class Take>
  void for_springs(double stiffness, const Points& begin, const Points& moved, const Take& take) const {
    const int n = grid_.points_a_side();
    const Points whole = whole_displacement(begin, moved);
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const std::array<int, 3> at{i, j, k};
          const std::int32_t p = grid_.point(i, j, k);
          take(Spring{{p, p, p}, {1.0, 0.0, 0.0}, ridge * stiffness}, moved);
          for (std::size_t a = 0; a < 3; ++a) {
            const std::int32_t step = a == 0 ? 1 : a == 1 ? n : n * n;
            if (at[a] + 1 < n)
              take(Spring{{p, p + step, p}, {-1.0, 1.0, 0.0}, stretching * stiffness}, moved);
            if (at[a] > 0 && at[a] + 1 < n)
              take(Spring{{p - step, p, p + step}, {1.0, -2.0, 1.0}, bending * stiffness}, whole);
          }
        }
  }

  const Level& level_;
  const CageGrid& grid_;
  const CageGrid& whole_;
  const FloatVolume& image_;
};

ImageCage::ImageCage(const geometry::TriMesh& shape, const imaging::ImageVolume& still, int depth,
                     double margin, const core::TaskContext& task) {
  for (int d = 0; d <= depth; ++d) grids_.push_back(geometry::cage_around(shape.points, d, margin));
  const Points normals = geometry::vertex_normals(shape);
  const std::size_t every = (shape.points.size() + most_wall_points - 1) / most_wall_points;
  const FloatVolume part = part_about(still, geometry::bounds(shape.points), image_margin_mm);
  for (std::size_t i = 0; i < shape.points.size(); i += every) points_.push_back(shape.points[i]);
  FloatVolume blurred;
  double sigma = -1.0;
  for (const Stage& stage : stages) {
    if (stage.depth > depth) continue;
    if (stage.sigma_mm != sigma) blurred = imaging::gaussian_blurred(part, stage.sigma_mm, task);
    sigma = stage.sigma_mm;
    Level level;
    level.depth = stage.depth;
    level.sigma_mm = sigma;
    const CageGrid& own = grids_[static_cast<std::size_t>(stage.depth)];
    level.of.resize(own.cell_count());
    for (const double offset : offsets_mm) {
      if (offset > stage.reach_mm) continue;
      for (std::size_t i = 0; i < shape.points.size(); i += every) {
        const Vec3 place = shape.points[i] + offset * normals[i];
        if (!part.geometry.contains(place)) continue;
        level.own.push_back(geometry::cage_point(own, place));
        level.fine.push_back(geometry::cage_point(grid(), place));
        level.of[level.own.back().cell].push_back(static_cast<std::int32_t>(level.places.size()));
        level.places.push_back(place);
        level.values.push_back(imaging::sample(blurred, place));
      }
    }
    levels_.push_back(std::move(level));
  }
}

ImageCageFit ImageCage::fitted(const imaging::ImageVolume& image, const std::vector<Points>& starts,
                               const core::TaskContext& task) const {
  ImageCageFit fit;
  fit.control_points = starts.front();
  geometry::Box3 box;
  for (const Points& start : starts)
    for (const Vec3& p : points_)
      box.extend(geometry::carried(grid(), geometry::cage_point(grid(), p), start));
  const FloatVolume part = part_about(image, box, image_margin_mm);
  if (part.voxels.empty() || levels_.front().places.empty()) return fit;
  FloatVolume blurred;
  double sigma = -1.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const Level& level = levels_[k];
    if (level.sigma_mm != sigma) blurred = imaging::gaussian_blurred(part, level.sigma_mm, task);
    sigma = level.sigma_mm;
    const Solver solver(level, grids_[static_cast<std::size_t>(level.depth)], grid(), blurred);
    for (const Points& start : starts) {
      if (k > 0) break;
      if (&start != &starts.front() && least_jacobian_of(grid(), start) < least_jacobian) continue;
      const double cost = Solver::cost_of(solver.differences(start), least_noise_hu);
      if (cost >= least) continue;
      least = cost;
      fit.control_points = start;
    }
    solver.run(fit.control_points, task);
    task.set_progress(static_cast<double>(k + 1) / static_cast<double>(levels_.size()));
    if (k + 1 == levels_.size()) fit.likeness = correlation(level.values, solver.values(fit.control_points));
  }
  std::size_t inside = 0;
  for (const Vec3& p : points_)
    inside += image.geometry.contains(
                  geometry::carried(grid(), geometry::cage_point(grid(), p), fit.control_points))
                  ? 1
                  : 0;
  fit.inside_share = static_cast<double>(inside) / static_cast<double>(points_.size());
  return fit;
}

}  // namespace ostia::pipeline
