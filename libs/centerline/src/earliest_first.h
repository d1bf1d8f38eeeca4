#pragma once
// A queue for fronts: the earliest comes out first, and of equal times the lower point.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ostia::centerline {

/// A heap of four children a node: half as deep as one of two, and a node's children share a cache line. What
/// comes out next does not depend on the heap's shape, since no two entries rank equal but those that are.
class EarliestFirst {
 public:
  struct Entry {
    double time;
    std::int32_t point;
  };
  bool empty() const { return entries_.empty(); }

  void push(double time, std::int32_t point) {
    std::size_t place = entries_.size();
    const Entry entry{time, point};
    entries_.push_back(entry);
    for (; place > 0; place = (place - 1) / children) {
      const Entry& above = entries_[(place - 1) / children];
      if (!before(entry, above)) break;
      entries_[place] = above;
    }
    entries_[place] = entry;
  }

  /// There must be one.
  Entry pop() {
    const Entry first = entries_.front();
    const Entry moved = entries_.back();
    entries_.pop_back();
    const std::size_t size = entries_.size();
    if (size == 0) return first;
    std::size_t place = 0;
    for (std::size_t child = 1; child < size; child = children * place + 1) {
      const std::size_t last = std::min(child + children, size);
      std::size_t least = child;
      for (std::size_t k = child + 1; k < last; ++k)
        if (before(entries_[k], entries_[least])) least = k;
      if (!before(entries_[least], moved)) break;
      entries_[place] = entries_[least];
      place = least;
    }
    entries_[place] = moved;
    return first;
  }

 private:
  static bool before(const Entry& a, const Entry& b) {
    return a.time < b.time || (a.time == b.time && a.point < b.point);
  }
  static constexpr std::size_t children = 4;
  std::vector<Entry> entries_;
};

}  // namespace ostia::centerline
