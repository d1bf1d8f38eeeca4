#include "ostia/imaging/sampling.h"

#include "affine_resample.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <type_traits>

namespace ostia::imaging {
namespace {

using Size = std::array<std::int64_t, 3>;

/// A coordinate clamped to [0, n - 1] and split: voxel `cell` and the way `f` to the next one.
struct Coordinate {
  std::int64_t cell;
  double f;
  bool clamped;
};

inline Coordinate split(double x, std::int64_t n) {
  const double last = static_cast<double>(n - 1);
  const bool clamped = !(x >= 0.0 && x <= last);  // true for NaN too
  const double at = x > 0.0 ? (x < last ? x : last) : 0.0;
  const std::int64_t cell = std::min(static_cast<std::int64_t>(at), std::max<std::int64_t>(n - 2, 0));
  return {cell, at - static_cast<double>(cell), clamped};
}

struct Nearest {
  template <class T>
  static double value(const T* voxels, const Size& n, const Vec3& at) {
    std::int64_t index[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Coordinate c = split(at[axis], n[axis]);
      index[axis] = c.cell + (c.f >= 0.5 ? 1 : 0);
    }
    return static_cast<double>(voxels[index[0] + n[0] * (index[1] + n[1] * index[2])]);
  }
  template <class T>
  static Vec3 gradient(const T*, const Size&, const Vec3&) {
    return Vec3::Zero();
  }
};

struct Trilinear {
  /// The eight corners of the cell: c[x + 2 y + 4 z].
  template <class T>
  static void corners(const T* voxels, const Size& n, const Coordinate (&c)[3], double (&v)[8]) {
    const std::int64_t dx = n[0] > 1 ? 1 : 0, dy = n[1] > 1 ? n[0] : 0, dz = n[2] > 1 ? n[0] * n[1] : 0;
    const T* p = voxels + c[0].cell + n[0] * (c[1].cell + n[1] * c[2].cell);
    v[0] = static_cast<double>(p[0]);
    v[1] = static_cast<double>(p[dx]);
    v[2] = static_cast<double>(p[dy]);
    v[3] = static_cast<double>(p[dy + dx]);
    p += dz;
    v[4] = static_cast<double>(p[0]);
    v[5] = static_cast<double>(p[dx]);
    v[6] = static_cast<double>(p[dy]);
    v[7] = static_cast<double>(p[dy + dx]);
  }
  template <class T>
  static double value(const T* voxels, const Size& n, const Vec3& at) {
    const Coordinate c[3] = {split(at[0], n[0]), split(at[1], n[1]), split(at[2], n[2])};
    double v[8];
    corners(voxels, n, c, v);
    const double x = c[0].f, y = c[1].f, z = c[2].f;
    const double low = (v[0] + x * (v[1] - v[0])) * (1.0 - y) + (v[2] + x * (v[3] - v[2])) * y;
    const double high = (v[4] + x * (v[5] - v[4])) * (1.0 - y) + (v[6] + x * (v[7] - v[6])) * y;
    return low + z * (high - low);
  }
  template <class T>
  static Vec3 gradient(const T* voxels, const Size& n, const Vec3& at) {
    const Coordinate c[3] = {split(at[0], n[0]), split(at[1], n[1]), split(at[2], n[2])};
    double v[8];
    corners(voxels, n, c, v);
    const double x = c[0].f, y = c[1].f, z = c[2].f;
    const auto mix = [](double a, double b, double f) { return a + f * (b - a); };
    Vec3 g;
    g[0] = mix(mix(v[1] - v[0], v[3] - v[2], y), mix(v[5] - v[4], v[7] - v[6], y), z);
    g[1] = mix(mix(v[2] - v[0], v[3] - v[1], x), mix(v[6] - v[4], v[7] - v[5], x), z);
    g[2] = mix(mix(v[4] - v[0], v[5] - v[1], x), mix(v[6] - v[2], v[7] - v[3], x), y);
    for (int axis = 0; axis < 3; ++axis)
      if (c[axis].clamped) g[axis] = 0.0;
    return g;
  }
};

struct Cubic {
  /// Four neighbours of one axis: offsets in voxels of memory, weights and their derivatives.
  struct Taps {
    std::int64_t step[4];
    double weight[4], slope[4];
    Taps(double x, std::int64_t n, std::int64_t stride) {
      const Coordinate c = split(x, n);
      for (int i = 0; i < 4; ++i) step[i] = std::clamp<std::int64_t>(c.cell - 1 + i, 0, n - 1) * stride;
      const double t = c.f, t2 = t * t, t3 = t2 * t;
      weight[0] = 0.5 * (-t3 + 2.0 * t2 - t);
      weight[1] = 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0);
      weight[2] = 0.5 * (-3.0 * t3 + 4.0 * t2 + t);
      weight[3] = 0.5 * (t3 - t2);
      slope[0] = 0.5 * (-3.0 * t2 + 4.0 * t - 1.0);
      slope[1] = 0.5 * (9.0 * t2 - 10.0 * t);
      slope[2] = 0.5 * (-9.0 * t2 + 8.0 * t + 1.0);
      slope[3] = 0.5 * (3.0 * t2 - 2.0 * t);
      if (c.clamped)
        for (double& s : slope) s = 0.0;
    }
  };
  template <class T>
  static double row(const T* p, const std::int64_t (&step)[4], const double (&w)[4]) {
    return w[0] * static_cast<double>(p[step[0]]) + w[1] * static_cast<double>(p[step[1]]) +
           w[2] * static_cast<double>(p[step[2]]) + w[3] * static_cast<double>(p[step[3]]);
  }
  template <class T>
  static double value(const T* voxels, const Size& n, const Vec3& at) {
    const Taps x(at[0], n[0], 1), y(at[1], n[1], n[0]), z(at[2], n[2], n[0] * n[1]);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
      double plane = 0.0;
      for (int j = 0; j < 4; ++j)
        plane += y.weight[j] * row(voxels + z.step[k] + y.step[j], x.step, x.weight);
      sum += z.weight[k] * plane;
    }
    return sum;
  }
  template <class T>
  static Vec3 gradient(const T* voxels, const Size& n, const Vec3& at) {
    const Taps x(at[0], n[0], 1), y(at[1], n[1], n[0]), z(at[2], n[2], n[0] * n[1]);
    Vec3 g = Vec3::Zero();
    for (int k = 0; k < 4; ++k) {
      Vec3 plane = Vec3::Zero();  // derivative along x, along y, value
      for (int j = 0; j < 4; ++j) {
        const T* p = voxels + z.step[k] + y.step[j];
        const double v = row(p, x.step, x.weight);
        plane += Vec3(y.weight[j] * row(p, x.step, x.slope), y.slope[j] * v, y.weight[j] * v);
      }
      g += Vec3(z.weight[k] * plane[0], z.weight[k] * plane[1], z.slope[k] * plane[2]);
    }
    return g;
  }
};

