#include "outer_wall/wall_loops_rows.h"

namespace ostia::segmentation::detail {

WallLoop wall_loop_plain() {
  return wall_rows::loop_here;
}

WallLoop wall_loop() {
#if defined(__x86_64__)
  static const WallLoop loop = __builtin_cpu_supports("avx2") ? wall_loop_avx2() : wall_loop_plain();
#else
  static const WallLoop loop = wall_loop_plain();
#endif
  return loop;
}

}  // namespace ostia::segmentation::detail
