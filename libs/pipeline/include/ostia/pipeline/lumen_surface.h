#pragma once
/// \file The surface of a segmented lumen with the topology that a vessel has.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// Handles of a closed manifold surface, all parts together: 0 for vessels, however they branch.
std::int64_t handles_of(const geometry::TriMesh& closed);

struct LumenSurface {
  geometry::TriMesh mesh;             ///< closed, outward
  std::vector<std::string> warnings;  ///< handles found, and what became of them
};

/// The surface of the level set about the seeds (segmentation::surface_of). Where noise or a stent's struts
/// have given it handles, the level set is smoothed by the least of 0.5, 0.75 ... 1.5 voxels (Gaussian) that
/// takes them away.
LumenSurface lumen_surface(const imaging::FloatVolume& level_set, const std::vector<geometry::Vec3>& seeds_mm,
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
