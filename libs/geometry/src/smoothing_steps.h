#pragma once
/// \file The steps that smoothing filters of surfaces are made of.

#include "ostia/geometry/smoothing.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace ostia::geometry::detail {

/// The neighbours of each point that moves, one list after the other. A point that stays has none.
struct MovingNeighbours {
  std::vector<std::size_t> start;
  std::vector<std::int32_t> points;
  std::vector<char> on_border;  ///< one a point of the mesh

  bool moves(std::size_t point) const { return start[point] < start[point + 1]; }
};

/// `free`: which points may move; empty: all. Those of a border stay, or follow their neighbours on the
/// border alone.
MovingNeighbours moving_neighbours(const TriMesh& mesh, const std::vector<bool>& free, bool borders_move);

/// The filter's steps, all points at once.
void taubin_steps(const MovingNeighbours& around, const TaubinOptions& options, std::vector<Vec3>& points,
                  const core::TaskContext& task);

}  // namespace ostia::geometry::detail
