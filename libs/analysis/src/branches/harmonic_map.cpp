#include "branches/harmonic_map.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::analysis {
namespace {

using geometry::TriMesh;
using geometry::Vec3;
using BorderLoop = std::vector<std::int32_t>;

// Level lines for each half width of the tube, as VMTK takes them, and no more than so many.
constexpr double levels_of_width = 10.0;
constexpr int least_levels = 4, most_levels = 1000;
// Near a border that is askew level lines follow it; they count from twice as far as it is deep.
constexpr double border_gap = 2.0;

double corner_cotangent(const Vec3& a, const Vec3& corner, const Vec3& b) {
  const double sine = (a - corner).cross(b - corner).norm();
  return (a - corner).dot(b - corner) / std::max(sine, 1e-12);
}

Eigen::SparseMatrix<double> laplacian(const TriMesh& mesh) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const geometry::Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const auto point = [&](std::int32_t i) { return mesh.points[static_cast<std::size_t>(i)]; };
      const double weight = 0.5 * corner_cotangent(point(a), point(t[k]), point(b));
      for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
        entries.emplace_back(i, j, -weight);
        entries.emplace_back(i, i, weight);
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(mesh.points.size());
  Eigen::SparseMatrix<double> out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Fixed values are those that are not negative. Empty where there is no solution.
std::vector<double> solved_laplace(const TriMesh& mesh, std::vector<double> values) {
  std::vector<Eigen::Index> unknown(values.size(), -1);
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] < 0.0) unknown[i] = count++;
  const Eigen::SparseMatrix<double> all = laplacian(mesh);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (int column = 0; column < all.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(all, column); it; ++it) {
      const auto row = static_cast<std::size_t>(it.row()), col = static_cast<std::size_t>(it.col());
      if (unknown[row] < 0) continue;
      if (unknown[col] >= 0)
        entries.emplace_back(unknown[row], unknown[col], it.value());
      else
        right[unknown[row]] -= it.value() * values[col];
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return {};
  const Eigen::VectorXd solution = solver.solve(right);
  if (!solution.allFinite()) return {};
  for (std::size_t i = 0; i < values.size(); ++i)
    if (unknown[i] >= 0) values[i] = std::clamp(solution[unknown[i]], 0.0, 1.0);
  return values;
}

struct MetricRange {
  double least = INFINITY, most = -INFINITY;
  double width() const { return most - least; }
};
MetricRange range_of(const BorderLoop& loop, const std::vector<double>& metric) {
  MetricRange range;
  for (const std::int32_t i : loop) {
    range.least = std::min(range.least, metric[static_cast<std::size_t>(i)]);
    range.most = std::max(range.most, metric[static_cast<std::size_t>(i)]);
  }
  return range;
}

double mean_of(const BorderLoop& loop, const std::vector<double>& metric) {
  double sum = 0.0;
  for (const std::int32_t i : loop) sum += metric[static_cast<std::size_t>(i)];
  return sum / static_cast<double>(loop.size());
}

struct LevelLine {
  double length = 0.0, metric = 0.0;  ///< and its integral
  geometry::Box3 box;
};
LevelLine level_line(const TriMesh& mesh, const std::vector<double>& values,
                     const std::vector<double>& metric, double level) {
  LevelLine out;
  for (const geometry::Triangle& t : mesh.triangles) {
    std::array<Vec3, 2> ends;
    std::array<double, 2> at{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      if ((values[a] < level) == (values[b] < level) || count == 2) continue;
      const double s = (level - values[a]) / (values[b] - values[a]);
      ends[count] = mesh.points[a] + s * (mesh.points[b] - mesh.points[a]);
      at[count++] = metric[a] + s * (metric[b] - metric[a]);
    }
    if (count != 2) continue;
    const double length = (ends[1] - ends[0]).norm();
    out.length += length;
    out.metric += 0.5 * length * (at[0] + at[1]);
    out.box.extend(ends[0]);
    out.box.extend(ends[1]);
  }
  return out;
}

/// Levels and the mean metric on each, ascending.
std::vector<std::pair<double, double>> stretching(const TriMesh& mesh, const std::vector<double>& harmonic,
                                                  const std::vector<double>& metric, const BorderLoop& first,
                                                  const BorderLoop& last) {
  const MetricRange begin = range_of(first, metric), end = range_of(last, metric);
  const LevelLine half = level_line(mesh, harmonic, metric, 0.5);
  const double width = half.length > 0.0 ? 0.5 * half.box.diagonal().norm() : 1.0;
  const double wanted = levels_of_width * std::abs(end.most - begin.least) / std::max(width, 1e-9);
  const int levels = static_cast<int>(std::clamp<double>(wanted, least_levels, most_levels));
  const double from = begin.least + border_gap * begin.width(), to = end.most - border_gap * end.width();
  std::vector<std::pair<double, double>> steps{{0.0, begin.least}};
  for (int i = 1; i < levels; ++i) {
    const double level = static_cast<double>(i) / levels;
    const LevelLine line = level_line(mesh, harmonic, metric, level);
    const double mean = line.length > 0.0 ? line.metric / line.length : from - 1.0;
    if (mean >= from && mean <= to) steps.emplace_back(level, mean);
  }
  steps.emplace_back(1.0, end.most);
  return steps;
}

}  // namespace

HarmonicMap harmonic_map(const TriMesh& tube, const std::vector<double>& metric) {
  std::vector<BorderLoop> loops;
  try {
    loops = geometry::boundary_loops(tube);
  } catch (const GeometryError&) {
    return {};  // borders that touch
  }
  const std::vector<std::int32_t> pieces = geometry::components(tube);
  if (loops.size() != 2 || pieces.empty() || *std::max_element(pieces.begin(), pieces.end()) > 0) return {};
  if (mean_of(loops[0], metric) > mean_of(loops[1], metric)) std::swap(loops[0], loops[1]);
  std::vector<double> values(tube.points.size(), -1.0);
  for (std::size_t l = 0; l < 2; ++l)
    for (const std::int32_t i : loops[l]) values[static_cast<std::size_t>(i)] = static_cast<double>(l);
  HarmonicMap out{solved_laplace(tube, std::move(values)), {}};
  if (out.harmonic.empty()) return {};
  const auto steps = stretching(tube, out.harmonic, metric, loops[0], loops[1]);
  for (const double value : out.harmonic) {
    const auto after =
        std::lower_bound(steps.begin() + 1, steps.end() - 1, std::pair<double, double>(value, -HUGE_VAL));
    const auto before = after - 1;
    const double t = (value - before->first) / (after->first - before->first);
    out.stretched_mm.push_back(before->second + t * (after->second - before->second));
  }
  return out;
}

}  // namespace ostia::analysis
