#include "ostia/core/error.h"
#include "ostia/geometry/isosurface.h"
#include "ostia/imaging/filters.h"
#include "ostia/segmentation/segment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::segmentation {
namespace {

geometry::TriMesh zero_set(const imaging::FloatVolume& level_set, const core::TaskContext& task) {
  const imaging::Geometry& g = level_set.geometry;
  geometry::ScalarGrid grid;
  grid.size = g.size;
  grid.values = level_set.voxels.data();
  grid.origin = g.origin;
  grid.axes = g.direction * g.spacing.asDiagonal();
  return geometry::isosurface(grid, 0.0F, true, task);
}

/// Calls visit(m) on the face neighbours of voxel n.
template <class Visit>
void for_neighbours(const std::array<std::int64_t, 3>& size, std::int64_t n, const Visit& visit) {
  const std::array<std::int64_t, 3> at{n % size[0], n / size[0] % size[1], n / (size[0] * size[1])};
  const std::array<std::int64_t, 3> strides{1, size[0], size[0] * size[1]};
  for (int d = 0; d < 3; ++d) {
    if (at[d] > 0) visit(n - strides[d]);
    if (at[d] + 1 < size[d]) visit(n + strides[d]);
  }
}

/// Marks what can be reached from the voxels in `front` through voxels for which `open` holds.
template <class Open>
void flood(const std::array<std::int64_t, 3>& size, std::vector<std::int64_t> front,
           std::vector<std::uint8_t>& marks, const Open& open) {
  for (const std::int64_t n : front) marks[n] = 1;
  while (!front.empty()) {
    const std::int64_t n = front.back();
    front.pop_back();
    for_neighbours(size, n, [&](std::int64_t m) {
      if (marks[m] != 0 || !open(m)) return;
      marks[m] = 1;
      front.push_back(m);
    });
  }
}

/// The inside voxel nearest to a point within two voxels of it; -1 where there is none.
std::int64_t inside_voxel(const imaging::FloatVolume& level_set, const Vec3& point) {
  const imaging::Geometry& g = level_set.geometry;
  const Vec3 index = g.index(point);
  std::int64_t best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  std::array<std::int64_t, 3> low{};
  std::array<std::int64_t, 3> high{};
  for (int d = 0; d < 3; ++d) {
    if (!(std::abs(index[d]) < 1e9)) return -1;
    low[d] = std::max<std::int64_t>(0, std::llround(index[d]) - 2);
    high[d] = std::min<std::int64_t>(g.size[d] - 1, std::llround(index[d]) + 2);
  }
  for (std::int64_t k = low[2]; k <= high[2]; ++k) {
    for (std::int64_t j = low[1]; j <= high[1]; ++j) {
      for (std::int64_t i = low[0]; i <= high[0]; ++i) {
        if (level_set(i, j, k) >= 0.0F) continue;
        const double distance =
            (Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) - index).norm();
        if (distance < best_distance) {
          best_distance = distance;
          best = g.offset(i, j, k);
        }
      }
    }
  }
  return best;
}

void require_voxels(const imaging::Geometry& g, std::size_t values, const char* what) {
  if (g.voxels() <= 0 || values != static_cast<std::size_t>(g.voxels())) {
    throw InvalidInput(std::string(what) + ": " + std::to_string(values) + " values for " +
                       std::to_string(g.voxels()) + " voxels");
  }
}

void keep_parts_with_seeds(imaging::FloatVolume& level_set, const std::vector<Vec3>& seeds_mm) {
  std::vector<std::int64_t> start;
  for (const Vec3& seed : seeds_mm) {
    const std::int64_t n = inside_voxel(level_set, seed);
    if (n >= 0) start.push_back(n);
  }
  if (start.empty()) {
    throw GeometryError("surface: no seed lies inside the level set or within two voxels of it");
  }
  std::vector<std::uint8_t> kept(level_set.voxels.size(), 0);
  flood(level_set.geometry.size, start, kept, [&](std::int64_t m) { return level_set.voxels[m] < 0.0F; });
  for (std::size_t n = 0; n < kept.size(); ++n) {
    if (kept[n] == 0) level_set.voxels[n] = std::abs(level_set.voxels[n]);
  }
}

void fill_cavities(imaging::FloatVolume& level_set) {
  const auto& size = level_set.geometry.size;
  std::vector<std::int64_t> start;
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      const bool rim = k == 0 || j == 0 || k + 1 == size[2] || j + 1 == size[1];
      for (std::int64_t i = 0; i < size[0]; i += rim ? 1 : std::max<std::int64_t>(1, size[0] - 1)) {
        const std::int64_t n = level_set.geometry.offset(i, j, k);
        if (level_set.voxels[n] >= 0.0F) start.push_back(n);
      }
    }
  }
  std::vector<std::uint8_t> outside(level_set.voxels.size(), 0);
  flood(size, start, outside, [&](std::int64_t m) { return level_set.voxels[m] >= 0.0F; });
  const float least = 0.5F * static_cast<float>(level_set.geometry.spacing.minCoeff());
  for (std::size_t n = 0; n < outside.size(); ++n) {
    if (outside[n] == 0 && level_set.voxels[n] >= 0.0F)
      level_set.voxels[n] = -std::max(level_set.voxels[n], least);
  }
}

