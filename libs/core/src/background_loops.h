#pragma once
/// \file Loops of work beside a window, which runs with the same speed meanwhile.

#include <cstddef>
#include <functional>

namespace ostia::core::detail {

/// Calls run(i) for each i in [0, count) in the calling thread and up to `threads` - 1 others of low
/// priority, which are kept for such loops alone: oneTBB's serve whoever asks with one priority, and a thread
/// without rights cannot raise its own again. Loops within run(i) may use it, too. An exception is rethrown
/// here.
void run_in_background(std::size_t count, int threads, const std::function<void(std::size_t)>& run);

}  // namespace ostia::core::detail
