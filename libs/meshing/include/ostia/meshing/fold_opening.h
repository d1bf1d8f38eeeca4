#pragma once
/// \file Sharp folds of a remeshed wall, opened so that layers can grow there. See
/// docs/methods/boundary-layer.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ostia::meshing {

struct FoldOptions {
  /// A fold: no direction at a point has this product with all its triangles, that is, no layer has a larger
  /// scaled Jacobian there at any thickness; (0, 0.5].
  double open_below = 0.11;
  double most_moved = 0.6;                 ///< of a point, in local edges; in (0, 2]
  int max_rounds = 40;                     ///< in [1, 1000]
  std::vector<geometry::Vec3> about = {};  ///< only folds near these places, mm; empty: all
  double about_mm = 5.0;                   ///< how near, > 0
};
void validate(const FoldOptions& options);

struct OpenedFolds {
  std::size_t folds = 0;   ///< points that were too sharp
  std::size_t closed = 0;  ///< of these, points that still are
  std::size_t moved = 0;   ///< points of the wall
  double most_moved_mm = 0.0;
  geometry::Vec3 place = geometry::Vec3::Zero();  ///< where a point moved most, mm
  std::vector<std::string> warnings;
};

/// Rounds off acute crotches and pleats of the walls: points there and around move towards their neighbours'
/// middle as long as that opens the sharpest fold beside them and no triangle gets worse than the gate
/// allows. Rings of caps stay, and so do all points where nothing is too sharp, bit for bit; triangles and
/// ids are the same. Nothing is changed where the wall would cross itself after it. Deterministic. Throws
/// InvalidInput (options, ids) and GeometryError (open, inward or crossing surface) as boundary_layer does,
/// Cancelled.
OpenedFolds open_folds(geometry::FacedSurface& surface, const FoldOptions& options = {},
                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