/// The largest part of a mask, by voxels; ties go to the one with the lowest voxel.
void keep_largest_part(imaging::MaskVolume& mask) {
  std::vector<std::uint8_t> seen(mask.voxels.size(), 0);
  std::vector<std::int64_t> best;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (mask.voxels[first] == 0 || seen[first] != 0) continue;
    std::vector<std::int64_t> part{static_cast<std::int64_t>(first)};
    seen[first] = 1;
    for (std::size_t n = 0; n < part.size(); ++n) {
      for_neighbours(mask.geometry.size, part[n], [&](std::int64_t m) {
        if (mask.voxels[m] == 0 || seen[m] != 0) return;
        seen[m] = 1;
        part.push_back(m);
      });
    }
    if (part.size() > best.size()) best = std::move(part);
  }
  std::fill(mask.voxels.begin(), mask.voxels.end(), std::uint8_t{0});
  for (const std::int64_t n : best) mask.voxels[n] = 1;
}

/// The mask's bounding box, with room for the blur. Empty (upper <= lower) for an empty mask.
imaging::Region box_of(const imaging::MaskVolume& mask, int margin) {
  const auto& size = mask.geometry.size;
  imaging::Region box{size, {0, 0, 0}};
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        if (mask(i, j, k) == 0) continue;
        const std::array<std::int64_t, 3> at{i, j, k};
        for (int d = 0; d < 3; ++d) {
          box.lower[d] = std::min(box.lower[d], at[d]);
          box.upper[d] = std::max(box.upper[d], at[d] + 1);
        }
      }
    }
  }
  for (int d = 0; d < 3; ++d) {
    if (box.upper[d] <= box.lower[d]) return {{0, 0, 0}, {0, 0, 0}};
    box.lower[d] -= margin;
    box.upper[d] += margin;
  }
  return box;
}

/// 0.5 - mask on a box that may reach beyond the mask's grid.
imaging::FloatVolume padded(const imaging::MaskVolume& mask, const imaging::Region& box) {
  imaging::FloatVolume out;
  out.geometry = mask.geometry;
  for (int d = 0; d < 3; ++d) out.geometry.size[d] = box.upper[d] - box.lower[d];
  out.geometry.origin =
      mask.geometry.world(Vec3(static_cast<double>(box.lower[0]), static_cast<double>(box.lower[1]),
                               static_cast<double>(box.lower[2])));
  out.voxels.assign(static_cast<std::size_t>(out.geometry.voxels()), 0.5F);
  const auto& size = mask.geometry.size;
  for (std::int64_t k = std::max<std::int64_t>(0, box.lower[2]); k < std::min(size[2], box.upper[2]); ++k) {
    for (std::int64_t j = std::max<std::int64_t>(0, box.lower[1]); j < std::min(size[1], box.upper[1]); ++j) {
      for (std::int64_t i = std::max<std::int64_t>(0, box.lower[0]); i < std::min(size[0], box.upper[0]);
           ++i) {
        if (mask(i, j, k) != 0) out(i - box.lower[0], j - box.lower[1], k - box.lower[2]) = -0.5F;
      }
    }
  }
  return out;
}

constexpr float kOwnSide =
    0.05F;  // least value of a blurred mask at a voxel's centre, on the voxel's own side

constexpr float kClearance = 0.03F;  // of the surface from voxels' centres, in voxels

}  // namespace

geometry::TriMesh surface_of(const imaging::FloatVolume& level_set, const std::vector<Vec3>& seeds_mm,
                             const SurfaceOptions& options, const core::TaskContext& task) {
  require_voxels(level_set.geometry, level_set.voxels.size(), "surface");
  imaging::FloatVolume field = level_set;
  if (!seeds_mm.empty()) keep_parts_with_seeds(field, seeds_mm);
  task.throw_if_cancelled();
  if (options.fill_cavities) fill_cavities(field);
  // Where the surface all but touches a voxel's centre, its triangles have no size to speak of.
  const float least = kClearance * static_cast<float>(field.geometry.spacing.minCoeff());
  for (float& value : field.voxels) value = value < 0.0F ? std::min(value, -least) : std::max(value, least);
  return zero_set(field, task);
}

void validate(const MaskSurfaceOptions& options) {
  if (!(options.sigma_voxels >= 0.0 && options.sigma_voxels <= 10.0)) {
    throw InvalidInput("mask surface: sigma_voxels must be in [0, 10]");
  }
}

geometry::TriMesh segment_mask(const imaging::MaskVolume& mask, const MaskSurfaceOptions& options,
                               const core::TaskContext& task) {
  validate(options);
  require_voxels(mask.geometry, mask.voxels.size(), "mask surface");
  imaging::MaskVolume largest;
  if (options.largest_part_only) {
    largest = mask;
    keep_largest_part(largest);
  }
  const imaging::MaskVolume& used = options.largest_part_only ? largest : mask;
  const imaging::Region box = box_of(used, 2 + static_cast<int>(std::ceil(2.0 * options.sigma_voxels)));
  if (box.upper[0] <= box.lower[0])
    throw InvalidInput("mask surface: the mask is empty, no voxel is nonzero");
  const imaging::FloatVolume sides = padded(used, box);
  task.throw_if_cancelled();
  // The same blur in all directions of the world; the coarsest axis has the highest stairs.
  imaging::FloatVolume field = imaging::gaussian_blurred(
      sides, options.sigma_voxels * mask.geometry.spacing.maxCoeff(), task.sub(0.0, 0.5));
  for (std::size_t n = 0; n < field.voxels.size(); ++n) {
    float& value = field.voxels[n];
    value = sides.voxels[n] < 0.0F ? std::min(value, -kOwnSide) : std::max(value, kOwnSide);
  }
  return zero_set(field, task.sub(0.5, 1.0));
}

}  // namespace ostia::segmentation
