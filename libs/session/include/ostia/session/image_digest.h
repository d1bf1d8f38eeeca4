#pragma once
/// \file How an image is known in everything that is saved.

#include "ostia/core/task_context.h"
#include "ostia/imaging/dicom.h"
#include "ostia/session/case_file.h"

#include <filesystem>

namespace ostia::session {

/// core::sha256_of_path of a file that is an image, or of a folder that holds one and nothing else. The
/// pseudonym is "image-" and eight digits. It is the one of pipeline::load, read in blocks with progress by
/// bytes. Throws IoError (missing, unreadable), InvalidInput (neither file nor folder, or a folder without
/// files), Cancelled.
ImageReference image_reference(const std::filesystem::path& path,
                               const core::TaskContext& task = core::no_task());

/// The same of a series, whatever lies beside it (imaging::series_digest).
ImageReference image_reference(const imaging::DicomSeries& series,
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
