// The solid's surface: the indicator function on a grid about the points, and its zero set there.
#include "ostia/meshing/poisson_surface.h"

#include "poisson/poisson_function.h"

#include "ostia/core/error.h"
#include "ostia/geometry/isosurface.h"
#include "ostia/geometry/mesh_topology.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace ostia::meshing {
namespace {

using geometry::Box3;
using geometry::Vec3;
using Node = std::array<std::int64_t, 3>;

void require_samples(const std::vector<Vec3>& points, const std::vector<Vec3>& normals) {
  if (points.size() != normals.size())
    throw InvalidInput("Poisson surface: " + std::to_string(normals.size()) + " normals for " +
                       std::to_string(points.size()) + " points; one a point is needed");
  if (points.size() < 4)
    throw InvalidInput("Poisson surface: " + std::to_string(points.size()) +
                       " points, a solid has at least 4");
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || !normals[i].allFinite())
      throw InvalidInput("Poisson surface: point " + std::to_string(i) + " or its normal is not finite");
    if (!(normals[i].norm() > 0.0))
      throw InvalidInput("Poisson surface: the normal of point " + std::to_string(i) + " has no length");
    mean += points[i] / static_cast<double>(points.size());
  }
  geometry::Mat3 spread = geometry::Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  const Vec3 extents = Eigen::SelfAdjointEigenSolver<geometry::Mat3>(spread).eigenvalues();
  if (!(extents[0] > 1e-12 * extents[2]))
    throw InvalidInput("Poisson surface: the points lie in one plane, they bound no solid");
}

/// Values on a grid that are found about the points only, and elsewhere but for their sign.
class Band {
 public:
  Band(const std::vector<Vec3>& points, double cell, int width) : cell_(cell) {
    Box3 box;
    for (const Vec3& p : points) box.extend(p);
    origin_ = box.min() - Vec3::Constant((width + 1.5) * cell);
    double nodes = 1.0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double count = std::ceil(box.sizes()[static_cast<int>(d)] / cell) + 2.0 * width + 4.0;
      nodes *= count;
      size_[d] = nodes < 2147483648.0 ? static_cast<std::int64_t>(count) : 0;
    }
    if (!(nodes < 2147483648.0))
      throw InvalidInput("Poisson surface: a grid of " + std::to_string(cell) + " mm about the points has " +
                         std::to_string(nodes) + " nodes; choose larger cells");
    values_.assign(static_cast<std::size_t>(nodes), unknown);
    for (const Vec3& p : points) mark(p, width);
  }

  void fill(const PoissonFunction& function, const core::TaskContext& task) {
    for (std::int64_t k = 0; k < size_[2]; ++k) {
      task.throw_if_cancelled();
      for (std::int64_t j = 0; j < size_[1]; ++j)
        for (std::int64_t i = 0; i < size_[0]; ++i)
          if (float& value = values_[at({i, j, k})]; value == asked)
            value = static_cast<float>(function(place({i, j, k})));
      task.set_progress(static_cast<double>(k + 1) / static_cast<double>(size_[2]));
    }
    for (std::size_t n = 0; n < values_.size(); ++n)
      if (values_[n] == unknown) flood(n, function);
  }

  geometry::TriMesh surface(const core::TaskContext& task) const {
    geometry::ScalarGrid grid;
    grid.size = size_;
    grid.values = values_.data();
    grid.origin = origin_;
    grid.axes = cell_ * geometry::Mat3::Identity();
    return geometry::isosurface(grid, 0.0F, true, task);
  }

 private:
  // No value of the function: it is finite, and small near the points.
  static constexpr float unknown = std::numeric_limits<float>::max();
  static constexpr float asked = std::numeric_limits<float>::lowest();

  std::size_t at(const Node& n) const {
    return static_cast<std::size_t>(n[0] + size_[0] * (n[1] + size_[1] * n[2]));
  }
  Vec3 place(const Node& n) const {
    return origin_ +
           cell_ * Vec3(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2]));
  }
  Node node(std::size_t n) const {
    const auto m = static_cast<std::int64_t>(n);
    return {m % size_[0], m / size_[0] % size_[1], m / (size_[0] * size_[1])};
  }

  void mark(const Vec3& point, int width) {
    Node from{};
    for (int d = 0; d < 3; ++d)
      from[static_cast<std::size_t>(d)] =
          static_cast<std::int64_t>(std::floor((point[d] - origin_[d]) / cell_)) - width + 1;
    for (std::int64_t k = from[2]; k < from[2] + 2 * width; ++k)
      for (std::int64_t j = from[1]; j < from[1] + 2 * width; ++j)
        for (std::int64_t i = from[0]; i < from[0] + 2 * width; ++i) values_[at({i, j, k})] = asked;
  }

  /// What lies away from the points is wholly inside or wholly outside.
  void flood(std::size_t first, const PoissonFunction& function) {
    const float sign = is_border(node(first)) || function(place(node(first))) > 0.0 ? 1.0F : -1.0F;
    std::vector<std::size_t> open{first};
    values_[first] = sign;
    while (!open.empty()) {
      const Node n = node(open.back());
      open.pop_back();
      for (std::size_t d = 0; d < 3; ++d)
        for (const std::int64_t step : {-1, 1}) {
          Node m = n;
          m[d] += step;
          if (m[d] < 0 || m[d] >= size_[d]) continue;
          if (float& value = values_[at(m)]; value == unknown) {
            value = sign;
            open.push_back(at(m));
          }
        }
    }
  }
  bool is_border(const Node& n) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (n[d] == 0 || n[d] == size_[d] - 1) return true;
    return false;
  }

  double cell_;
  Vec3 origin_ = Vec3::Zero();
  Node size_{};
  std::vector<float> values_;
};

}  // namespace

void validate(const PoissonOptions& options) {
  if (!(options.cell_mm >= 0.0 && std::isfinite(options.cell_mm)))
    throw InvalidInput("Poisson surface: cell_mm must be 0 or above");
  if (options.band_cells < 1 || options.band_cells > 20)
    throw InvalidInput("Poisson surface: band_cells must be in [1, 20]");
}

geometry::TriMesh poisson_surface(const std::vector<Vec3>& points, const std::vector<Vec3>& normals,
                                  const PoissonOptions& options, const core::TaskContext& task) {
  validate(options);
  require_samples(points, normals);
  const PoissonFunction function(points, normals);
  task.set_progress(0.7);
  task.throw_if_cancelled();
  Band band(points, options.cell_mm > 0.0 ? options.cell_mm : function.mean_spacing_mm(), options.band_cells);
  band.fill(function, task.sub(0.7, 0.95));
  return band.surface(task.sub(0.95, 1.0));
}

geometry::TriMesh poisson_surface(const geometry::TriMesh& surface, const PoissonOptions& options,
                                  const core::TaskContext& task) {
  const std::vector<Vec3> all = geometry::vertex_normals(surface);
  std::vector<Vec3> points, normals;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    if (!(all[i].norm() > 0.0)) continue;  // of no triangle
    points.push_back(surface.points[i]);
    normals.push_back(all[i]);
  }
  return poisson_surface(points, normals, options, task);
}

}  // namespace ostia::meshing
