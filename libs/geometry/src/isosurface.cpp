#include "ostia/geometry/isosurface.h"

#include "marching_cubes.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

std::string text(const std::array<std::int64_t, 3>& size) {
  return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
}

void check(const ScalarGrid& grid) {
  const auto& n = grid.size;
  if (n[0] < 1 || n[1] < 1 || n[2] < 1 || grid.values == nullptr) {
    throw InvalidInput("the grid of the isosurface has " + text(n) +
                       " values; give at least one along each axis");
  }
  const double determinant = grid.axes.determinant();
  if (!grid.origin.allFinite() || !std::isfinite(determinant) || determinant == 0.0) {
    throw InvalidInput(
        "the axes of the isosurface's grid are flat or not finite; give three independent steps in mm");
  }
}

// The grid with one more layer all round that is outside.
void fill_padded(const ScalarGrid& grid, std::int64_t first, std::int64_t count, float* out) {
  const auto [nx, ny, nz] = grid.size;
  const float outside = std::numeric_limits<float>::infinity();
  const std::int64_t wide = nx + 2, slice = wide * (ny + 2);
  std::fill(out, out + count * slice, outside);
  for (std::int64_t k = std::max<std::int64_t>(first, 1); k < std::min(first + count, nz + 1); ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      const float* row = grid.values + nx * (j + ny * (k - 1));
      std::copy(row, row + nx, out + (k - first) * slice + (j + 1) * wide + 1);
    }
  }
}

}  // namespace

TriMesh isosurface(const ScalarGrid& grid, float level, bool closed_at_border,
                   const core::TaskContext& task) {
  check(grid);
  const std::int64_t pad = closed_at_border ? 1 : 0;
  MarchingCubes job;
  job.size = {grid.size[0] + 2 * pad, grid.size[1] + 2 * pad, grid.size[2] + 2 * pad};
  job.level = level;
  job.numbered_from = -pad;
  job.left_handed = grid.axes.determinant() < 0.0;
  job.fill = [&grid, closed_at_border](std::int64_t first, std::int64_t count, float* out) {
    if (closed_at_border) return fill_padded(grid, first, count, out);
    const std::int64_t slice = grid.size[0] * grid.size[1];
    std::copy(grid.values + first * slice, grid.values + (first + count) * slice, out);
  };
  job.place = [&grid, level, pad](const CrossedEdge& e) -> Vec3 {
    Vec3 index(static_cast<double>(e.node[0] - pad), static_cast<double>(e.node[1] - pad),
               static_cast<double>(e.node[2] - pad));
    // Towards the layer around the grid the surface closes where the border voxel ends, half a step on.
    const bool border = std::isinf(e.from) || std::isinf(e.to);
    index[e.axis] += border ? 0.5 : crossing_fraction(e.from, e.to, level);
    return grid.origin + grid.axes * index;
  };
  return march(job, task);
}

TriMesh isosurface(const std::function<double(const Vec3&)>& f, const Box3& box, double spacing_mm,
                   const core::TaskContext& task) {
  if (!(spacing_mm > 0.0) || !std::isfinite(spacing_mm)) {
    throw InvalidInput("the spacing of the isosurface is " + std::to_string(spacing_mm) +
                       " mm; it must be above 0");
  }
  if (box.isEmpty() || !box.sizes().allFinite()) {
    throw InvalidInput("the box of the isosurface is empty or not finite");
  }
  const Vec3 origin = box.min();
  MarchingCubes job;
  for (int a = 0; a < 3; ++a) {
    job.size[static_cast<std::size_t>(a)] =
        static_cast<std::int64_t>(std::ceil(box.sizes()[a] / spacing_mm)) + 1;
  }
  const std::int64_t nx = job.size[0], ny = job.size[1];
  job.fill = [&, nx, ny](std::int64_t first, std::int64_t count, float* out) {
    for (std::int64_t k = first; k < first + count; ++k) {
      task.throw_if_cancelled();
      for (std::int64_t j = 0; j < ny; ++j) {
        for (std::int64_t i = 0; i < nx; ++i) {
          const Vec3 index(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
          *out++ = static_cast<float>(f(origin + spacing_mm * index));
        }
      }
    }
  };
  job.place = [&](const CrossedEdge& e) -> Vec3 {
    Vec3 index(static_cast<double>(e.node[0]), static_cast<double>(e.node[1]),
               static_cast<double>(e.node[2]));
    index[e.axis] += crossing_fraction(e.from, e.to, 0.0f);
    return origin + spacing_mm * index;
  };
  return march(job, task);
}

}  // namespace ostia::geometry
