// The loops of tube_loops.h for the instruction set that the including file is compiled for. No
// multiplication is fused with an addition, so that all of them give the same bits. Everything here is local
// to its file: no code for a newer processor may reach the others.

#include "vesselness/tube_loops.h"

#include "ostia/core/simd.h"

#include <cstddef>

namespace ostia::segmentation::detail {
namespace {

using core::simd::above;
using core::simd::all;
using core::simd::choose;
using core::simd::larger;
using core::simd::load;
using core::simd::root;
using core::simd::smaller;
using core::simd::store;
using Pack = core::simd::FloatPack;
constexpr std::size_t width = core::simd::float_pack_size;

template <std::size_t packs>
inline void blur_packs(const float* in, std::ptrdiff_t stride, const float* weights, int radius, float* out) {
  Pack sum[packs];
  for (std::size_t k = 0; k < packs; ++k) sum[k] = all(weights[0]) * load(in + k * width);
  for (int r = 1; r <= radius; ++r) {
    const Pack weight = all(weights[r]);
    const float* before = in - r * stride;
    const float* after = in + r * stride;
    for (std::size_t k = 0; k < packs; ++k)
      sum[k] = sum[k] + weight * (load(before + k * width) + load(after + k * width));
  }
  for (std::size_t k = 0; k < packs; ++k) store(out + k * width, sum[k]);
}

void blur(const float* in, std::ptrdiff_t stride, const float* weights, int radius, float* out,
          std::size_t count) {
  std::size_t x = 0;
  for (; x + 4 * width <= count; x += 4 * width) blur_packs<4>(in + x, stride, weights, radius, out + x);
  for (; x < count; x += width) blur_packs<1>(in + x, stride, weights, radius, out + x);
}

void add(const float* a, const float* b, float* out, std::size_t count) {
  for (std::size_t x = 0; x < count; x += width) store(out + x, load(a + x) + load(b + x));
}

template <std::size_t packs>
inline void run_packs(const float* sums, const RunTap* taps, std::size_t tap_count, float* out) {
  Pack sum[packs];
  for (std::size_t k = 0; k < packs; ++k) sum[k] = load(out + k * width);
  for (std::size_t n = 0; n < tap_count; ++n) {
    const Pack weight = all(taps[n].weight);
    const float* plus = sums + taps[n].plus;
    const float* minus = sums + taps[n].minus;
    for (std::size_t k = 0; k < packs; ++k)
      sum[k] = sum[k] + weight * (load(plus + k * width) - load(minus + k * width));
  }
  for (std::size_t k = 0; k < packs; ++k) store(out + k * width, sum[k]);
}

void runs(const float* sums, const RunTap* taps, std::size_t tap_count, float* out, std::size_t count) {
  std::size_t x = 0;
  for (; x + 4 * width <= count; x += 4 * width) run_packs<4>(sums + x, taps, tap_count, out + x);
  for (; x < count; x += width) run_packs<1>(sums + x, taps, tap_count, out + x);
}

/// 12 h^2 times the second derivative, fourth order.
inline Pack second(const float* v, std::ptrdiff_t d) {
  return all(16.0F) * (load(v - d) + load(v + d)) - (load(v - 2 * d) + load(v + 2 * d)) -
         all(30.0F) * load(v);
}
/// 12 h times the first derivative, fourth order.
inline Pack first(const float* v, std::ptrdiff_t d) {
  return all(8.0F) * (load(v + d) - load(v - d)) - (load(v + 2 * d) - load(v - 2 * d));
}
/// 144 h h' times the mixed derivative.
inline Pack mixed(const float* v, std::ptrdiff_t a, std::ptrdiff_t b) {
  return all(8.0F) * (first(v + b, a) - first(v - b, a)) - (first(v + 2 * b, a) - first(v - 2 * b, a));
}

struct Symmetric {
  Pack xx, yy, zz, xy, xz, yz;
};

/// The middle and the largest eigenvalue in closed form (O. K. Smith, Commun. ACM 4:168, 1961). The cosine of
/// a third of the angle whose cosine is r is a smooth function of u = sqrt((1 + r) / 2) on [0, 1].
inline void eigenvalues(const Symmetric& m, Pack& middle, Pack& largest) {
  const Pack mean = (m.xx + m.yy + m.zz) * all(1.0F / 3.0F);
  const Pack x = m.xx - mean, y = m.yy - mean, z = m.zz - mean;
  const Pack off = m.xy * m.xy + m.xz * m.xz + m.yz * m.yz;
  const Pack p2 = (x * x + y * y + z * z + all(2.0F) * off) * all(1.0F / 6.0F);
  const Pack p = root(larger(p2, all(1e-12F)));
  const Pack determinant =
      x * (y * z - m.yz * m.yz) - m.xy * (m.xy * z - m.yz * m.xz) + m.xz * (m.xy * m.yz - y * m.xz);
  const Pack r = all(0.5F) * determinant / (p * p * p);
  const Pack u2 = smaller(larger(all(0.5F) + all(0.5F) * r, all(0.0F)), all(1.0F));
  const Pack u = root(u2);
  Pack c = all(-0.00210349101F);
  constexpr float kNext[] = {0.0105017536F, -0.0263997493F, 0.0514747633F,
                             -0.110805471F, 0.577331902F,   0.500000186F};  // within 2e-7
  for (const float next : kNext) c = c * u + all(next);
  const Pack s = root(larger(all(1.0F) - c * c, all(0.0F)));
  largest = mean + all(2.0F) * p * c;
  middle = mean + p * (all(1.7320508F) * s - c);
}

/// The unit eigenvector of `value`: of the three cross products of rows of m - value, the longest.
inline void eigenvector(const Symmetric& m, Pack value, Pack* out) {
  const Pack x = m.xx - value, y = m.yy - value, z = m.zz - value;
  const Pack yz_zz = y * z - m.yz * m.yz, xx_zz = x * z - m.xz * m.xz, xx_yy = x * y - m.xy * m.xy;
  const Pack xy = m.xz * m.yz - m.xy * z, xz = m.xy * m.yz - m.xz * y, yz = m.xy * m.xz - m.yz * x;
  // The adjugate's columns: (yz_zz, xy, xz), (xy, xx_zz, yz), (xz, yz, xx_yy); the diagonals have one sign.
  const Pack a = yz_zz * yz_zz + xy * xy + xz * xz, b = xy * xy + xx_zz * xx_zz + yz * yz,
             c = xz * xz + yz * yz + xx_yy * xx_yy;
  const Pack second_is = above(b, a);
  Pack vx = choose(second_is, xy, yz_zz), vy = choose(second_is, xx_zz, xy), vz = choose(second_is, yz, xz);
  const Pack so_far = larger(a, b);
  const Pack third_is = above(c, so_far);
  vx = choose(third_is, xz, vx);
  vy = choose(third_is, yz, vy);
  vz = choose(third_is, xx_yy, vz);
  const Pack scale = all(1.0F) / root(larger(larger(so_far, c), all(1e-30F)));
  out[0] = vx * scale;
  out[1] = vy * scale;
  out[2] = vz * scale;
}

inline void tube_pack(const TubeRow& row, std::size_t at) {
  const float* v = row.values + at;
  const Symmetric m{all(row.pure[0]) * second(v, 1),        all(row.pure[1]) * second(v, row.y),
                    all(row.pure[2]) * second(v, row.z),    all(row.mixed[0]) * mixed(v, 1, row.y),
                    all(row.mixed[1]) * mixed(v, 1, row.z), all(row.mixed[2]) * mixed(v, row.y, row.z)};
  Pack middle, largest;
  eigenvalues(m, middle, largest);
  const Pack gap = smaller(largest, all(-row.gap_weight) * largest);
  const Pack answer = larger(gap - middle, all(0.0F));
  store(row.answer + at, answer);
  if (row.axis[0] == nullptr) return;
  const Pack before = load(row.best + at);
  const Pack better = above(answer, before);
  store(row.best + at, larger(answer, before));
  Pack axis[3];
  eigenvector(m, largest, axis);
  for (int d = 0; d < 3; ++d) store(row.axis[d] + at, choose(better, axis[d], load(row.axis[d] + at)));
}

void tube(const TubeRow& row, std::size_t count) {
  for (std::size_t x = 0; x < count; x += width) tube_pack(row, x);
}

inline TubeLoops loops_here() {
  return {&blur, &add, &runs, &tube};
}

}  // namespace
}  // namespace ostia::segmentation::detail
