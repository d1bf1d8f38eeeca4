// Compiled with -mavx2 on x86-64 (ostia_avx2_sources).
#include "interpolation/kernel_loops.h"

namespace ostia::lumen {

KernelLoops kernel_loops_avx2(Kernel kernel) {
  return loops_for(kernel);
}

}  // namespace ostia::lumen
