#pragma once
/// \file Points in cubic cells: neighbours of a place while points come and go.

#include "ostia/geometry/vec.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace ostia::lumen {

using geometry::Vec3;

/// Points with a number each. The order in which neighbours are told depends on the history of the grid: use
/// it for what does not depend on order, or sort.
class PointGrid {
 public:
  explicit PointGrid(double cell_mm) : cell_(cell_mm) {}

  void insert(std::int32_t number, const Vec3& place) {
    cells_[key(cell_of(place))].push_back({place, number});
  }
  void erase(std::int32_t number, const Vec3& place) {
    const auto found = cells_.find(key(cell_of(place)));
    if (found == cells_.end()) return;
    std::vector<Entry>& entries = found->second;
    for (Entry& entry : entries) {
      if (entry.number != number) continue;
      entry = entries.back();
      entries.pop_back();
      if (entries.empty()) cells_.erase(found);
      return;
    }
  }
  /// visit(number, place, squared distance) for all points nearer than `radius_mm`.
  template <class Visit>
  void near(const Vec3& place, double radius_mm, const Visit& visit) const {
    const Cell from = cell_of(place - Vec3::Constant(radius_mm));
    const Cell to = cell_of(place + Vec3::Constant(radius_mm));
    const double limit = radius_mm * radius_mm;
    for (std::int64_t x = from.x; x <= to.x; ++x)
      for (std::int64_t y = from.y; y <= to.y; ++y)
        for (std::int64_t z = from.z; z <= to.z; ++z) {
          const auto found = cells_.find(key({x, y, z}));
          if (found == cells_.end()) continue;
          for (const Entry& entry : found->second) {
            const double d2 = (entry.place - place).squaredNorm();
            if (d2 < limit) visit(entry.number, entry.place, d2);
          }
        }
  }

 private:
  struct Entry {
    Vec3 place;
    std::int32_t number;
  };
  struct Cell {
    std::int64_t x, y, z;
  };
  struct Mix {
    std::size_t operator()(std::uint64_t k) const { return k * 0x9e3779b97f4a7c15ULL >> 17; }
  };
  // 21 bits an axis: cells of 0.1 mm reach 100 m.
  static std::uint64_t key(const Cell& c) {
    constexpr std::uint64_t mask = (1ULL << 21) - 1;
    return (static_cast<std::uint64_t>(c.x) & mask) << 42 | (static_cast<std::uint64_t>(c.y) & mask) << 21 |
           (static_cast<std::uint64_t>(c.z) & mask);
  }
  Cell cell_of(const Vec3& place) const {
    return {static_cast<std::int64_t>(std::floor(place.x() / cell_)),
            static_cast<std::int64_t>(std::floor(place.y() / cell_)),
            static_cast<std::int64_t>(std::floor(place.z() / cell_))};
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<Entry>, Mix> cells_;
};

}  // namespace ostia::lumen
