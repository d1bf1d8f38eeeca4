#pragma once
/// \file Vessels that overlap beside their forks give way to each other.

#include "base_mesh.h"

#include <utility>
#include <vector>

namespace ostia::reconstruction {

/// Narrows the branches of each pair of triangles (two a quadrilateral) near the place where they meet, and
/// parts their axes a little.
void give_way(std::vector<Tube>& tubes, const QuadMesh& mesh,
              const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs);

}  // namespace ostia::reconstruction
