#pragma once
/// \file Centerlines in VTK's files as VMTK's scripts split them: a cell for each tract of each vessel.

#include "line_tree.h"
#include "vtk/xml.h"

#include "ostia/io/centerline_file.h"

#include <filesystem>
#include <string>
#include <vector>

class vtkDataArray;

namespace ostia::io {

/// The radius of the points; null where there is none.
vtkDataArray* radius_array(vtkPolyData& data);
/// Of the field arrays VesselIds and VesselNames.
VesselNames vessel_names(vtkPolyData& data);

/// Whether its lines are tracts: they say which are blanked and some are, or they say of which of Ostia's
/// segments their points are.
bool has_tracts(vtkPolyData& data);

/// The lines that tree_of_groups makes a tree of. With Ostia's segments it is the tree that was written, bit
/// for bit. With VMTK's groups a segment is a branch with the bifurcation before it, as the first centerline
/// has it that runs there, led from the end of the branch before. Throws InvalidInput that names the file.
std::vector<FileLine> lines_of_tracts(vtkPolyData& data, const std::filesystem::path& path);

/// Groups and tracts as the file has them. Throws InvalidInput that names the file.
geometry::BranchedLines branched_lines_of(vtkPolyData& data, const std::filesystem::path& path);

/// The file that write_centerlines writes.
std::string tracts_text(const geometry::VesselTree& tree, const std::vector<AlongVessels>& along);

}  // namespace ostia::io
