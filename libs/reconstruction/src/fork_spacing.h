#pragma once
/// \file Forks that stand too close to each other, or whose branches leave side by side, are given room.

#include "joint.h"

#include "ostia/geometry/vessel_graph.h"

#include <cstdint>
#include <vector>

namespace ostia::reconstruction {

/// A network whose points may be moved, with what is known of its branches.
struct Network {
  explicit Network(const geometry::VesselGraph& given);
  double length(std::size_t branch) const;

  geometry::VesselGraph graph;
  geometry::GraphIncidence incidence;
  std::vector<geometry::GraphBranch> branches;
};

/// Branches at these joints (points of the graph) that are too short for what their two forks need, as where
/// a side branch ends within the wall of a wide stem, are stretched, and those that end within a neighbour
/// are turned aside; what lies distal moves along, ever less. Tells the branches that it changed, ascending.
std::vector<std::int32_t> make_room(Network& network, const std::vector<Tube>& tubes, const TubeEnds& ends,
                                    const std::vector<std::int32_t>& joints);

/// Bends the axes of branches that leave these joints side by side away from each other, until their walls
/// are clear of each other or they leave at 50 degrees; ends stay. Once is enough: again changes nothing.
void splay(std::vector<Tube>& tubes, const TubeEnds& ends, const std::vector<std::int32_t>& joints);

}  // namespace ostia::reconstruction
