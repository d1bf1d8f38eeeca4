#include "outer_wall/wall_loops_rows.h"

#include "ostia/core/processor.h"

namespace ostia::segmentation::detail {

WallLoop wall_loop_plain() {
  return wall_rows::loop_here;
}

WallLoop wall_loop() {
  static const WallLoop loop = core::best_for_processor(wall_loop_avx2, wall_loop_plain);
  return loop;
}

}  // namespace ostia::segmentation::detail
