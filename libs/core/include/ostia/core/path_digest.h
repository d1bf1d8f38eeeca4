#pragma once
/// \file How an input is known: by what is in it, not by where it lies or what it is called.

#include "ostia/core/task_context.h"

#include <filesystem>
#include <string>

namespace ostia::core {

/// SHA-256 of a file's bytes; of a folder (a DICOM series) that of its files' digests in order, folders in it
/// included, so that neither names nor their order matter. Read in blocks, with progress by bytes. Throws
/// IoError (missing, unreadable), InvalidInput (neither file nor folder, or a folder without files),
/// Cancelled.
std::string sha256_of_path(const std::filesystem::path& path, const TaskContext& task = no_task());

}  // namespace ostia::core
