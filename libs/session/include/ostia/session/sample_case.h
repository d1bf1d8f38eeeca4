#pragma once
/// \file A case to try things on: a synthetic patient.

#include "ostia/core/task_context.h"
#include "ostia/phantom/presets.h"

#include <filesystem>

namespace ostia::session {

struct SampleCase {
  std::filesystem::path image, case_file;
};

/// In `folder`: `image.nrrd`, a synthetic CT angiogram of known truth, and `sample.ostia`, its tree with
/// walls found in the image. What is there already is used. The folder appears whole or not at all. Throws
/// IoError, ResourceError, Cancelled.
SampleCase sample_case(const std::filesystem::path& folder, phantom::Preset preset = phantom::Preset::full,
                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
