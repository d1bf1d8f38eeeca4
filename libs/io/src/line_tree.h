#pragma once
/// \file Trees of named vessels out of the lines of a file.

#include "ostia/geometry/vessel_graph.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ostia::io {

/// One polyline of a file.
struct FileLine {
  std::vector<geometry::Vec3> points;
  std::vector<double> radius;
  std::int32_t vessel = 0, group = 0;
};
/// Of vessels by their numbers.
using VesselNames = std::map<std::int32_t, std::string>;

/// Segments from groups, vessels in the order they come: what the file says is joined.
geometry::VesselTree tree_of_groups(const std::vector<FileLine>& lines, const VesselNames& names);

/// For lines of which the file says nothing more: those that run through one place (1e-6 mm) are joined
/// there, pieces that several have are one segment, and there is a vessel for each end, named after the line
/// that runs to it. A part whose lines run into each other is turned away from its widest end. Where the
/// lines form loops each is a vessel of one segment, and only their ends are joined.
geometry::VesselTree tree_of_lines(const std::vector<FileLine>& lines, const VesselNames& names);

/// A network as trees, repaired first where it is none (geometry::repaired). Throws InvalidInput that names
/// the file for one that stays none.
geometry::VesselTree tree_of_network(geometry::VesselGraph graph, const std::filesystem::path& path);

}  // namespace ostia::io
