#pragma once
/// \file Hexahedra as prisms, for all that knows tetrahedra and prisms alone.

#include "ostia/geometry/hex_mesh.h"

namespace ostia::geometry {

/// Adds each hexahedron (corners among the mesh's points) as two prisms, of the same volume together. Both
/// sides of a pair of opposite ones are cut along the same diagonal, that of the shorter length where there
/// is a choice, and the neighbours behind them likewise, along the whole row: rows that begin at an inlet or
/// outlet come first, as hexahedra are swept along vessels, then rows along the corners' own third direction.
/// The boundary's quadrilaterals that are cut become two triangles each, of the same face. Throws
/// InvalidInput for corners that are no points, GeometryError where rows cross such that no cut suits all
/// neighbours (the quadrilaterals of the mesh's own prisms are not cut).
void add_as_prisms(const std::vector<Hexahedron>& hexahedra, MixedMesh& mesh);

/// A mesh of hexahedra with its boundary as a mesh of prisms, cut as above.
MixedMesh as_prisms(HexMesh mesh);

}  // namespace ostia::geometry
