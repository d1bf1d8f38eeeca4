#pragma once
/// \file Slices decoded in a child process and rescaled to HU.

#include "dicom_series.h"

#include "ostia/core/task_context.h"

#include <cstdint>
#include <vector>

namespace ostia::imaging {

/// What had to be done to values on the way to whole HU.
struct Rescaled {
  std::int64_t clamped = 0;
  std::int64_t rounded = 0;
};

/// The slices in the order given, one plane of `geometry` each. Throws InvalidInput (naming the file),
/// ResourceError, Cancelled.
ImageVolume decode_slices(const std::vector<DicomSlice>& slices, const Geometry& geometry, Rescaled& count,
                          const core::TaskContext& task);

}  // namespace ostia::imaging
