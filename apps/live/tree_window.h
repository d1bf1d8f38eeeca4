#pragma once
/// \file A vessel tree in a window, or in pictures without one.

#include "tree_input.h"

#include "ostia/core/task_context.h"

namespace ostia::live {

/// Until it is closed. With --measure what was measured is printed at the end.
void show_tree(const TreeInput& input, const Options& options, const core::TaskContext& task);
/// One picture, or those of one turn about it.
void write_tree_pictures(const TreeInput& input, const Options& options, const core::TaskContext& task);

}  // namespace ostia::live
