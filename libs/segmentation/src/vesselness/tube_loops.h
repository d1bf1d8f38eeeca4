#pragma once
/// \file The vesselness's inner loops, over rows of voxels; compiled for two instruction sets, with the same
/// bits.

#include <cstddef>

namespace ostia::segmentation::detail {

/// weight x (sums[x + plus] - sums[x + minus]): a run of a row beside, from the running sums of its voxels.
struct RunTap {
  std::ptrdiff_t plus = 0;
  std::ptrdiff_t minus = 0;
  float weight = 0.0F;
};

/// Second derivatives of one row, the tube's answer, and its axis where the answer is larger than before.
struct TubeRow {
  const float* values = nullptr;  ///< the row; two neighbours on every side are read
  std::ptrdiff_t y = 0, z = 0;    ///< strides to the neighbouring rows
  float pure[3] = {};             ///< factor / (12 h^2) along x, y, z
  float mixed[3] = {};            ///< factor / (144 h h') for xy, xz, yz
  float gap_weight = 0.0F;
  float* answer = nullptr;
  float* best = nullptr;                         ///< the largest answer so far; only with axes
  float* axis[3] = {nullptr, nullptr, nullptr};  ///< unit vectors in the image's axes, or null
};

/// Rows are worked out in whole packs: buffers have room for up to 8 values more than `count`.
struct TubeLoops {
  /// out[x] = w[0] in[x] + sum over r of w[r] (in[x - r stride] + in[x + r stride]).
  void (*blur)(const float* in, std::ptrdiff_t stride, const float* weights, int radius, float* out,
               std::size_t count);
  /// out[x] = a[x] + b[x].
  void (*add)(const float* a, const float* b, float* out, std::size_t count);
  /// out[x] += sum over the taps.
  void (*runs)(const float* sums, const RunTap* taps, std::size_t tap_count, float* out, std::size_t count);
  void (*tube)(const TubeRow& row, std::size_t count);
};

/// The loops for this processor.
const TubeLoops& tube_loops();
TubeLoops tube_loops_plain();
TubeLoops tube_loops_avx2();  ///< for processors that have it

}  // namespace ostia::segmentation::detail