template <class T>
T stored(double value) {
  if constexpr (std::is_integral_v<T>) {
    const double low = std::numeric_limits<T>::lowest(), high = std::numeric_limits<T>::max();
    return static_cast<T>(std::lround(value > low ? (value < high ? value : high) : low));
  } else {
    return static_cast<T>(value);
  }
}

template <class Interpolant, class T>
void fill_row(const T* voxels, const Size& n, const Vec3& start, const Vec3& step, Beyond beyond, T outside,
              T* out, std::int64_t count) {
  const Vec3 upper(static_cast<double>(n[0]) - 0.5, static_cast<double>(n[1]) - 0.5,
                   static_cast<double>(n[2]) - 0.5);
  constexpr double slack = 1e-9;  // a grid that ends on the border is not to lose it to rounding
  for (std::int64_t i = 0; i < count; ++i) {
    const Vec3 at = start + static_cast<double>(i) * step;
    const bool inside = at[0] >= -0.5 - slack && at[1] >= -0.5 - slack && at[2] >= -0.5 - slack &&
                        at[0] <= upper[0] + slack && at[1] <= upper[1] + slack && at[2] <= upper[2] + slack;
    out[i] =
        inside || beyond == Beyond::border_value ? stored<T>(Interpolant::value(voxels, n, at)) : outside;
  }
}

