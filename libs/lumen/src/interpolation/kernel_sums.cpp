#include "interpolation/kernel_loops.h"

#include "ostia/core/processor.h"

namespace ostia::lumen {

KernelLoops kernel_loops_baseline(Kernel kernel) {
  return loops_for(kernel);
}

KernelLoops kernel_loops(Kernel kernel) {
  return core::has_avx2() ? kernel_loops_avx2(kernel) : kernel_loops_baseline(kernel);
}

}  // namespace ostia::lumen
