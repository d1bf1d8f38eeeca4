#pragma once
/// \file Networks of vessels: VTP, legacy VTK, SWC, CSV and GXL in, and OpenCCO's tables; VTP, SWC and CSV
/// out. In the file's own space and unit. The table of what each format keeps is in
/// docs/methods/vessel-graph.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_graph.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

/// A whole number for each segment, beside what a network has anyway: `Order`, `Element`.
struct SegmentValues {
  std::string name;
  std::vector<std::int32_t> values;  ///< as many as segments
};

/// A network as its file has it: faults are kept, for geometry::find_faults to count. A radius that the file
/// does not have is NaN; a segment that names a point which is not there names -1.
struct LoadedGraph {
  geometry::VesselGraph graph;  ///< with the segments' references
  /// What the references are: "line"; "cell" of a VTK file; "edge", from 1, of a GXL file in a single line;
  /// "reference" where the file has references of its own.
  std::string reference_name;
  std::vector<std::string> warnings;  ///< "the last line has no end: the file may be cut short"
};

/// True for .swc, .csv, .gxl, .xml, .vtk, .mrk.json, OpenCCO's three tables by their names, and for a .vtp
/// that has lines and no polygons (its head is read).
bool is_graph_file(const std::filesystem::path& path);

/// Reads by extension, in blocks where the format is text.
/// - .vtp, .vtk: each step of each line is a segment. Radii in the cell arrays `RadiusFrom` and `RadiusTo`,
/// or
///   in an array of the points or cells called `MaximumInscribedSphereRadius`, `radius` or `raio` (in any
///   case; `diameter`, too). The point ids say what is joined; a line's ends are also joined to what lies at
///   the very same place. Of lines with the same `GroupIds` and places one is read.
/// - .swc: seven columns `id type x y z radius parent`; the parent -1 makes a root.
/// - .csv by its header: `x1,y1,z1,radius1,x2,y2,z2,radius2`, a segment a row (`radius` for both);
///   with a column `reference` that is the segments' reference;
///   `id,x,y,z,radius,parent`, a sample a row as in SWC; `x,y,z,radius`, points along a line, several ones
///   separated by an empty row or told apart by a column `vessel`. Points of the first and the last kind that
///   are equal bit for bit are one; a way that vessels share is read once.
/// - .gxl, .xml: nodes with an attribute `position`, edges with `radius`.
/// - .mrk.json: 3D Slicer's curves with a measurement `Radius` (markups_file.h).
/// - .dat: one of OpenCCO's `vertex.dat`, `edges.dat` and `radius.dat`; the three lie in one folder.
/// Throws InvalidInput that names the file, the line and what was read up to it; IoError; Cancelled.
LoadedGraph read_graph(const std::filesystem::path& path, const core::TaskContext& task = core::no_task());

/// Writes by extension, whole or not at all. References become the array `Reference` of VTP's cells, the
/// column `reference` of CSV; so do `values` by their names. What the format could not hold is told: SWC has
/// one radius for a point, the one of the segment that arrives, no references and no values. Throws
/// InvalidInput for another extension, for indices out of range, for values or references that are not one a
/// segment and, for SWC, where a point has several parents or segments run in a circle; IoError; Cancelled.
std::vector<std::string> write_graph(const std::filesystem::path& path, const geometry::VesselGraph& graph,
                                     const std::vector<SegmentValues>& values,
                                     const core::TaskContext& task = core::no_task());
std::vector<std::string> write_graph(const std::filesystem::path& path, const geometry::VesselGraph& graph,
                                     const core::TaskContext& task = core::no_task());

}  // namespace ostia::io
