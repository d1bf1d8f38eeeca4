// Compiled with -mavx2 on x86-64 (ostia_avx2_sources).
#include "vesselness/tube_loops_rows.h"

namespace ostia::segmentation::detail {

TubeLoops tube_loops_avx2() {
  return loops_here();
}

}  // namespace ostia::segmentation::detail
