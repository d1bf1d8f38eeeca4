#pragma once
/// \file The part of a synthetic patient that experiments scan.

#include "ostia/imaging/volume.h"
#include "ostia/phantom/phantom_case.h"

namespace ostia::experiments {

/// From now on the case is scanned on the heart's field alone (15 mm about the tree, and the root with the
/// beginning of the aorta): the grid is set, and blur and noise are made no finer than it can hold.
/// `least_voxels`: of the blur in the plane.
void scan_heart_field(phantom::CasePlan& plan, double voxel_mm, double slice_mm, double least_voxels = 0.5);

/// A case that is scanned so, its slices closer than they are thick, as they are usually reconstructed.
phantom::CasePlan plan_on_heart_field(const phantom::CaseOptions& patient, double voxel_mm);

}  // namespace ostia::experiments
