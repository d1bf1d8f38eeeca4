#pragma once
/// \file What `ostia info` and `ostia convert` do with trees and other networks of vessels.

#include "commands.h"

namespace ostia::app {

/// Points, segments, branches, roots, ends, lengths, radii and faults on standard output.
ExitCode tree_info(const InfoOptions& options, const core::TaskContext& task);

/// True where `options` converts a network; false for centerlines between their own formats, which keep
/// their vessels' names, and for all else.
bool converts_tree(const ConvertCommand& options);
ExitCode convert_tree(const ConvertCommand& options, const core::TaskContext& task);

}  // namespace ostia::app
