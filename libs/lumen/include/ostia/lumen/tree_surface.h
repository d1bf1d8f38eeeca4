#pragma once
/// \file The tree's wall as triangles, over a sparse grid, and brought up to date block by block.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/lumen/scalar_field.h"
#include "ostia/lumen/tree_field.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::lumen {

struct TreeSurfaceOptions {
  double cell_mm = 0.25;           ///< [0.02, 2]
  double memory_limit_mib = 2048;  ///< at 256 bytes a cell that the wall passes; [1, 1e6]
  /// `update` leaves as it is what lies so near the field's wall still, [0, 0.01] mm; 0: all in the box of a
  /// change is asked again. What is stored or exported is always built anew (surface_of).
  double keep_within_mm = 0.0;
};
/// keep_within_mm of a wall on the screen: 1/2500 of a cell, a 200th of what the wall is measured by, and yet
/// far above what an edit changes some millimetres on.
inline constexpr double unseen_mm = 1e-4;
void validate(const TreeSurfaceOptions& options);  ///< throws InvalidInput

struct TreeSurfaceReport {
  std::size_t blocks = 0, blocks_made = 0;  ///< with wall in all, and polygonised in this call
  std::size_t triangles = 0;
  std::size_t evaluations = 0;  ///< places at which the field was asked
};

/// The wall in one block of 16^3 cells, for the screen: points on the block's faces are its neighbours', too.
/// A block that an update left alone hands out the same meshes.
struct TreeSurfacePart {
  std::array<std::int32_t, 3> block{0, 0, 0};  ///< from block * 16 cells on along each axis
  std::shared_ptr<const geometry::TriMesh> mesh;
};

/// The zero set of a field (a TreeField's is g = -0.5) by propagation from seeds over a sparse grid of
/// blocks. The grid's nodes are whole multiples of the cell from the world's origin. The wall is followed
/// from each cell that a seed lies in (or next to, where the cell of the seed is not crossed) through crossed
/// faces: pieces without a seed do not appear. Closed, a 2-manifold, outward; vertices on their grid edge's
/// root to a few micrometres, and 1e-3 of a cell off the nodes. The same for any number of threads.
class TreeSurface {
 public:
  explicit TreeSurface(const TreeSurfaceOptions& options = {});  ///< throws InvalidInput
  ~TreeSurface();
  TreeSurface(TreeSurface&&) noexcept;
  TreeSurface& operator=(TreeSurface&&) noexcept;

  /// All anew. Throws InvalidInput (no seed near the wall, a seed that is not finite or too far out, a value
  /// that is not a number), ResourceError (memory_limit_mib) and Cancelled; the surface is then empty.
  TreeSurfaceReport build(std::shared_ptr<const ScalarField> field, const std::vector<Vec3>& seeds,
                          const core::TaskContext& task = core::no_task());
  /// The field has changed inside `changed` alone: blocks that it touches are made again, and the wall is
  /// followed from them and from the seeds to where it now is. Closed and a 2-manifold after any sequence of
  /// updates. With keep_within_mm = 0 the result is what `build` would give, to the last bit where the field
  /// outside `changed` is the same to the last bit. Where it has changed by rounding errors there, values
  /// outside `changed` that were asked before are kept, so that nothing cracks. With a tolerance the same
  /// holds for bricks of 4^3 cells inside `changed` whose wall lies within it of the new field's. After an
  /// error, and on an empty surface, all is made anew.
  TreeSurfaceReport update(std::shared_ptr<const ScalarField> field, const Box3& changed,
                           const std::vector<Vec3>& seeds, const core::TaskContext& task = core::no_task());
  /// The wall as one surface with shared points.
  geometry::TriMesh mesh() const;
  /// The wall in parts, by block; nothing is copied.
  std::vector<TreeSurfacePart> parts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// min(0.25 mm, a quarter of the smallest distance of a sample that is not a cap's from its axis), but at
/// least 0.05 mm: the whole tree has one size of cells, and a throat below 0.2 mm would ask for too many.
double default_cell_mm(const LumenModel& model);

/// The wall of a stored model: solved afresh, polygonised with cells of `cell_mm`, or of default_cell_mm
/// where that is 0.
geometry::TriMesh surface_of(const LumenModel& model, double cell_mm = 0.0,
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::lumen
