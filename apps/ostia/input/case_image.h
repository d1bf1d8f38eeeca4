#pragma once
/// \file The CT that a case was made with.

#include "ostia/core/task_context.h"
#include "ostia/pipeline/source.h"
#include "ostia/session/case_file.h"

#include <filesystem>

namespace ostia::app {

/// A DICOM folder or an image file, with the orientation that the case gives it; its warnings are logged.
/// Throws InvalidInput where the case was made with another one, and as pipeline::load_ct does.
pipeline::Source case_image(const std::filesystem::path& path, const session::CaseFile& file,
                            const core::TaskContext& task);

}  // namespace ostia::app
