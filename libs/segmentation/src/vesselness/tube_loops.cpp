#include "vesselness/tube_loops_rows.h"

namespace ostia::segmentation::detail {

TubeLoops tube_loops_plain() {
  return loops_here();
}

const TubeLoops& tube_loops() {
#if defined(__x86_64__)
  static const TubeLoops loops = __builtin_cpu_supports("avx2") ? tube_loops_avx2() : tube_loops_plain();
#else
  static const TubeLoops loops = tube_loops_plain();
#endif
  return loops;
}

}  // namespace ostia::segmentation::detail
