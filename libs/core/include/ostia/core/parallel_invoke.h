#pragma once
/// \file Two pieces of work at the same time.

#include "ostia/core/parallel.h"

namespace ostia::core {

/// Does both, at the same time where there is a thread to spare. What either throws is rethrown here.
template <class First, class Second>
void parallel_invoke(const First& first, const Second& second) {
  parallel_chunks(2, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) i == 0 ? first() : second();
  });
}

}  // namespace ostia::core
