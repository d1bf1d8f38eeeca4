#include "ostia/centerline/thinning.h"

#include "simple_point.h"
#include "voxel_box.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace ostia::centerline {
namespace {

using detail::neighbour_count;
using detail::VoxelBox;

constexpr std::uint8_t object_bit = 1, reached_bit = 2, queued_bit = 4;
// Squared distances closer than this part of the smallest spacing squared are one level.
constexpr double level_part = 1e-3;

// The order in which voxels go: level in the upper half, place in the lower.
using Key = std::uint64_t;
std::uint32_t place_of(Key key) {
  return static_cast<std::uint32_t>(key);
}
std::uint32_t level_of(Key key) {
  return static_cast<std::uint32_t>(key >> 32);
}

std::vector<Key> ordered(const VoxelBox& box, const float* squared, double smallest_spacing) {
  const double unit = level_part * smallest_spacing * smallest_spacing;
  std::vector<Key> keys(box.voxels.size());
  core::parallel_for(keys.size(), 65536, [&](std::size_t i) {
    const double level = std::min(static_cast<double>(squared[box.voxels[i]]) / unit + 0.5, 4294967295.0);
    keys[i] = (static_cast<Key>(level) << 32) | box.voxels[i];
  });
  std::sort(keys.begin(), keys.end());
  return keys;
}

class Peeling {
 public:
  Peeling(VoxelBox& box, bool keep_ends) : box_(box), keep_ends_(keep_ends) {
    for (int n = 0; n < neighbour_count; ++n) {
      const detail::Step s = detail::neighbour_step(n);
      steps_[static_cast<std::size_t>(n)] = s.x + s.y * box.stride[1] + s.z * box.stride[2];
    }
    sides_ = {-box.stride[2], box.stride[2], -box.stride[1], box.stride[1], -1, 1};
  }

  // All voxels of one distance, with what becomes free before them by their going.
  void peel(const Key* first, const Key* last) {
    active_.clear();
    for (const Key* key = first; key != last; ++key) {
      active_.push_back(place_of(*key));
      box_.object[place_of(*key)] |= reached_bit;
    }
    while (!active_.empty()) {
      next_.clear();
      for (const std::int64_t side : sides_) peel_side(side);
      std::sort(next_.begin(), next_.end());
      active_.clear();
      for (const std::uint32_t v : next_) {
        if ((box_.object[v] & object_bit) == 0) continue;
        box_.object[v] &= static_cast<std::uint8_t>(~queued_bit);
        active_.push_back(v);
      }
    }
  }

  // Of a pair of voxels on their own the deeper (or the first) stays.
  void join_pairs(const std::vector<std::uint32_t>& voxels, const float* squared) {
    for (const std::uint32_t v : voxels) {
      if ((box_.object[v] & object_bit) == 0) continue;
      const std::uint32_t around = neighbours(v);
      if (std::popcount(around) != 1) continue;
      const std::uint32_t other = at(v, static_cast<std::size_t>(std::countr_zero(around)));
      if (std::popcount(neighbours(other)) != 1) continue;
      box_.object[squared[v] < squared[other] ? v : other] = 0;
    }
  }

 private:
  std::uint32_t at(std::uint32_t v, std::size_t n) const {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(v) + steps_[n]);
  }

  std::uint32_t neighbours(std::uint32_t v) const {
    const std::uint8_t* centre = box_.object.data() + v;
    std::uint32_t mask = 0;
    for (std::size_t n = 0; n < steps_.size(); ++n)
      mask |= static_cast<std::uint32_t>(centre[steps_[n]] & object_bit) << n;
    return mask;
  }

  // One of eight classes of voxels of which no two touch.
  std::size_t subfield(std::uint32_t v) const {
    const auto x = static_cast<std::uint32_t>(box_.size[0]), y = static_cast<std::uint32_t>(box_.size[1]);
    const std::uint32_t row = v / x;
    return ((v - row * x) & 1U) | (row % y & 1U) << 1U | (row / y & 1U) << 2U;
  }

  // The voxels that show this side, eight classes in turn, or a ribbon would be eaten up from one end. Ends
  // are told beforehand: what has one neighbour only because the others have just gone is a bump, no end.
  void peel_side(std::int64_t side) {
    for (auto& voxels : border_) voxels.clear();
    for (const std::uint32_t v : active_) {
      const std::uint8_t* centre = box_.object.data() + v;
      if ((*centre & object_bit) != 0 && (centre[side] & object_bit) == 0 && !is_end(v))
        border_[subfield(v)].push_back(v);
    }
    for (const auto& voxels : border_)
      for (const std::uint32_t v : voxels) remove_if_free(v);
  }

  bool is_end(std::uint32_t v) const {
    if (!keep_ends_) return false;
    const std::uint32_t around = neighbours(v);
    return (around & (around - 1U)) == 0;
  }

  void remove_if_free(std::uint32_t v) {
    const std::uint32_t around = neighbours(v);
    if (!detail::is_simple(around)) return;
    box_.object[v] = 0;
    for (std::uint32_t rest = around; rest != 0; rest &= rest - 1U) {
      const std::uint32_t w = at(v, static_cast<std::size_t>(std::countr_zero(rest)));
      if ((box_.object[w] & (reached_bit | queued_bit)) != reached_bit) continue;
      box_.object[w] |= queued_bit;
      next_.push_back(w);
    }
  }

  VoxelBox& box_;
  bool keep_ends_;
  std::array<std::int64_t, neighbour_count> steps_{};
  std::array<std::int64_t, 6> sides_{};
  std::vector<std::uint32_t> active_, next_;
  std::array<std::vector<std::uint32_t>, 8> border_;
};

}  // namespace

Thinned thinned(const imaging::MaskVolume& mask, const ThinningOptions& options,
                const core::TaskContext& task) {
  task.set_stage("thinning");
  task.throw_if_cancelled();
  Thinned result;
  VoxelBox box = detail::box_of(mask);
  result.object_voxels = static_cast<std::int64_t>(box.voxels.size());
  result.mask.geometry = mask.geometry;
  result.mask.voxels.assign(mask.voxels.size(), 0);
  if (box.voxels.empty()) return result;
  if (options.fill_cavities) result.filled_cavity_voxels = detail::fill_cavities(box);
  const auto squared = detail::squared_distances(box, mask.geometry.spacing, task);
  task.set_progress(0.3);
  const std::vector<Key> keys = ordered(box, squared.get(), mask.geometry.spacing.minCoeff());
  Peeling peeling(box, options.keep_ends);
  for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
    task.throw_if_cancelled();
    while (last < keys.size() && level_of(keys[last]) == level_of(keys[first])) ++last;
    peeling.peel(keys.data() + first, keys.data() + last);
    task.set_progress(0.3 + 0.7 * static_cast<double>(last) / static_cast<double>(keys.size()));
  }
  peeling.join_pairs(box.voxels, squared.get());
  for (const std::uint32_t v : box.voxels) {
    if ((box.object[v] & object_bit) == 0) continue;
    const std::int64_t offset = box.image_offset(v, mask.geometry);
    result.mask.voxels[static_cast<std::size_t>(offset)] = 1;
    result.voxels.push_back(offset);
    result.distance_mm.push_back(std::sqrt(squared[v]));
  }
  return result;
}

}  // namespace ostia::centerline
