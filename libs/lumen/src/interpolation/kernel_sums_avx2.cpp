// Compiled with -mavx2 on x86-64 (CMakeLists.txt).
#include "interpolation/kernel_loops.h"

namespace ostia::lumen {

KernelLoops kernel_loops_avx2(Kernel kernel) {
  return loops_for(kernel);
}

}  // namespace ostia::lumen
