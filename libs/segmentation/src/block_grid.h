#pragma once
/// \file A grid of which only the blocks that are written take memory.

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::segmentation::detail {

using Voxel = std::array<std::int32_t, 3>;

/// Values on a grid of any size, in blocks of 8 x 8 x 8; what was never written reads as the default.
template <class T>
class BlockGrid {
 public:
  BlockGrid(const std::array<std::int64_t, 3>& size, const T& unset) : unset_(unset) {
    for (int d = 0; d < 3; ++d) blocks_[d] = (size[d] + 7) >> 3;
    first_.assign(static_cast<std::size_t>(blocks_[0] * blocks_[1] * blocks_[2]), -1);
  }

  const T& get(const Voxel& v) const {
    const std::int64_t first = first_[block(v)];
    return first < 0 ? unset_ : values_[static_cast<std::size_t>(first) + local(v)];
  }

  T& at(const Voxel& v) {
    std::int64_t& first = first_[block(v)];
    if (first < 0) {
      first = static_cast<std::int64_t>(values_.size());
      values_.resize(values_.size() + 512, unset_);
    }
    return values_[static_cast<std::size_t>(first) + local(v)];
  }

 private:
  std::size_t block(const Voxel& v) const {
    return static_cast<std::size_t>((v[0] >> 3) + blocks_[0] * ((v[1] >> 3) + blocks_[1] * (v[2] >> 3)));
  }
  static std::size_t local(const Voxel& v) {
    return static_cast<std::size_t>((v[0] & 7) | ((v[1] & 7) << 3) | ((v[2] & 7) << 6));
  }

  T unset_;
  std::array<std::int64_t, 3> blocks_{};
  std::vector<std::int64_t> first_;
  std::vector<T> values_;
};

}  // namespace ostia::segmentation::detail
