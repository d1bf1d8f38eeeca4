#include "dicom_resample.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::imaging {
namespace {

/// Catmull-Rom weights of the four samples around a fraction t.
std::array<double, 4> weights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1.0, -1.5 * t3 + 2.0 * t2 + 0.5 * t,
          0.5 * t3 - 0.5 * t2};
}

/// Output index i is input index i + whole + fraction, the same for a whole slice.
struct Shift {
  std::int64_t whole = 0;
  std::array<double, 4> weight{0.0, 1.0, 0.0, 0.0};
  double fraction = 0.0;

  explicit Shift(double offset) {
    const double nearest = std::round(offset);
    if (std::abs(offset - nearest) < 1e-6) offset = nearest;
    whole = static_cast<std::int64_t>(std::floor(offset));
    fraction = offset - std::floor(offset);
    weight = weights(fraction);
  }
  /// Whether output i lies within half a pixel of the input's n pixels.
  bool inside(std::int64_t i, std::int64_t n) const {
    const double x = static_cast<double>(i + whole) + fraction;
    return x >= -0.5 && x <= static_cast<double>(n) - 0.5;
  }
};

struct Plane {
  const std::int16_t* voxels;
  std::int64_t nx, ny;
};

/// One input slice on the output plane: values and whether there is one.
void shifted(const Plane& in, const Shift& sx, const Shift& sy, std::int64_t nx, std::int64_t ny,
             std::vector<float>& values, std::vector<char>& there) {
  const auto clamped = [](std::int64_t i, std::int64_t n) { return std::clamp<std::int64_t>(i, 0, n - 1); };
  std::vector<double> row(static_cast<std::size_t>(in.nx));
  for (std::int64_t j = 0; j < ny; ++j) {
    const bool row_inside = sy.inside(j, in.ny);
    if (row_inside) {
      std::fill(row.begin(), row.end(), 0.0);
      for (int b = 0; b < 4; ++b) {
        const double w = sy.weight[static_cast<std::size_t>(b)];
        if (w == 0.0) continue;
        const std::int16_t* from = in.voxels + in.nx * clamped(j + sy.whole + b - 1, in.ny);
        for (std::size_t i = 0; i < row.size(); ++i) row[i] += w * from[i];
      }
    }
    for (std::int64_t i = 0; i < nx; ++i) {
      const std::size_t at = static_cast<std::size_t>(i + nx * j);
      there[at] = row_inside && sx.inside(i, in.nx);
      if (!there[at]) continue;
      double value = 0.0;
      for (int a = 0; a < 4; ++a) {
        value += sx.weight[static_cast<std::size_t>(a)] *
                 row[static_cast<std::size_t>(clamped(i + sx.whole + a - 1, in.nx))];
      }
      values[at] = static_cast<float>(value);
    }
  }
}

/// Pixels to add before and after an axis so that every shift fits.
struct Growth {
  std::int64_t before = 0, after = 0;
  Growth(const std::vector<double>& shift_mm, double spacing) {
    const auto [low, high] = std::minmax_element(shift_mm.begin(), shift_mm.end());
    before = static_cast<std::int64_t>(std::ceil(std::max(0.0, -*low) / spacing - 0.05));
    after = static_cast<std::int64_t>(std::ceil(std::max(0.0, *high) / spacing - 0.05));
  }
};

}  // namespace

ImageVolume restacked(const ImageVolume& image, const SliceStack& stack, std::int64_t slices,
                      std::int16_t outside, const core::TaskContext& task) {
  const Geometry& in = image.geometry;
  const Growth gx(stack.shift_x_mm, in.spacing[0]), gy(stack.shift_y_mm, in.spacing[1]);
  const double length = stack.depth_mm.back() - stack.depth_mm.front();
  ImageVolume out;
  Geometry& g = out.geometry;
  g = in;
  g.size = {in.size[0] + gx.before + gx.after, in.size[1] + gy.before + gy.after, slices};
  g.spacing[2] = length / static_cast<double>(slices - 1);
  g.origin = in.world(Vec3(-static_cast<double>(gx.before), -static_cast<double>(gy.before), 0.0));
  if (g.voxels() > (1LL << 32)) {
    throw InvalidInput("resampled, the series would have " + std::to_string(g.size[0]) + " x " +
                       std::to_string(g.size[1]) + " x " + std::to_string(g.size[2]) +
                       " voxels, which is more than can be held");
  }
  out.voxels.resize(static_cast<std::size_t>(g.voxels()));

  const std::int64_t plane = g.size[0] * g.size[1];
  const std::int64_t block = 8;
  for (std::int64_t first = 0; first < slices; first += block) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(first) / static_cast<double>(slices));
    core::parallel_for(static_cast<std::size_t>(std::min(block, slices - first)), 1, [&](std::size_t n) {
      const std::int64_t k = first + static_cast<std::int64_t>(n);
      const double depth = stack.depth_mm.front() + g.spacing[2] * static_cast<double>(k);
      // The slices before and after this depth.
      const auto above = std::upper_bound(stack.depth_mm.begin(), stack.depth_mm.end(), depth);
      const std::size_t hi = std::clamp<std::size_t>(static_cast<std::size_t>(above - stack.depth_mm.begin()),
                                                     1, stack.depth_mm.size() - 1);
      const std::size_t lo = hi - 1;
      double w = (depth - stack.depth_mm[lo]) / (stack.depth_mm[hi] - stack.depth_mm[lo]);
      w = std::clamp(std::abs(w - std::round(w)) < 1e-3 ? std::round(w) : w, 0.0, 1.0);

      std::vector<float> a(static_cast<std::size_t>(plane)), b(a.size());
      std::vector<char> has_a(a.size()), has_b(a.size());
      const auto load = [&](std::size_t s, std::vector<float>& values, std::vector<char>& there) {
        const Plane slice{image.voxels.data() + static_cast<std::int64_t>(s) * in.size[0] * in.size[1],
                          in.size[0], in.size[1]};
        const Shift sx(-static_cast<double>(gx.before) - stack.shift_x_mm[s] / in.spacing[0]);
        const Shift sy(-static_cast<double>(gy.before) - stack.shift_y_mm[s] / in.spacing[1]);
        shifted(slice, sx, sy, g.size[0], g.size[1], values, there);
      };
      if (w < 1.0) load(lo, a, has_a);
      if (w > 0.0) load(hi, b, has_b);
      std::int16_t* to = out.voxels.data() + k * plane;
      for (std::size_t i = 0; i < a.size(); ++i) {
        double value = outside;
        if (has_a[i] && has_b[i]) {
          value = (1.0 - w) * a[i] + w * b[i];
        } else if (has_a[i] || has_b[i]) {
          // Where only one of the two reaches, the nearer one decides.
          if (has_a[i] && w < 0.5) value = a[i];
          if (has_b[i] && w >= 0.5) value = b[i];
        }
        to[i] = static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
      }
    });
  }
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::imaging
