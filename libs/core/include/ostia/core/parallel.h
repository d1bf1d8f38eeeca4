#pragma once
/// \file Parallel loops whose results do not depend on the number of threads.

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace ostia::core {

/// Upper bound on the threads that parallel loops use from now on; 0 means all cores. Process-wide.
void set_max_threads(int threads);
int max_threads();

/// For the threads of work beside a window: the calling thread, and those that it starts from now on, leave
/// the processor to others where it is short. `start_loop_threads` comes before, in a thread of full
/// priority, or the threads of parallel loops would be among them.
void lower_thread_priority();
/// Starts the threads of parallel loops.
void start_loop_threads();

/// Calls body(first, last) on consecutive chunks of [0, count) of `grain` items (the last may be shorter).
/// The chunks do not depend on the number of threads. An exception thrown by a chunk is rethrown here.
void parallel_chunks(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t first, std::size_t last)>& body);

/// Calls body(i) for each i in [0, count).
template <class Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  parallel_chunks(count, grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) body(i);
  });
}

/// Reduces chunk results in chunk order: combine(combine(init, map(chunk 0)), map(chunk 1)) ...
/// The same bits for any number of threads.
template <class T, class Map, class Combine>
T parallel_reduce(std::size_t count, std::size_t grain, T init, const Map& map, const Combine& combine) {
  if (grain == 0) grain = 1;
  std::vector<T> partial((count + grain - 1) / grain, init);
  parallel_chunks(count, grain,
                  [&](std::size_t first, std::size_t last) { partial[first / grain] = map(first, last); });
  T result = init;
  for (const T& p : partial) result = combine(std::move(result), p);
  return result;
}

}  // namespace ostia::core
