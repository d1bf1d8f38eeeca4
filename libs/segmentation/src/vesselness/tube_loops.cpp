#include "vesselness/tube_loops_rows.h"

#include "ostia/core/processor.h"

namespace ostia::segmentation::detail {

TubeLoops tube_loops_plain() {
  return loops_here();
}

const TubeLoops& tube_loops() {
  static const TubeLoops loops = core::best_for_processor(tube_loops_avx2, tube_loops_plain);
  return loops;
}

}  // namespace ostia::segmentation::detail