template <class T>
void require_voxels(const Volume<T>& image) {
  if (image.voxels.empty() || image.voxels.size() != static_cast<std::size_t>(image.geometry.voxels()))
    throw InvalidInput("resample: the image is empty or its voxels do not fit its size");
}

}  // namespace

template <class T>
void affine_resample(const T* voxels, const Size& size, const Mat3& linear, const Vec3& offset,
                     Interpolation how, Beyond beyond, T outside, Volume<T>& out,
                     const core::TaskContext& task) {
  const Size& to = out.geometry.size;
  out.voxels.resize(static_cast<std::size_t>(out.geometry.voxels()));
  const std::size_t rows = static_cast<std::size_t>(to[1] * to[2]);
  const std::size_t grain =
      std::max<std::size_t>(1, 65536 / static_cast<std::size_t>(std::max<std::int64_t>(1, to[0])));
  const auto fill = how == Interpolation::nearest     ? fill_row<Nearest, T>
                    : how == Interpolation::trilinear ? fill_row<Trilinear, T>
                                                      : fill_row<Cubic, T>;
  std::atomic<std::size_t> done{0};
  core::parallel_chunks(rows, grain, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t row = first; row < last; ++row) {
      const std::int64_t j = static_cast<std::int64_t>(row) % to[1],
                         k = static_cast<std::int64_t>(row) / to[1];
      const Vec3 start =
          linear.col(1) * static_cast<double>(j) + linear.col(2) * static_cast<double>(k) + offset;
      fill(voxels, size, start, linear.col(0), beyond, outside,
           out.voxels.data() + row * static_cast<std::size_t>(to[0]), to[0]);
    }
    task.set_progress(static_cast<double>(done += last - first) / static_cast<double>(rows));
  });
}

template <class T>
double sample(const Volume<T>& image, const Vec3& world_mm, Interpolation how) {
  const Vec3 at = image.geometry.index(world_mm);
  const Size& n = image.geometry.size;
  if (how == Interpolation::trilinear) return Trilinear::value(image.voxels.data(), n, at);
  if (how == Interpolation::cubic) return Cubic::value(image.voxels.data(), n, at);
  return Nearest::value(image.voxels.data(), n, at);
}

template <class T>
Vec3 sample_gradient(const Volume<T>& image, const Vec3& world_mm, Interpolation how) {
  const Geometry& grid = image.geometry;
  const Vec3 at = grid.index(world_mm);
  Vec3 g = Vec3::Zero();
  if (how == Interpolation::trilinear) g = Trilinear::gradient(image.voxels.data(), grid.size, at);
  if (how == Interpolation::cubic) g = Cubic::gradient(image.voxels.data(), grid.size, at);
  return grid.direction * g.cwiseQuotient(grid.spacing);
}

template <class T>
Volume<T> resampled(const Volume<T>& image, const Geometry& grid, Interpolation how, T outside,
                    const core::TaskContext& task) {
  require_voxels(image);
  const Geometry& from = image.geometry;
  const Mat3 to_index = from.spacing.cwiseInverse().asDiagonal() * from.direction.transpose();
  const Mat3 linear = to_index * grid.direction * grid.spacing.asDiagonal();
  Volume<T> out;
  out.geometry = grid;
  affine_resample(image.voxels.data(), from.size, linear, to_index * (grid.origin - from.origin), how,
                  Beyond::outside_value, outside, out, task);
  return out;
}

#define OSTIA_SAMPLING(T)                                                                                  \
  template double sample(const Volume<T>&, const Vec3&, Interpolation);                                    \
  template Vec3 sample_gradient(const Volume<T>&, const Vec3&, Interpolation);                             \
  template Volume<T> resampled(const Volume<T>&, const Geometry&, Interpolation, T,                        \
                               const core::TaskContext&);                                                  \
  template void affine_resample(const T*, const Size&, const Mat3&, const Vec3&, Interpolation, Beyond, T, \
                                Volume<T>&, const core::TaskContext&);
OSTIA_SAMPLING(std::int16_t)
OSTIA_SAMPLING(std::uint8_t)
OSTIA_SAMPLING(float)
#undef OSTIA_SAMPLING

}  // namespace ostia::imaging
