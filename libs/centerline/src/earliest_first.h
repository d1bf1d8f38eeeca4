#pragma once
// A queue for fronts: the earliest comes out first, and of equal times the lower point.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ostia::centerline {

/// A heap of four children a node: half as deep as one of two, and a node's children share a cache line. What
/// comes out next does not depend on the heap's shape, since no two entries rank equal but those that are.
/// Times must not be negative.
class EarliestFirst {
 public:
  struct Entry {
    double time;
    std::int32_t point;
  };
  bool empty() const { return ranks_.empty(); }

  void push(double time, std::int32_t point) {
    std::size_t place = ranks_.size();
    const Rank rank = rank_of(time, point);
    ranks_.push_back(rank);
    for (; place > 0; place = (place - 1) / children) {
      const Rank above = ranks_[(place - 1) / children];
      if (!(rank < above)) break;
      ranks_[place] = above;
    }
    ranks_[place] = rank;
  }

  /// There must be one.
  Entry pop() {
    const Rank first = ranks_.front();
    const Rank moved = ranks_.back();
    ranks_.pop_back();
    const std::size_t size = ranks_.size();
    if (size == 0) return entry_of(first);
    std::size_t place = 0;
    for (std::size_t child = 1; child < size; child = children * place + 1) {
      const std::size_t least = child + children <= size ? least_of_four(child) : least_of(child, size);
      if (!(ranks_[least] < moved)) break;
      ranks_[place] = ranks_[least];
      place = least;
    }
    ranks_[place] = moved;
    return entry_of(first);
  }

 private:
  // The time's bits, which as a number rank as times that are not negative do, before the point: two
  // instructions compare both without a branch, which a processor would guess wrongly half of the time.
  __extension__ typedef unsigned __int128 Rank;
  static Rank rank_of(double time, std::int32_t point) {
    const auto bits = std::bit_cast<std::uint64_t>(time + 0.0);  // -0 + 0 is +0
    return static_cast<Rank>(bits) << 64 | static_cast<std::uint32_t>(point);
  }
  static Entry entry_of(Rank rank) {
    return {std::bit_cast<double>(static_cast<std::uint64_t>(rank >> 64)),
            static_cast<std::int32_t>(static_cast<std::uint32_t>(rank))};
  }

  std::size_t second_is_less(std::size_t a, std::size_t b) const {
    return static_cast<std::size_t>(ranks_[b] < ranks_[a]);
  }
  std::size_t least_of_four(std::size_t first) const {
    const std::size_t a = first + second_is_less(first, first + 1);
    const std::size_t b = first + 2 + second_is_less(first + 2, first + 3);
    return a ^ ((a ^ b) & (0 - second_is_less(a, b)));
  }
  std::size_t least_of(std::size_t first, std::size_t last) const {
    std::size_t least = first;
    for (std::size_t k = first + 1; k < last; ++k)
      if (ranks_[k] < ranks_[least]) least = k;
    return least;
  }

  static constexpr std::size_t children = 4;
  std::vector<Rank> ranks_;
};

}  // namespace ostia::centerline
