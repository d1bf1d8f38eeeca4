#pragma once
/// \file Values of an image at equal steps along a straight line: a row of a picture.

#include "ostia/imaging/sampling.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace ostia::reformat {

using geometry::Vec3;

/// Along a row voxel coordinates are linear, so that the part of a row that needs no look at the borders is
/// known beforehand. Asked from many threads.
template <class T>
class RowSampler {
 public:
  /// The image must have voxels and outlive the sampler.
  RowSampler(const imaging::Volume<T>& image, imaging::Interpolation how);

  /// out[i] = the image at start + i * step; NaN where the image does not contain the place.
  void row(const Vec3& start, const Vec3& step, std::span<float> out) const;

 private:
  struct Range {
    std::int64_t first, last;  // [first, last)
  };
  struct Line {
    Vec3 start, step;  // in voxels
  };
  Range clipped(const Line& line, double low_margin, double high_margin, Range range) const;
  void near_border(const Line& line, Range range, float* out) const;
  void trilinear(const Line& line, Range range, float* out) const;
  void cubic(const Line& line, Range range, float* out) const;

  const imaging::Volume<T>& image_;
  imaging::Interpolation how_;
};

/// Throws InvalidInput for an image without voxels, or whose voxels do not fit its size.
template <class T>
void require_voxels(const imaging::Volume<T>& image, const char* what);

#define OSTIA_ROW_SAMPLER(T)           \
  extern template class RowSampler<T>; \
  extern template void require_voxels(const imaging::Volume<T>&, const char*);
OSTIA_ROW_SAMPLER(std::int16_t)
OSTIA_ROW_SAMPLER(std::uint8_t)
OSTIA_ROW_SAMPLER(float)
#undef OSTIA_ROW_SAMPLER

}  // namespace ostia::reformat
