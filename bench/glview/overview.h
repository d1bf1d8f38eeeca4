#pragma once
/// \file Where the benchmarks of trees look from.

#include "ostia/glview/tree_camera.h"

namespace ostia::glview {

/// All of the tree in a picture of that size, and then so many times nearer.
inline TreeCamera overview(const geometry::SegmentBlocks& blocks, int width, int height, double nearer) {
  TreeCamera eye;
  eye.width_px = width;
  eye.height_px = height;
  eye = fitted(eye, blocks.low(), blocks.high());
  eye.distance_mm /= nearer;
  return eye;
}

}  // namespace ostia::glview
