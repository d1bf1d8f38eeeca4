#pragma once
/// \file Triangles small enough for the curvature of what they stand for.

#include "scan/sparse_march.h"

namespace ostia::phantom {

/// Splits edges whose middle is farther than 0.005 mm from the function's zero set, and puts the new vertices
/// on it; at creases (where the surface's normals at an edge's ends differ by more than 37 degrees, or the
/// middle is farther than `crease_mm`) nothing is split. A closed surface stays closed, and one
/// that does not cross itself stays so.
void refine_to(const ImplicitField& f, geometry::TriMesh& mesh, double crease_mm,
               const core::TaskContext& task);

}  // namespace ostia::phantom
