#pragma once
/// \file The loops that a thick layer spends its time in, as the processor does them best. Results do not
/// depend on which are taken, to the last bit.

#include <cstdint>

namespace ostia::reformat {

/// A row of places within an image, in voxels: start + i * step.
struct VoxelRow {
  double start[3], step[3];
};

/// Values between eight voxels from place `first` on, as many as fit before `last`; returns where it stopped.
/// Each place needs its voxel and the next along each axis. `dy`, `dz`: voxels to the next row and slice, of
/// an image of fewer than 2^31 voxels.
using TrilinearLoop = std::int64_t (*)(const std::int16_t* voxels, std::int64_t dy, std::int64_t dz,
                                       const VoxelRow& row, std::int64_t first, std::int64_t last,
                                       float* out);
/// out[i] becomes the larger (or smaller) of both; a NaN gives way to the other.
using FoldLoop = void (*)(const float* layer, std::int64_t count, float* out);

struct RowLoops {
  TrilinearLoop trilinear;  ///< may stop at once
  FoldLoop larger, smaller;
};
/// For this processor.
const RowLoops& row_loops();

RowLoops row_loops_plain();
RowLoops row_loops_avx2();  ///< on a processor that has it alone

}  // namespace ostia::reformat
