#pragma once
/// \file Collects an initial region voxel by voxel.

#include "block_grid.h"
#include "fronts/fast_marching.h"

#include "ostia/segmentation/initial_region.h"

#include <vector>

namespace ostia::segmentation::detail {

/// Unites regions by the least value and crops the result.
class RegionBuilder {
 public:
  explicit RegionBuilder(const imaging::Geometry& geometry);

  /// One value; the least counts.
  void add(const Voxel& v, float value);
  /// The part of `values` < 0 that is connected with `from` by faces. False, and nothing added, when it does
  /// not hold `to`.
  bool add_connected(const BlockGrid<float>& values, const Voxel& from, const Voxel& to);
  /// Fills pits, and crops with so many voxels to spare. `level_set`, `region`, `voxels` and `touches_border`
  /// are set.
  InitialRegion finish(int margin_voxels);

 private:
  void fill_pits();

  imaging::Geometry geometry_;
  BlockGrid<float> values_;    ///< least value of each voxel, 1 where nothing was said
  std::vector<Voxel> inside_;  ///< where it is negative
};

}  // namespace ostia::segmentation::detail
