#pragma once
/// \file The DICOM series that an image of this machine is, and how it was taken.

#include "ostia/core/task_context.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/scan_technique.h"
#include "ostia/session/machine_state.h"

#include <optional>

namespace ostia::workstation {

/// Nothing for a file that is no DICOM, and where the series is not there any more. Any thread; throws as
/// imaging::scan_dicom does.
std::optional<imaging::DicomSeries> series_of_image(const session::KnownImage& image,
                                                    const core::TaskContext& task = core::no_task());

/// From the headers of its series; empty for a file that is no DICOM, an image that is not known, and where
/// the series is not there any more. Any thread; throws Cancelled alone.
imaging::ScanTechnique technique_of(const std::optional<session::KnownImage>& image,
                                    const core::TaskContext& task = core::no_task());

}  // namespace ostia::workstation
