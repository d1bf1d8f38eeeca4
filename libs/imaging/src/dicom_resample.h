#pragma once
/// \file A stack of slices, each with its depth and its shift, on an even orthogonal grid.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <vector>

namespace ostia::imaging {

/// Where each slice of a stack lies: `depth_mm` ascending along the third axis, shifts along the first two,
/// all from the first.
struct SliceStack {
  std::vector<double> depth_mm, shift_x_mm, shift_y_mm;
};

/// The stack resampled: `slices` slices over the same depth, the plane grown so that no shifted slice is cut
/// off. In a plane Catmull-Rom (Keys 1981), between slices linear; where no slice reaches `outside` is set. A
/// slice that lies on the grid with a shift of whole pixels keeps its values.
ImageVolume restacked(const ImageVolume& image, const SliceStack& stack, std::int64_t slices,
                      std::int16_t outside, const core::TaskContext& task);

}  // namespace ostia::imaging
