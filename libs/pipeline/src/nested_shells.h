#pragma once
/// \file A lumen within the outer side of its wall.

#include "ostia/geometry/tri_mesh.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

/// Leaves out each part about another one that reaches along most of it: of two such shells the inner is the
/// lumen, the outer the outside of the wall. Returns a line for each, with its size and place.
std::vector<std::string> drop_outer_walls(std::vector<geometry::TriMesh>& parts);

}  // namespace ostia::pipeline
