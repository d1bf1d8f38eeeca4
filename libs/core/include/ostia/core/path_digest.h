#pragma once
/// \file How an input is known: by what is in it, not by where it lies or what it is called.

#include "ostia/core/task_context.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::core {

/// SHA-256 of a file's bytes; of a folder (a DICOM series) that of its files' digests in order, folders in it
/// included, so that neither names nor their order matter. Read in blocks, with progress by bytes. Throws
/// IoError (missing, unreadable), InvalidInput (neither file nor folder, or a folder without files),
/// Cancelled.
std::string sha256_of_path(const std::filesystem::path& path, const TaskContext& task = no_task());

/// That of a folder with just these files, wherever they lie; a path named twice counts once. Throws IoError
/// (missing, unreadable, no file), InvalidInput (none), Cancelled.
std::string sha256_of_files(const std::vector<std::filesystem::path>& files,
                            const TaskContext& task = no_task());

/// SHA-256 of each file's bytes, in the order given. Progress and errors as above.
std::vector<std::string> sha256_of_each(const std::vector<std::filesystem::path>& files,
                                        const TaskContext& task = no_task());
/// That of a folder whose files have these digests, in any order. Throws InvalidInput for none.
std::string sha256_of_digests(std::vector<std::string> digests);

}  // namespace ostia::core
