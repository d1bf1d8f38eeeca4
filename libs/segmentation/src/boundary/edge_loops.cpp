#include "boundary/edge_loops_rows.h"

#include "ostia/core/processor.h"

namespace ostia::segmentation::detail {

EdgeLoop edge_loop_plain() {
  return edge_rows::edge_loop_here;
}

EdgeLoop edge_loop() {
  static const EdgeLoop loop = core::best_for_processor(edge_loop_avx2, edge_loop_plain);
  return loop;
}

}  // namespace ostia::segmentation::detail
