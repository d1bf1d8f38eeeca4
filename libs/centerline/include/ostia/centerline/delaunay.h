#pragma once
/// \file Delaunay tetrahedra of a point set, as plain arrays.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vec.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::centerline {

/// The finite cells of a Delaunay triangulation.
struct Delaunay {
  std::vector<std::array<std::int32_t, 4>> cells;  ///< indices of points, positively oriented
  std::vector<std::array<std::int32_t, 4>>
      neighbours;                  ///< the cell beyond the face opposite corner i, -1 at the hull
  std::size_t dropped_points = 0;  ///< points equal to an earlier one
};

/// Exact predicates: no finite point is lost unless it equals another bit for bit. Cospherical points are
/// resolved by symbolic perturbation, and the same points give the same cells in the same order. Throws
/// InvalidInput for a point that is not finite, GeometryError for fewer than four points or points that all
/// lie in a plane.
Delaunay delaunay(const std::vector<geometry::Vec3>& points, const core::TaskContext& task = core::no_task());

/// The same, begun in a thread of its own before anyone asks; given up when the handle goes.
class DelaunayAhead {
 public:
  explicit DelaunayAhead(std::vector<geometry::Vec3> points);
  ~DelaunayAhead();
  DelaunayAhead(const DelaunayAhead&) = delete;
  DelaunayAhead& operator=(const DelaunayAhead&) = delete;

  /// Waits for it, once, where it is of these very points; nothing where it is of others, or was taken
  /// before. Throws what `delaunay` throws.
  std::optional<Delaunay> take(const std::vector<geometry::Vec3>& points,
                               const core::TaskContext& task = core::no_task());

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace ostia::centerline
