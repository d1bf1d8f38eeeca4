#pragma once
/// \file A vessel tree in a window, or in pictures without one.

#include "tree_input.h"

#include "ostia/core/task_context.h"

#include <functional>

namespace ostia::live {

/// Opens the window at once, shows what is being prepared and then the tree, until it is closed. `told` gets
/// the input when it has been read. With --measure what was measured is printed at the end. Throws as
/// `read_tree`, and ResourceError where no window with OpenGL 3.3 can be had.
void show_tree(const Options& options, const std::function<void(const TreeInput&)>& told,
               const core::TaskContext& task);
/// One picture, or those of one turn about it.
void write_tree_pictures(const TreeInput& input, const Options& options, const core::TaskContext& task);

}  // namespace ostia::live
