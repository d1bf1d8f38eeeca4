#pragma once
/// \file The inner loops of evaluation: weighted kernels summed over centres.

#include "ostia/lumen/kernel.h"

#include <cstddef>

namespace ostia::lumen {

/// Centres as arrays. Sums run in their order; a centre out of reach adds exactly 0, so that any list with
/// the same centres within reach, in the same order, gives the same bits. Behind its end each array has room
/// for `list_padding` more numbers, finite ones, which are read and not used.
struct CentreList {
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;
  const double* weight = nullptr;
  std::size_t size = 0;
};
inline constexpr std::size_t list_padding = 8;

/// Places that are summed side by side.
inline constexpr std::size_t sum_lanes = 8;
struct PlaceLanes {
  double x[sum_lanes], y[sum_lanes], z[sum_lanes];
};

/// Where a list is gathered, with room for the padding.
struct CentreArrays {
  double* x = nullptr;
  double* y = nullptr;
  double* z = nullptr;
  double* weight = nullptr;
};
/// All within reach of a box.
struct Region {
  double least[3], most[3];
  double reach2 = 0.0;  ///< mm^2
};

/// The loops for one kernel and one processor; `per_radius` is 1 / alpha.
struct KernelLoops {
  /// sum_j w_j phi(|p - p_j| / alpha) for each of the places.
  void (*sums)(double per_radius, const CentreList& centres, const PlaceLanes& places, double* out);
  /// For the first half of the places alone.
  void (*half_sums)(double per_radius, const CentreList& centres, const PlaceLanes& places, double* out);
  /// w_j phi(x_j) for one place: added in order they are the same sum to the last bit. Into size + padding.
  void (*terms)(double per_radius, const CentreList& centres, const double* place, double* out);
  /// w_j phi'(x_j) / x_j: the gradient is their sum times (p - p_j) / alpha^2. Into size + padding.
  void (*slopes)(double per_radius, const CentreList& centres, const double* place, double* out);
  /// Appends those centres of a list that lie in a region behind the first `size`; tells how many there are.
  std::size_t (*append_near)(const Region& region, const CentreList& from, const CentreArrays& to,
                             std::size_t size);
};

/// The fastest ones for this processor; all give the same bits.
KernelLoops kernel_loops(Kernel kernel);
KernelLoops kernel_loops_baseline(Kernel kernel);
KernelLoops kernel_loops_avx2(Kernel kernel);  ///< the baseline's where the compiler does not know AVX2

}  // namespace ostia::lumen
