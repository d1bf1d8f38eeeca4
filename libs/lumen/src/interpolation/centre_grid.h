#pragma once
/// \file Centres of kernels sorted into the cells of a regular grid.

#include "interpolation/kernel_sums.h"

#include "ostia/geometry/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::lumen {

/// Lists of centres are always in one order (by cell, then by index), whatever region they are gathered for.
class CentreGrid {
 public:
  CentreGrid(const std::vector<geometry::Vec3>& centres, const std::vector<double>& weights, double reach_mm);

  /// Arrays that are filled again for each region.
  struct Gathered {
    std::vector<double> x, y, z, weight, terms;
    std::size_t size = 0;
    CentreList list() const { return {x.data(), y.data(), z.data(), weight.data(), size}; }
  };
  /// All centres within reach of the box, and maybe some more next to them.
  void gather(const geometry::Box3& box, Gathered& out) const;

 private:
  decltype(KernelLoops::append_near) append_near_;
  std::vector<double> x_, y_, z_, weight_;  // and the padding
  std::vector<std::int32_t> start_;         // of each cell, x fastest; one more at the end
  geometry::Vec3 origin_ = geometry::Vec3::Zero();
  std::array<std::int64_t, 3> cells_{1, 1, 1};
  geometry::Vec3 last_cell_ = geometry::Vec3::Zero();
  double reach_ = 0.0, cell_ = 1.0, per_cell_ = 1.0;
  std::int64_t cell_along(int axis, double coordinate) const;
  double distance_to_cells(int axis, std::int64_t cell, double least, double most) const;
};

}  // namespace ostia::lumen
