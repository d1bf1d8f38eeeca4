#include "calcium/calcium_slices.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr std::int64_t least_pixels = 16, fewest_slices = 3;

/// The image's axis that runs most along the patient.
int length_axis(const imaging::Geometry& grid) {
  int best = 2;
  for (const int a : {0, 1})
    if (std::abs(grid.direction(2, a)) > std::abs(grid.direction(2, best)) + 1e-9) best = a;
  return best;
}

/// How many slices are averaged. Overlapping ones are thick already: of n of them the thickness is theirs and
/// n - 1 distances. Nearest to the definition's, of two as near the thinner.
int slices_of_one(double slice_mm, const CalciumOptions& o) {
  if (!o.average_thin) return 1;
  const double thick = std::max(slice_mm, o.slice_thickness_mm.value_or(slice_mm));
  return 1 + std::max(0, static_cast<int>(std::ceil((o.definition_mm - thick) / slice_mm - 0.5 - 1e-9)));
}

void require_slices(const imaging::Geometry& grid, int axis, const CalciumOptions& o) {
  for (int d = 0; d < 3; ++d) {
    const std::int64_t least = d == axis ? fewest_slices : least_pixels;
    if (grid.size[static_cast<std::size_t>(d)] < least)
      throw InvalidInput("calcium score: the image is too small, " + std::to_string(grid.size[0]) + " x " +
                         std::to_string(grid.size[1]) + " x " + std::to_string(grid.size[2]) +
                         " voxels; take the whole scan");
  }
  if (grid.spacing[axis] > o.largest_slice_mm)
    throw InvalidInput("calcium score: the slices lie " + core::rounded_text(grid.spacing[axis], 1) +
                       " mm apart, and the score is defined for " + core::rounded_text(o.definition_mm, 1) +
                       " mm; take a reconstruction of at most " + core::rounded_text(o.largest_slice_mm, 1) +
                       " mm");
}

}  // namespace

CalciumSlices calcium_slices(const imaging::ImageVolume& image, const CalciumOptions& options,
                             const core::TaskContext& task) {
  const imaging::Geometry& from = image.geometry;
  const int axis = length_axis(from);
  require_slices(from, axis, options);
  // Turned, not mirrored: the frame stays right-handed.
  const std::array<int, 3> order{(axis + 1) % 3, (axis + 2) % 3, axis};
  CalciumSlices out;
  out.slice_mm = from.spacing[axis];
  out.averaged = slices_of_one(out.slice_mm, options);
  imaging::Geometry& grid = out.image.geometry;
  std::array<std::int64_t, 3> stride{1, from.size[0], from.size[0] * from.size[1]}, step{};
  for (std::size_t d = 0; d < 3; ++d) {
    const int a = order[d];
    grid.size[d] = from.size[static_cast<std::size_t>(a)];
    grid.spacing[static_cast<Eigen::Index>(d)] = from.spacing[a];
    grid.direction.col(static_cast<Eigen::Index>(d)) = from.direction.col(a);
    step[d] = stride[static_cast<std::size_t>(a)];
  }
  const std::int64_t slices = grid.size[2], n = out.averaged;
  grid.origin = from.origin + 0.5 * static_cast<double>(n - 1) * out.slice_mm * grid.direction.col(2);
  grid.size[2] = (slices + n - 1) / n;
  grid.spacing.z() = static_cast<double>(n) * out.slice_mm;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    out.share.push_back(static_cast<double>(std::min(n, slices - k * n)) / static_cast<double>(n));
  out.image.voxels.resize(static_cast<std::size_t>(grid.voxels()));
  core::parallel_for(static_cast<std::size_t>(grid.size[2]), 1, [&](std::size_t slab) {
    task.throw_if_cancelled();
    const auto k = static_cast<std::int64_t>(slab);
    const std::int64_t first = k * n, last = std::min(slices, first + n);
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        double sum = 0.0;
        for (std::int64_t s = first; s < last; ++s)
          sum += image.voxels[static_cast<std::size_t>(i * step[0] + j * step[1] + s * step[2])];
        out.image(i, j, k) = static_cast<float>(sum / static_cast<double>(last - first));
      }
  });
  return out;
}

}  // namespace ostia::analysis
