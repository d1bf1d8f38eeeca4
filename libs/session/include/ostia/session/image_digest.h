#pragma once
/// \file How an image is known in everything that is saved.

#include "ostia/core/task_context.h"
#include "ostia/session/case_file.h"

#include <filesystem>

namespace ostia::session {

/// The digest of a file's bytes; of a folder (a DICOM series) that of its files' digests in order, folders in
/// it included, so that neither names nor their order matter. It is the one of pipeline::digest, read in
/// blocks with progress by bytes. The pseudonym is "image-" and eight digits. Throws IoError (missing,
/// unreadable), InvalidInput (neither file nor folder, or a folder without files), Cancelled.
ImageReference image_reference(const std::filesystem::path& path,
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
