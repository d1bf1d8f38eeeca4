#pragma once
/// \file Segments in cells of space, to be added and asked for one after the other.

#include "growth/round_cones.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace ostia::analysis {

/// Cells in a hash table, on levels eight times as coarse as the one before: each segment lies on the finest
/// level where it reaches through a few cells.
class ConeGrid {
 public:
  explicit ConeGrid(double cell_mm);
  void add(std::int32_t edge, const RoundCone& cone);
  /// True as soon as `hits` says so of a segment that may meet the cone; one may be asked about twice.
  bool any_near(const RoundCone& cone, const std::function<bool(std::int32_t)>& hits) const;

 private:
  static constexpr int levels = 4;
  struct Entry {
    std::int32_t edge, next;
  };
  struct Slot {
    std::uint64_t key;
    std::int32_t head;  ///< -1: free
  };
  double cell(int level) const { return cells_[static_cast<std::size_t>(level)]; }
  template <class Visit>
  bool visit_cells(int level, const RoundCone& cone, const Visit& visit) const;
  std::size_t slot_of(std::uint64_t key) const;
  void grow();

  std::array<double, levels> cells_{};
  std::array<std::size_t, levels> used_{};
  std::vector<Entry> entries_;
  std::vector<Slot> slots_;
  std::size_t taken_ = 0;
};

}  // namespace ostia::analysis
