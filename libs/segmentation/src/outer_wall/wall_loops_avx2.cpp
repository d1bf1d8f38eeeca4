// Compiled with -mavx2 on x86-64 (ostia_avx2_sources).
#include "outer_wall/wall_loops_rows.h"

namespace ostia::segmentation::detail {

WallLoop wall_loop_avx2() {
  return wall_rows::loop_here;
}

}  // namespace ostia::segmentation::detail
