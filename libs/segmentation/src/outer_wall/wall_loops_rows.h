// The loop of wall_loops.h for the instruction set that the including file is compiled for. No
// multiplication is fused with an addition, so that all of them give the same bits. Everything here is local
// to its file: no code for a newer processor may reach the others.

#include "outer_wall/wall_loops.h"

#include "ostia/core/simd.h"

namespace ostia::segmentation::detail::wall_rows {
namespace {

using core::simd::all;
using core::simd::load;
using core::simd::store;
using Pack = core::simd::DoublePack;
constexpr int lanes = static_cast<int>(sizeof(Pack) / sizeof(double));
static_assert(wall_candidates % lanes == 0);

/// Products of each two parts, summed over the samples.
struct Products {
  Pack of[wall_parts][wall_parts];
};

inline void multiply(const WallSamples& samples, int candidate, Products& products) {
  for (int a = 0; a < wall_parts; ++a)
    for (int b = 0; b <= a; ++b) {
      Pack sum = all(0.0);
      for (int i = 0; i < wall_samples; ++i)
        sum = sum + load(samples.value[a][i] + candidate) * load(samples.value[b][i] + candidate);
      products.of[a][b] = products.of[b][a] = sum;
    }
}

inline Pack along(const Products& products, const WallDirection& direction, int part) {
  const Pack outer = products.of[direction.outer][part];
  return direction.inner < 0 ? outer : outer - products.of[direction.inner][part];
}

/// With D the directions and r the samples without the mean: the determinant of 1 + D'D and r'(1 + DD')^-1 r,
/// by eliminating D from the matrix of all products.
inline void explain(const Products& products, const WallMixture& mixture, int ray_part, Pack& square,
                    Pack& determinant) {
  Pack matrix[most_wall_directions][most_wall_directions], right[most_wall_directions];
  const int count = mixture.count;
  square = products.of[ray_part][ray_part];
  for (int n = 0; n < count; ++n) {
    const WallDirection& one = mixture.direction[n];
    for (int m = 0; m <= n; ++m) {
      const WallDirection& other = mixture.direction[m];
      Pack product = along(products, one, other.outer);
      if (other.inner >= 0) product = product - along(products, one, other.inner);
      matrix[n][m] = product;
    }
    right[n] = along(products, one, ray_part);
  }
  for (int n = 0; n < count; ++n) {
    const Pack hu = all(mixture.direction[n].hu), before = right[n];
    Pack rest = before;
    for (int m = 0; m < count; ++m)
      rest = rest - all(mixture.direction[m].hu) * (m <= n ? matrix[n][m] : matrix[m][n]);
    right[n] = rest;
    square = square - hu * (before + rest);
  }
  for (int n = 0; n < count; ++n) {
    const double spread = mixture.direction[n].spread;
    for (int m = 0; m <= n; ++m) matrix[n][m] = all(spread * mixture.direction[m].spread) * matrix[n][m];
    matrix[n][n] = matrix[n][n] + all(1.0);
    right[n] = all(spread) * right[n];
  }
  determinant = all(1.0);
  for (int n = 0; n < count; ++n) {
    determinant = determinant * matrix[n][n];
    const Pack inverse = all(1.0) / matrix[n][n];
    square = square - right[n] * right[n] * inverse;
    for (int k = n + 1; k < count; ++k) {
      const Pack factor = matrix[k][n] * inverse;
      for (int m = n + 1; m <= k; ++m) matrix[k][m] = matrix[k][m] - factor * matrix[m][n];
      right[k] = right[k] - factor * right[n];
    }
  }
}

void loop_here(const WallSamples& samples, int ray_part, int count, const WallMixture* mixtures,
               int mixture_count, double (*square)[wall_candidates], double (*determinant)[wall_candidates]) {
  Products products;
  for (int candidate = 0; candidate < count; candidate += lanes) {
    multiply(samples, candidate, products);
    for (int h = 0; h < mixture_count; ++h) {
      Pack left, spread;
      explain(products, mixtures[h], ray_part, left, spread);
      store(square[h] + candidate, left);
      store(determinant[h] + candidate, spread);
    }
  }
}

}  // namespace
}  // namespace ostia::segmentation::detail::wall_rows
