#pragma once
/// \file What the processor that the program runs on can do.

namespace ostia::core {

/// Whether it takes AVX2 instructions; false on other processors than x86-64. Asked of it once.
bool has_avx2();

/// Of two functions that give the same, what the one for this processor gives: loops are compiled for both
/// (ostia_avx2_sources in cmake/OstiaTargets.cmake), and chosen when the program runs.
template <class Make>
auto best_for_processor(Make* avx2, Make* plain) {
  return has_avx2() ? avx2() : plain();
}

}  // namespace ostia::core
