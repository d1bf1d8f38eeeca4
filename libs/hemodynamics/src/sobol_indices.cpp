#include "ostia/hemodynamics/sobol_indices.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::hemodynamics {

SobolIndex sobol_index(std::span<const double> a, std::span<const double> b, std::span<const double> mixed) {
  if (a.size() != b.size() || a.size() != mixed.size())
    throw InvalidInput("Sobol indices are of as many rows of A as of B and of both mixed");
  const auto counts = [&](std::size_t i) {
    return std::isfinite(a[i]) && std::isfinite(b[i]) && std::isfinite(mixed[i]);
  };
  double rows = 0.0, mean = 0.0,
         mean_pair = 0.0;  // of A and B; of B and mixed, which have the input in common
  for (std::size_t i = 0; i < a.size(); ++i)
    if (counts(i)) rows += 1.0, mean += 0.5 * (a[i] + b[i]), mean_pair += 0.5 * (b[i] + mixed[i]);
  if (!(rows > 1.0)) return {};
  mean /= rows, mean_pair /= rows;
  double variance = 0.0, apart = 0.0, saltelli = 0.0, together = 0.0, pair_variance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!counts(i)) continue;
    variance += 0.5 * ((a[i] - mean) * (a[i] - mean) + (b[i] - mean) * (b[i] - mean)) / rows;
    apart += 0.5 * (a[i] - mixed[i]) * (a[i] - mixed[i]) / rows;
    saltelli += (b[i] - mean) * (mixed[i] - a[i]) / rows;
    const double x = b[i] - mean_pair, y = mixed[i] - mean_pair;
    together += x * y / rows;
    pair_variance += 0.5 * (x * x + y * y) / rows;
  }
  // Rounding of a result that does not vary is no variance.
  if (!(variance > 1e-24 * std::max(1e-300, mean * mean)) || !(pair_variance > 0.0)) return {};
  SobolIndex index;
  index.total = apart / variance;
  const double t = std::clamp(index.total, 0.0, 1.0);
  const double small = (1.0 - t) * (1.0 - t), large = t * t;
  index.first = (small * saltelli / variance + large * together / pair_variance) / (small + large);
  return index;
}

}  // namespace ostia::hemodynamics
