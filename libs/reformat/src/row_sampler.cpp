#include "row_sampler.h"

#include "row_loops.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

namespace ostia::reformat {
namespace {

// Places this close to a limit (in voxels) are left to the careful way: rounding must not lead outside.
constexpr double slack = 1e-7;

using Float4 [[gnu::vector_size(16)]] = float;

template <class T>
struct FourOf;
template <>
struct FourOf<std::int16_t> {
  using Type [[gnu::vector_size(8)]] = std::int16_t;
};
template <>
struct FourOf<std::uint8_t> {
  using Type [[gnu::vector_size(4)]] = std::uint8_t;
};
template <>
struct FourOf<float> {
  using Type [[gnu::vector_size(16)]] = float;
};

template <class T>
inline Float4 four(const T* voxels) {
  typename FourOf<T>::Type values;
  __builtin_memcpy(&values, voxels, sizeof(values));
  return __builtin_convertvector(values, Float4);
}

/// Catmull-Rom weights of the voxels at -1, 0, 1, 2.
inline Float4 weights(float t) {
  constexpr Float4 c1{-0.5F, 0.0F, 0.5F, 0.0F}, c2{1.0F, -2.5F, 2.0F, -0.5F}, c3{-0.5F, 1.5F, -1.5F, 0.5F};
  constexpr Float4 c0{0.0F, 1.0F, 0.0F, 0.0F};
  return ((c3 * t + c2) * t + c1) * t + c0;
}

inline float mix(float a, float b, float f) {
  return a + f * (b - a);
}

}  // namespace

template <class T>
void require_voxels(const imaging::Volume<T>& image, const char* what) {
  if (!image.voxels.empty() && static_cast<std::int64_t>(image.voxels.size()) == image.geometry.voxels())
    return;
  throw InvalidInput(std::string("cannot ") + what + " an image of " + std::to_string(image.voxels.size()) +
                     " voxels whose size says " + std::to_string(image.geometry.voxels()));
}

template <class T>
RowSampler<T>::RowSampler(const imaging::Volume<T>& image, imaging::Interpolation how)
    : image_(image), how_(how) {}

template <class T>
typename RowSampler<T>::Range RowSampler<T>::clipped(const Line& line, double low_margin, double high_margin,
                                                     Range range) const {
  for (int axis = 0; axis < 3 && range.first < range.last; ++axis) {
    const double low = low_margin;
    const double high =
        static_cast<double>(image_.geometry.size[static_cast<std::size_t>(axis)]) - high_margin;
    const double a = line.start[axis], b = line.step[axis];
    const auto inside = [&](std::int64_t i) {
      const double x = a + static_cast<double>(i) * b;
      return x >= low && x <= high;
    };
    if (b != 0.0) {
      // One more on either side than the quotient says, then the exact test: rounding of the quotient is off
      // by less than one.
      const double enter = ((b > 0.0 ? low : high) - a) / b, leave = ((b > 0.0 ? high : low) - a) / b;
      const double first = static_cast<double>(range.first), last = static_cast<double>(range.last);
      range.first = static_cast<std::int64_t>(std::clamp(std::floor(enter) - 1.0, first, last));
      range.last = static_cast<std::int64_t>(
          std::clamp(std::ceil(leave) + 2.0, static_cast<double>(range.first), last));
    }
    while (range.first < range.last && !inside(range.first)) {
      ++range.first;
      if (b == 0.0) range.first = range.last;
    }
    while (range.first < range.last && !inside(range.last - 1)) --range.last;
  }
  return range;
}

template <class T>
void RowSampler<T>::near_border(const Line& line, Range range, float* out) const {
  for (std::int64_t i = range.first; i < range.last; ++i) {
    const Vec3 at = line.start + static_cast<double>(i) * line.step;
    out[i] = static_cast<float>(imaging::sample(image_, image_.geometry.world(at), how_));
  }
}

template <class T>
void RowSampler<T>::trilinear(const Line& line, Range range, float* out) const {
  const std::int64_t dy = image_.geometry.size[0], dz = dy * image_.geometry.size[1];
  const T* const voxels = image_.voxels.data();
  std::int64_t begin = range.first;
  if constexpr (std::is_same_v<T, std::int16_t>)
    if (image_.voxels.size() < (std::size_t{1} << 31)) {
      const VoxelRow row{{line.start[0], line.start[1], line.start[2]},
                         {line.step[0], line.step[1], line.step[2]}};
      begin = row_loops().trilinear(voxels, dy, dz, row, range.first, range.last, out);
    }
  for (std::int64_t i = begin; i < range.last; ++i) {
    const double n = static_cast<double>(i);
    const double x = line.start[0] + n * line.step[0], y = line.start[1] + n * line.step[1],
                 z = line.start[2] + n * line.step[2];
    const int cx = static_cast<int>(x), cy = static_cast<int>(y), cz = static_cast<int>(z);
    const float fx = static_cast<float>(x - cx), fy = static_cast<float>(y - cy),
                fz = static_cast<float>(z - cz);
    const T* p = voxels + cx + cy * dy + cz * dz;
    const auto plane = [&](const T* q) {
      const auto at = [q](std::int64_t k) { return static_cast<float>(q[k]); };
      return mix(mix(at(0), at(1), fx), mix(at(dy), at(dy + 1), fx), fy);
    };
    out[i] = mix(plane(p), plane(p + dz), fz);
  }
}

template <class T>
void RowSampler<T>::cubic(const Line& line, Range range, float* out) const {
  const std::int64_t dy = image_.geometry.size[0], dz = dy * image_.geometry.size[1];
  const T* const voxels = image_.voxels.data();
  for (std::int64_t i = range.first; i < range.last; ++i) {
    const double n = static_cast<double>(i);
    const double x = line.start[0] + n * line.step[0], y = line.start[1] + n * line.step[1],
                 z = line.start[2] + n * line.step[2];
    const int cx = static_cast<int>(x), cy = static_cast<int>(y), cz = static_cast<int>(z);
    const Float4 wx = weights(static_cast<float>(x - cx)), wy = weights(static_cast<float>(y - cy)),
                 wz = weights(static_cast<float>(z - cz));
    const T* p = voxels + (cx - 1) + (cy - 1) * dy + (cz - 1) * dz;
    Float4 sum{};
    for (int k = 0; k < 4; ++k, p += dz) {
      const Float4 plane =
          wy[0] * four(p) + wy[1] * four(p + dy) + wy[2] * four(p + 2 * dy) + wy[3] * four(p + 3 * dy);
      sum += wz[k] * plane;
    }
    sum *= wx;
    out[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
}

template <class T>
void RowSampler<T>::row(const Vec3& start, const Vec3& step, std::span<float> out) const {
  std::fill(out.begin(), out.end(), std::numeric_limits<float>::quiet_NaN());
  const imaging::Geometry& grid = image_.geometry;
  const Line line{grid.index(start), (grid.direction.transpose() * step).cwiseQuotient(grid.spacing)};
  if (!line.start.allFinite() || !line.step.allFinite()) return;
  // A row that ends on the image's border is not to lose its last pixel to rounding.
  const Range held = clipped(line, -0.5 - 1e-9, 0.5 - 1e-9, {0, static_cast<std::int64_t>(out.size())});
  Range free{held.first, held.first};
  if (how_ == imaging::Interpolation::trilinear) free = clipped(line, slack, 1.0 + slack, held);
  if (how_ == imaging::Interpolation::cubic) free = clipped(line, 1.0 + slack, 2.0 + slack, held);
  if (free.first >= free.last) free = {held.last, held.last};
  near_border(line, {held.first, free.first}, out.data());
  if (how_ == imaging::Interpolation::trilinear) trilinear(line, free, out.data());
  if (how_ == imaging::Interpolation::cubic) cubic(line, free, out.data());
  near_border(line, {free.last, held.last}, out.data());
}

#define OSTIA_ROW_SAMPLER(T)    \
  template class RowSampler<T>; \
  template void require_voxels(const imaging::Volume<T>&, const char*);
OSTIA_ROW_SAMPLER(std::int16_t)
OSTIA_ROW_SAMPLER(std::uint8_t)
OSTIA_ROW_SAMPLER(float)
#undef OSTIA_ROW_SAMPLER

}  // namespace ostia::reformat
