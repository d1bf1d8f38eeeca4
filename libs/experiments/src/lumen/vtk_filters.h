#pragma once
/// \file Two filters of VTK that the papers compare with.

#include "ostia/geometry/tri_mesh.h"

namespace ostia::experiments {

/// vtkDecimatePro as it is preset: `share` of the triangles goes, if need be by tearing the surface open.
geometry::TriMesh decimated_by_vtk(const geometry::TriMesh& mesh, double share);
/// vtkSmoothPolyDataFilter: Laplacian, no feature edges.
geometry::TriMesh smoothed_by_vtk(const geometry::TriMesh& mesh, int iterations, double relaxation);

}  // namespace ostia::experiments
