#pragma once
/// \file From a voxel's offset in its grid to its place, and back.

#include "ostia/imaging/volume.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace ostia::coronary {

using GridIndex = std::array<std::int64_t, 3>;

inline GridIndex grid_index(const imaging::Geometry& grid, std::int64_t voxel) {
  return {voxel % grid.size[0], voxel / grid.size[0] % grid.size[1], voxel / (grid.size[0] * grid.size[1])};
}

inline geometry::Vec3 voxel_place(const imaging::Geometry& grid, std::int64_t voxel) {
  const GridIndex at = grid_index(grid, voxel);
  return grid.world(
      geometry::Vec3(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])));
}

inline std::int64_t voxel_near(const imaging::Geometry& grid, const geometry::Vec3& place) {
  const geometry::Vec3 at = grid.index(place);
  return grid.offset(std::lround(at.x()), std::lround(at.y()), std::lround(at.z()));
}

}  // namespace ostia::coronary
