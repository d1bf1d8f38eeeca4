#pragma once
/// \file Centerlines taken apart into branches and bifurcations by their inscribed spheres, as
/// vmtkbranchextractor does it. See docs/methods/bifurcations.md.

#include "ostia/geometry/line_place.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <vector>

namespace ostia::geometry {

/// A stretch of a vessel's line: of a branch, or (blanked) within a bifurcation.
struct Tract {
  std::int32_t group = 0;  ///< shared by the tracts of all vessels that run through the same stretch
  bool blanked = false;
  /// From end to end: the line's own points and, at the ends, places between them. Two at least.
  std::vector<LinePlace> places;
};

/// A vessel from the root to its end, and its tracts one after another: each begins where the last one ends.
struct BranchedLine {
  std::int32_t vessel = 0;  ///< its id
  Centerline axis;
  std::vector<std::int32_t> segments;  ///< of each point: the id of the tree's segment that runs up to it
  std::vector<Tract> tracts;
};

struct BranchedLines {
  std::vector<BranchedLine> lines;  ///< in the tree's order of vessels
  std::int32_t groups = 0;          ///< numbered from 0 in the order in which the lines come upon them
};

/// Where a vessel's line leaves the tube of another one that parts from it, it leaves the bifurcation; one
/// inscribed sphere upstream of there the bifurcation begins (Antiga & Steinman 2004). Of several vessels
/// that part at one place the last one left counts. Bifurcations that would overlap on any vessel are one. A
/// vessel that ends within the others' tubes has no branch of its own: its last tract is blanked. Throws
/// InvalidInput for a vessel without segments or with segments that are not there.
BranchedLines branch_groups(const VesselTree& tree);

/// A tract as a line of its own; abscissas and frames are those of the whole vessel.
Centerline tract_axis(const BranchedLine& line, const Tract& tract);

}  // namespace ostia::geometry
