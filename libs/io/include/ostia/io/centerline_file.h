#pragma once
/// \file Centerlines and trees: VTP and VTK polydata, CSV in; VTP and CSV out. World LPS, mm.

#include "ostia/geometry/vessel_tree.h"

#include <filesystem>

namespace ostia::io {

/// VTP or legacy VTK polylines, the radius in `MaximumInscribedSphereRadius` (or `Radius`, `radius`); CSV
/// with the header `x,y,z,radius` and one line, several ones separated by an empty row or told apart by a
/// column `vessel`. Cells that share a `GroupIds` value are one segment; `CenterlineIds` makes the vessels;
/// without them each line is a vessel of one segment, and end points within 1e-6 mm are one node. Throws
/// InvalidInput for a file without a radius or with indices out of range.
geometry::VesselTree read_centerlines(const std::filesystem::path& path);

/// VTP: one polyline per vessel and segment with point arrays `MaximumInscribedSphereRadius`, `Abscissas` (mm
/// from the root), `ParallelTransportNormals`, `FrenetTangent`, `Curvature` (1/mm), `Torsion` (1/mm) and cell
/// arrays `CenterlineIds`, `GroupIds`, `TractIds`, `Blanking`; vessels' names in the field array
/// `VesselNames`. CSV: `vessel,x,y,z,radius,abscissa`.
void write_centerlines(const std::filesystem::path& path, const geometry::VesselTree& tree);

}  // namespace ostia::io
