#pragma once
/// \file A map of space within a box, exact on a lattice and linear between.

#include "ostia/geometry/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ostia::phantom {

/// The lattice of 1 mm is the world's, not the box's: the same answer at a place from every box.
class PlaceLattice {
 public:
  template <class Map>
  PlaceLattice(const geometry::Box3& box, const Map& map) {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      first_[a] = static_cast<std::int64_t>(std::floor(box.min()[axis] / lattice_mm));
      count_[a] = static_cast<std::int64_t>(std::ceil(box.max()[axis] / lattice_mm)) - first_[a] + 1;
      count_[a] = std::max<std::int64_t>(count_[a], 2);
    }
    places_.reserve(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
    for (std::int64_t k = 0; k < count_[2]; ++k) {
      for (std::int64_t j = 0; j < count_[1]; ++j) {
        for (std::int64_t i = 0; i < count_[0]; ++i) {
          const geometry::Vec3 node(static_cast<double>(first_[0] + i), static_cast<double>(first_[1] + j),
                                    static_cast<double>(first_[2] + k));
          places_.push_back(map(lattice_mm * node));
          from_.extend(places_.back());
        }
      }
    }
  }

  /// Where a place of the box comes from.
  geometry::Vec3 at(const geometry::Vec3& p) const {
    std::array<std::int64_t, 3> cell{};
    geometry::Vec3 t;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      const double x = p[axis] / lattice_mm - static_cast<double>(first_[a]);
      cell[a] = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(x)), 0, count_[a] - 2);
      t[axis] = x - static_cast<double>(cell[a]);
    }
    const auto at = static_cast<std::size_t>(cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]));
    const auto row = static_cast<std::size_t>(count_[0]), plane = row * static_cast<std::size_t>(count_[1]);
    const auto along = [&](std::size_t n) -> geometry::Vec3 {
      return (1.0 - t.x()) * places_[n] + t.x() * places_[n + 1];
    };
    const auto across = [&](std::size_t n) -> geometry::Vec3 {
      return (1.0 - t.y()) * along(n) + t.y() * along(n + row);
    };
    return (1.0 - t.z()) * across(at) + t.z() * across(at + plane);
  }

  const geometry::Box3& from() const { return from_; }  ///< holds all that the box comes from
  /// Of all that the box comes from, the farthest from a place.
  double reach(const geometry::Vec3& place) const {
    double most = 0.0;
    for (const geometry::Vec3& one : places_) most = std::max(most, (one - place).squaredNorm());
    return std::sqrt(most);
  }

 private:
  static constexpr double lattice_mm = 1.0;
  std::array<std::int64_t, 3> first_{}, count_{};
  std::vector<geometry::Vec3> places_;
  geometry::Box3 from_;
};

}  // namespace ostia::phantom
