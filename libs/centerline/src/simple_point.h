#pragma once
/// \file Simple points of 26-connected objects in 6-connected backgrounds.

#include <cstdint>

namespace ostia::centerline::detail {

// The 26 neighbours of a voxel in bits: neighbour (dx, dy, dz) is number (dx + 1) + 3 (dy + 1) + 9 (dz + 1),
// less one beyond the centre (13).
constexpr int neighbour_count = 26;
struct Step {
  int x = 0, y = 0, z = 0;
};
constexpr Step neighbour_step(int n) {
  const int cell = n < 13 ? n : n + 1;
  return {cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1};
}

// Whether removing a voxel with these object neighbours changes no component, loop or cavity: the object has
// one 26-component among the 26 neighbours, and the background one 6-component touching the voxel's faces
// among the 18.
bool is_simple(std::uint32_t neighbours);

}  // namespace ostia::centerline::detail
