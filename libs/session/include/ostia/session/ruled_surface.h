#pragma once
/// \file A wall as rings about a vessel's axis, ruled between them.

#include "ostia/geometry/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ostia::session {

struct RuledSurface {
  std::int32_t vessel = -1;   ///< Workbench::no_vessel: of none
  std::vector<double> s_mm;   ///< of each ring on the vessel's axis; empty without a vessel
  geometry::TriMesh surface;  ///< ring k's points are the k-th part of its points
  geometry::Box3 box;
  std::size_t ring = 0;  ///< points of a ring of `surface`
};

}  // namespace ostia::session
