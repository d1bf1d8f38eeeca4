#pragma once
/// \file The wall of a lumen in triangles of the wanted size.

#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/pipeline/model.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

/// Remeshed to the sizes that follow the axes, in rounds, so that shape and volume stay. Where the wall is
/// too rough for triangles of its own size, sizes follow the distance to the axes alone, then the wall is
/// smoothed in its volume, then edges are half as long; each is told in `warnings`. Throws GeometryError
/// where triangles cross after all that, Cancelled.
meshing::RemeshedSurface remeshed_lumen(const geometry::FacedSurface& capped,
                                        const meshing::TubeFunction& tube, const geometry::VesselTree& axes,
                                        const ModelOptions& options, std::vector<std::string>& warnings,
                                        const core::TaskContext& task);

}  // namespace ostia::pipeline
