#include "ostia/evaluation/overlap.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

namespace ostia::evaluation {

using imaging::FloatVolume;
using imaging::MaskVolume;
using imaging::Vec3;

double dice(const MaskVolume& a, const MaskVolume& b, const std::function<bool(const Vec3&)>& counts) {
  if (!imaging::same_grid(a.geometry, b.geometry))
    throw InvalidInput("the two masks lie on different grids; resample one to the other's");
  std::int64_t both = 0, sum = 0;
  const auto& size = a.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const bool in_a = a(i, j, k) != 0, in_b = b(i, j, k) != 0;
        if (!in_a && !in_b) continue;
        if (counts && !counts(a.geometry.world(
                          Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))))
          continue;
        both += in_a && in_b;
        sum += in_a + in_b;
      }
    }
  }
  if (sum == 0) throw InvalidInput("both masks are empty where they are compared");
  return 2.0 * static_cast<double>(both) / static_cast<double>(sum);
}

MaskVolume mask_of(const FloatVolume& level_set, const imaging::Geometry& grid) {
  MaskVolume mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxels()), 0)};
  core::parallel_for(static_cast<std::size_t>(grid.size[2]), 1, [&](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < grid.size[1]; ++j) {
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const Vec3 world =
            grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if (level_set.geometry.contains(world) && imaging::sample(level_set, world) < 0.0) mask(i, j, k) = 1;
      }
    }
  });
  return mask;
}

}  // namespace ostia::evaluation
