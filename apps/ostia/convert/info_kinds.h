#pragma once
/// \file What `ostia info` says of the files and folders that Ostia itself writes.

#include "commands.h"

namespace ostia::app {

/// Whether `path` is one of these: a case, a volume mesh, a motion, a folder with a manifest.
bool is_own_kind(const std::filesystem::path& path);
/// Vessels, edits and measurements of a case; elements, volume and faces of a volume mesh; phases and cage of
/// a motion; command, warnings and files of a folder. Throws UsageError for --preview, and what reading
/// throws.
ExitCode own_kind_info(const InfoOptions& options, const core::TaskContext& task);

}  // namespace ostia::app
