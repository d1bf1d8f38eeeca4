#pragma once
/// \file Small networks of vessels for the tests.

#include "ostia/geometry/vessel_graph.h"

namespace ostia::geometry {

/// A trunk from 0 over 1 to 2, which forks to 3 and to 4 and 5; in order, sound.
inline VesselGraph y_graph() {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {3, 4, 0}, {3, 4, 12}, {3, 4, 14}, {3, 5, 12}, {3, 5, 13}};
  graph.edges = {
      {0, 1, 2.0, 1.75}, {1, 2, 1.75, 1.5}, {2, 3, 1.25, 1.0}, {2, 4, 0.75, 0.75}, {4, 5, 0.5, 0.25}};
  graph.references = {11, 12, 13, 14, 15};
  return graph;
}

}  // namespace ostia::geometry
