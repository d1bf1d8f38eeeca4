// Compiled with -mavx2 on x86-64 (ostia_avx2_sources).
#include "row_loops.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace ostia::reformat {

#if defined(__AVX2__)
namespace {

struct Along {
  __m256i cell;   // of eight places, voxels
  __m256 beyond;  // its beginning, [0, 1)
};

/// Four places at a time in double precision, as one by one.
inline void four_along(__m256d at, __m128i& cell, __m128& beyond) {
  cell = _mm256_cvttpd_epi32(at);
  beyond = _mm256_cvtpd_ps(_mm256_sub_pd(at, _mm256_cvtepi32_pd(cell)));
}

inline Along along(double start, double step, __m256d first_four, __m256d last_four) {
  const __m256d s = _mm256_set1_pd(start), d = _mm256_set1_pd(step);
  __m128i cell[2];
  __m128 beyond[2];
  four_along(_mm256_add_pd(s, _mm256_mul_pd(first_four, d)), cell[0], beyond[0]);
  four_along(_mm256_add_pd(s, _mm256_mul_pd(last_four, d)), cell[1], beyond[1]);
  return {_mm256_set_m128i(cell[1], cell[0]), _mm256_set_m128(beyond[1], beyond[0])};
}

inline __m256 mixed(__m256 a, __m256 b, __m256 f) {
  return _mm256_add_ps(a, _mm256_mul_ps(f, _mm256_sub_ps(b, a)));
}

/// Between a voxel and the next of its row, which are read as one number.
inline __m256 of_row(const std::int16_t* voxels, __m256i at, __m256 f) {
  const __m256i both = _mm256_i32gather_epi32(reinterpret_cast<const int*>(voxels), at, 2);
  const __m256 first = _mm256_cvtepi32_ps(_mm256_srai_epi32(_mm256_slli_epi32(both, 16), 16));
  return mixed(first, _mm256_cvtepi32_ps(_mm256_srai_epi32(both, 16)), f);
}

std::int64_t trilinear_avx2(const std::int16_t* voxels, std::int64_t dy, std::int64_t dz, const VoxelRow& row,
                            std::int64_t first, std::int64_t last, float* out) {
  const __m256i by_y = _mm256_set1_epi32(static_cast<int>(dy)),
                by_z = _mm256_set1_epi32(static_cast<int>(dz));
  std::int64_t i = first;
  for (; i + 8 <= last; i += 8) {
    const double n = static_cast<double>(i);
    const __m256d low = _mm256_set_pd(n + 3.0, n + 2.0, n + 1.0, n);
    const __m256d high = _mm256_set_pd(n + 7.0, n + 6.0, n + 5.0, n + 4.0);
    const Along x = along(row.start[0], row.step[0], low, high);
    const Along y = along(row.start[1], row.step[1], low, high);
    const Along z = along(row.start[2], row.step[2], low, high);
    const __m256i at = _mm256_add_epi32(
        x.cell, _mm256_add_epi32(_mm256_mullo_epi32(y.cell, by_y), _mm256_mullo_epi32(z.cell, by_z)));
    const __m256i next = _mm256_add_epi32(at, by_z);
    const __m256 here =
        mixed(of_row(voxels, at, x.beyond), of_row(voxels, _mm256_add_epi32(at, by_y), x.beyond), y.beyond);
    const __m256 there = mixed(of_row(voxels, next, x.beyond),
                               of_row(voxels, _mm256_add_epi32(next, by_y), x.beyond), y.beyond);
    _mm256_storeu_ps(out + i, mixed(here, there, z.beyond));
  }
  return i;
}

template <bool larger>
void fold_avx2(const float* layer, std::int64_t count, float* out) {
  std::int64_t i = 0;
  for (; i + 8 <= count; i += 8) {
    const __m256 l = _mm256_loadu_ps(layer + i), o = _mm256_loadu_ps(out + i);
    const __m256 better = larger ? _mm256_cmp_ps(l, o, _CMP_GT_OQ) : _mm256_cmp_ps(l, o, _CMP_LT_OQ);
    const __m256 take = _mm256_or_ps(better, _mm256_cmp_ps(o, o, _CMP_UNORD_Q));
    _mm256_storeu_ps(out + i, _mm256_blendv_ps(o, l, take));
  }
  for (; i < count; ++i)
    if ((larger ? layer[i] > out[i] : layer[i] < out[i]) || out[i] != out[i]) out[i] = layer[i];
}

}  // namespace

RowLoops row_loops_avx2() {
  return {trilinear_avx2, fold_avx2<true>, fold_avx2<false>};
}
#else
RowLoops row_loops_avx2() {
  return row_loops_plain();
}
#endif

}  // namespace ostia::reformat
