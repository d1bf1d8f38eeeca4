#pragma once
/// \file Centerlines and trees: VTP and VTK polydata, CSV, markups, networks in; VTP, CSV and markups out.
/// World LPS, mm.

#include "ostia/geometry/branch_groups.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ostia::io {

/// VTP or legacy VTK polylines, the radius in `MaximumInscribedSphereRadius` (or `Radius`, `radius`); CSV
/// with the header `x,y,z,radius` and one line, several ones separated by an empty row or told apart by a
/// column `vessel`. Cells that share a `GroupIds` value are one segment; `CenterlineIds` makes the vessels.
/// Where cells are blanked (VMTK's branch extractor) a segment is a branch with the bifurcation before it;
/// what write_centerlines wrote comes back as the tree that it was, bit for bit. Without groups lines are
/// joined where they run through one place (1e-6 mm), and there is a vessel for each end, named after the
/// line that runs to it. Every network that read_graph reads is a tree, too, if it can be one. Markups
/// (.mrk.json): curves with a measurement `Radius`. Throws InvalidInput for a file without a radius, with
/// indices out of range, or with loops.
geometry::VesselTree read_centerlines(const std::filesystem::path& path);

/// Tracts and groups as a VTP or legacy VTK file has them, VMTK's or Ostia's; none where it is not split into
/// tracts. Throws as read_centerlines does.
std::optional<geometry::BranchedLines> read_branched_lines(const std::filesystem::path& path);

/// What is known along vessels besides their radius, by a vessel's id and the abscissa on its axis.
struct AlongVessels {
  std::string name;                                            ///< "Probability"
  std::function<double(std::int32_t vessel, double s_mm)> at;  ///< NaN where it is not known
};

/// VTP: a polyline for each tract of each vessel (geometry::branch_groups), with the arrays that VMTK's
/// scripts write and read: at points `MaximumInscribedSphereRadius`, `Abscissas` (mm from the root),
/// `ParallelTransportNormals`, `Curvature` (1/mm), `Torsion` (1/mm), `FrenetTangent`, `FrenetNormal`,
/// `FrenetBinormal`, and Ostia's `SegmentIds` (-1 at places that were put between the tree's points); on
/// cells `CenterlineIds`, `TractIds`, `Blanking`, `GroupIds`, `Length` (mm), `Tortuosity`; as field arrays
/// vessels' names in `VesselNames` and the first points of segments. CSV:
/// `vessel,x,y,z,radius,abscissa`. `along`: further arrays at points, and columns after these (an empty cell
/// where it is NaN). Markups: a curve for each vessel (curves_of), without them.
void write_centerlines(const std::filesystem::path& path, const geometry::VesselTree& tree,
                       const std::vector<AlongVessels>& along = {});

}  // namespace ostia::io
