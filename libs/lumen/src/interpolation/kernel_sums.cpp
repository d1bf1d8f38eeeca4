#include "interpolation/kernel_loops.h"

namespace ostia::lumen {

bool processor_has_avx2() {
#if defined(__GNUC__) && defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

KernelLoops kernel_loops_baseline(Kernel kernel) {
  return loops_for(kernel);
}

KernelLoops kernel_loops(Kernel kernel) {
  static const bool avx2 = processor_has_avx2();
  return avx2 ? kernel_loops_avx2(kernel) : kernel_loops_baseline(kernel);
}

}  // namespace ostia::lumen
