#pragma once
/// \file The image at the spacing that large vessels and chambers are looked at with.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

namespace ostia::coronary {

/// The image as cubes of about the working spacing; one that is coarser stays as it is.
imaging::ImageVolume working_image(const imaging::ImageVolume& image, double spacing_mm,
                                   const core::TaskContext& task);

}  // namespace ostia::coronary
