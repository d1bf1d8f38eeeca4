// Compiled with -mavx2 on x86-64 (ostia_avx2_sources).
#include "boundary/edge_loops_rows.h"

namespace ostia::segmentation::detail {

EdgeLoop edge_loop_avx2() {
  return edge_rows::edge_loop_here;
}

}  // namespace ostia::segmentation::detail
