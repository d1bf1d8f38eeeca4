#include "row_loops.h"

#include "ostia/core/processor.h"

namespace ostia::reformat {
namespace {

std::int64_t no_rows(const std::int16_t*, std::int64_t, std::int64_t, const VoxelRow&, std::int64_t first,
                     std::int64_t, float*) {
  return first;
}

void larger_plain(const float* layer, std::int64_t count, float* out) {
  for (std::int64_t i = 0; i < count; ++i)
    if (layer[i] > out[i] || out[i] != out[i]) out[i] = layer[i];
}
void smaller_plain(const float* layer, std::int64_t count, float* out) {
  for (std::int64_t i = 0; i < count; ++i)
    if (layer[i] < out[i] || out[i] != out[i]) out[i] = layer[i];
}

}  // namespace

RowLoops row_loops_plain() {
  return {no_rows, larger_plain, smaller_plain};
}

const RowLoops& row_loops() {
  static const RowLoops loops = core::best_for_processor(row_loops_avx2, row_loops_plain);
  return loops;
}

}  // namespace ostia::reformat
