#pragma once
/// \file Facets of the boundary, straight or bent.

#include "ostia/meshing/mixed_quality.h"

namespace ostia::meshing {

/// Sets the measures of the faces.
void measure_faces(const geometry::MixedMesh& mesh, MixedQuality& quality);

}  // namespace ostia::meshing
