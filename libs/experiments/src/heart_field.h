#pragma once
/// \file The part of a synthetic patient that experiments scan.

#include "ostia/imaging/volume.h"
#include "ostia/phantom/phantom_case.h"

namespace ostia::experiments {

/// The heart's field: 15 mm about the tree, and the root with the beginning of the aorta.
imaging::Geometry heart_field(const phantom::CasePlan& plan, double voxel_mm, double slice_mm);

}  // namespace ostia::experiments
