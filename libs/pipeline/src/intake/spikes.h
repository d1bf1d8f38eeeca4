#pragma once
/// \file Single points of a surface that stand far out of it, or stab through it.

#include "intake/crossings.h"

#include "ostia/geometry/tri_mesh.h"

#include <cstddef>

namespace ostia::pipeline {

/// A spike is a point that stands off its neighbours' middle by more than their mean distance from it, and
/// whose triangles have three times the area of their ring or more: no vessel's tip is one point so steep.
bool has_spikes(const geometry::TriMesh& mesh);

/// Moves them to where the surface about them bends as it does next to them. Where a point's triangles
/// intersect others, half as much area is enough. Points on borders stay.
struct PulledIn {
  std::size_t count = 0;     ///< of points that were moved
  KnownCrossings crossings;  ///< of the mesh as it is afterwards, where the last look moved nothing
};
PulledIn pull_in_spikes(geometry::TriMesh& mesh);

}  // namespace ostia::pipeline
