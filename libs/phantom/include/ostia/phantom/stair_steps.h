#pragma once
/// \file Where an image with steps between blocks of slices shows things.

#include "ostia/geometry/vec.h"
#include "ostia/phantom/scan.h"

namespace ostia::phantom {

/// Where a place of the true scene is seen in the image, LPS, mm: moved by the step of its block of slices as
/// far as it moves with the heart. The same place without steps.
geometry::Vec3 shown_at(const ScanOptions& options, const geometry::Vec3& place);

}  // namespace ostia::phantom
