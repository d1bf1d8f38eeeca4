#pragma once
/// \file A scene on a grid of voxels: materials at the centres, and partial volumes where they change.

#include "scan/point_spread.h"

#include "ostia/core/task_context.h"
#include "ostia/phantom/scan.h"
#include "ostia/phantom/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::phantom {

/// A voxel that was sampled in pieces.
struct FineVoxel {
  std::int32_t i = 0, j = 0, k = 0;  ///< in the painted grid
};

/// Some slices of the painted grid.
struct Slab {
  std::int64_t first = 0, count = 0;  ///< slices
  std::vector<float> centre_hu;       ///< at the voxels' centres
  std::vector<std::uint8_t> labels;   ///< at the voxels' centres
  std::vector<float> mean_hu;         ///< over the voxels; blurred in place later
  /// By block: what is there, and the voxels sampled in pieces with their pieces' differences from the mean.
  std::vector<std::unique_ptr<const ScenePart>> parts;
  std::vector<std::vector<FineVoxel>> fine;
  std::vector<std::vector<float>> differences;
};

class Painter {
 public:
  /// `grid` is the options' grid with `margin` more voxels on every side.
  Painter(const Scene& scene, const ScanOptions& options, const imaging::Geometry& grid,
          std::array<std::int64_t, 3> margin);
  /// Labels and HU at the centres of the voxels of some slices.
  Slab centres(std::int64_t first, std::int64_t count, const core::TaskContext& task) const;
  /// Partial volumes. The neighbouring slabs' centres are looked at; null beyond the grid.
  void refine(Slab& slab, const Slab* before, const Slab* after, const core::TaskContext& task) const;

 private:
  struct Block {
    std::int64_t i0, i1, j0, j1;
  };
  Block block(std::size_t index) const;
  std::size_t blocks() const { return static_cast<std::size_t>(blocks_i_ * blocks_j_); }
  geometry::Box3 box(const Block& block, std::int64_t first, std::int64_t count) const;
  geometry::Vec3 place(const geometry::Vec3& index) const;
  void refine_block(Slab& slab, std::size_t index, const Slab* before, const Slab* after) const;
  bool sample_pieces(const ScenePart& part, const geometry::Vec3& index, const Material& centre, bool fine,
                     std::vector<float>& values) const;

  const Scene& scene_;
  ScanOptions options_;
  imaging::Geometry grid_;
  std::array<std::int64_t, 3> margin_;
  std::int64_t blocks_i_ = 0, blocks_j_ = 0;
  geometry::Mat3 step_;  ///< from a change of index to mm
};

}  // namespace ostia::phantom
