#pragma once
/// \file The inside of a remeshed lumen filled, and the gate that it must pass.

#include "stages.h"

#include "ostia/meshing/clip.h"
#include "ostia/meshing/sizing.h"
#include "ostia/pipeline/model.h"

#include <optional>
#include <vector>

namespace ostia::pipeline {

/// Where a stage's share of the progress ends; measured on coronary trees of 0.1 to 1 million triangles.
struct Shares {
  double cut, axes, caps, remeshing, tetrahedra;
};

/// The cut lumen before and after extensions were added to it.
struct Extended {
  meshing::ClippedSurface before;
  geometry::TriMesh after;
};

/// Half the width of the vessel at each point of the wall, for what a mesh may be off there. A crevice of a
/// rough wall is no vessel: nothing is narrower than a third of what the nearest axis has.
std::vector<double> vessel_widths(const geometry::TriMesh& surface, const meshing::TubeFunction& tube,
                                  const core::TaskContext& task);

/// Fills `out.surface`, the remeshed `capped`, and judges the mesh. Folds of the wall that are too sharp for
/// layers are opened (meshing::open_folds), wider where the gate still finds fault; what is best is kept.
/// Throws what fill_volume throws at the last attempt.
void fill_and_judge(const geometry::FacedSurface& capped, const std::optional<Extended>& extended,
                    const meshing::TubeFunction& tube, const ModelOptions& options, const Shares& shares,
                    Stages& stages, MeshedLumen& out);

}  // namespace ostia::pipeline
