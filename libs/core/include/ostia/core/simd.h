#pragma once
/// \file Packs of numbers that the processor works on at once, as wide as the instruction set that the
/// including source is compiled for: AVX, SSE2, or a single number. `+ - * /` are the compiler's own on them.
/// A result's bits do not depend on the width, as long as no multiplication is fused with an addition.

#if defined(__SSE2__)
#include <immintrin.h>
#else
#include <cmath>
#endif

#include <cstddef>

namespace ostia::core::simd {
// One program holds sources that are compiled for different instruction sets. Inline functions of one name
// are the same function to the linker: it keeps one of them, maybe the one for a newer processor, and the
// program dies on an older one. In an unnamed namespace each source has its own.
namespace {

#if defined(__AVX2__)
using DoublePack = __m256d;
using FloatPack = __m256;
inline DoublePack load(const double* p) {
  return _mm256_loadu_pd(p);
}
inline FloatPack load(const float* p) {
  return _mm256_loadu_ps(p);
}
inline void store(double* p, DoublePack v) {
  _mm256_storeu_pd(p, v);
}
inline void store(float* p, FloatPack v) {
  _mm256_storeu_ps(p, v);
}
inline DoublePack all(double v) {
  return _mm256_set1_pd(v);
}
inline FloatPack all(float v) {
  return _mm256_set1_ps(v);
}
inline DoublePack root(DoublePack v) {
  return _mm256_sqrt_pd(v);
}
inline FloatPack root(FloatPack v) {
  return _mm256_sqrt_ps(v);
}
inline DoublePack larger(DoublePack a, DoublePack b) {
  return _mm256_max_pd(a, b);
}
inline FloatPack larger(FloatPack a, FloatPack b) {
  return _mm256_max_ps(a, b);
}
inline FloatPack smaller(FloatPack a, FloatPack b) {
  return _mm256_min_ps(a, b);
}
/// One bit a lane, the first lane's the lowest.
inline int not_above(DoublePack a, DoublePack b) {
  return _mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LE_OQ));
}
/// For choose.
inline FloatPack above(FloatPack a, FloatPack b) {
  return _mm256_cmp_ps(a, b, _CMP_GT_OQ);
}
inline FloatPack choose(FloatPack where, FloatPack yes, FloatPack no) {
  return _mm256_blendv_ps(no, yes, where);
}
#elif defined(__SSE2__)
using DoublePack = __m128d;
using FloatPack = __m128;
inline DoublePack load(const double* p) {
  return _mm_loadu_pd(p);
}
inline FloatPack load(const float* p) {
  return _mm_loadu_ps(p);
}
inline void store(double* p, DoublePack v) {
  _mm_storeu_pd(p, v);
}
inline void store(float* p, FloatPack v) {
  _mm_storeu_ps(p, v);
}
inline DoublePack all(double v) {
  return _mm_set1_pd(v);
}
inline FloatPack all(float v) {
  return _mm_set1_ps(v);
}
inline DoublePack root(DoublePack v) {
  return _mm_sqrt_pd(v);
}
inline FloatPack root(FloatPack v) {
  return _mm_sqrt_ps(v);
}
inline DoublePack larger(DoublePack a, DoublePack b) {
  return _mm_max_pd(a, b);
}
inline FloatPack larger(FloatPack a, FloatPack b) {
  return _mm_max_ps(a, b);
}
inline FloatPack smaller(FloatPack a, FloatPack b) {
  return _mm_min_ps(a, b);
}
inline int not_above(DoublePack a, DoublePack b) {
  return _mm_movemask_pd(_mm_cmple_pd(a, b));
}
inline FloatPack above(FloatPack a, FloatPack b) {
  return _mm_cmpgt_ps(a, b);
}
inline FloatPack choose(FloatPack where, FloatPack yes, FloatPack no) {
  return _mm_or_ps(_mm_and_ps(where, yes), _mm_andnot_ps(where, no));
}
#else
using DoublePack = double;
using FloatPack = float;
inline DoublePack load(const double* p) {
  return *p;
}
inline FloatPack load(const float* p) {
  return *p;
}
inline void store(double* p, DoublePack v) {
  *p = v;
}
inline void store(float* p, FloatPack v) {
  *p = v;
}
inline DoublePack all(double v) {
  return v;
}
inline FloatPack all(float v) {
  return v;
}
inline DoublePack root(DoublePack v) {
  return std::sqrt(v);
}
inline FloatPack root(FloatPack v) {
  return std::sqrt(v);
}
inline DoublePack larger(DoublePack a, DoublePack b) {
  return a > b ? a : b;
}
inline FloatPack larger(FloatPack a, FloatPack b) {
  return a > b ? a : b;
}
inline FloatPack smaller(FloatPack a, FloatPack b) {
  return a < b ? a : b;
}
inline int not_above(DoublePack a, DoublePack b) {
  return a <= b ? 1 : 0;
}
inline FloatPack above(FloatPack a, FloatPack b) {
  return a > b ? 1.0F : 0.0F;
}
inline FloatPack choose(FloatPack where, FloatPack yes, FloatPack no) {
  return where != 0.0F ? yes : no;
}
#endif

constexpr std::size_t double_pack_size = sizeof(DoublePack) / sizeof(double);
constexpr std::size_t float_pack_size = sizeof(FloatPack) / sizeof(float);

}  // namespace
}  // namespace ostia::core::simd
