// The loops of kernel_sums.h for the instruction set that the including file is compiled for. No
// multiplication is fused with an addition, so that all of them give the same bits. Everything here is local
// to its file: no code for a newer processor may reach the others.

#include "interpolation/kernel_sums.h"

#include "ostia/core/simd.h"

#include <cstddef>

namespace ostia::lumen {
namespace {

using core::simd::all;
using core::simd::larger;
using core::simd::load;
using core::simd::not_above;
using core::simd::root;
using core::simd::store;
using Pack = core::simd::DoublePack;
constexpr std::size_t width = core::simd::double_pack_size;

// phi(x), with u = max(0, 1 - x) in place of a branch.
template <Kernel kernel>
inline Pack phi_of(Pack x) {
  const Pack u = larger(all(1.0) - x, all(0.0)), u2 = u * u;
  if constexpr (kernel == Kernel::morse_c0) return u2;
  if constexpr (kernel == Kernel::wendland_c2) return u2 * u2 * (all(4.0) * x + all(1.0));
  return u2 * u2 * u2 * ((all(35.0) * x + all(18.0)) * x + all(3.0)) * all(1.0 / 3.0);
}

template <Kernel kernel>
inline Pack slope_over_x(Pack x) {
  const Pack u = larger(all(1.0) - x, all(0.0)), u2 = u * u;
  // At the centre itself, where the C0 kernel has no gradient, the offset is 0 and so is the product.
  if constexpr (kernel == Kernel::morse_c0) return all(-2.0) * u / larger(x, all(1e-300));
  if constexpr (kernel == Kernel::wendland_c2) return all(-20.0) * (u2 * u);
  return all(-56.0 / 3.0) * (u2 * u2 * u) * (all(5.0) * x + all(1.0));
}

inline Pack relative_distance(Pack dx, Pack dy, Pack dz, Pack per_radius) {
  return root(dx * dx + dy * dy + dz * dz) * per_radius;
}

template <Kernel kernel, std::size_t lanes>
void sums(double per_radius, const CentreList& c, const PlaceLanes& places, double* out) {
  constexpr std::size_t packs = lanes / width;
  Pack x[packs], y[packs], z[packs], sum[packs];
  for (std::size_t k = 0; k < packs; ++k) {
    x[k] = load(places.x + k * width);
    y[k] = load(places.y + k * width);
    z[k] = load(places.z + k * width);
    sum[k] = all(0.0);
  }
  const Pack scale = all(per_radius);
  for (std::size_t i = 0; i < c.size; ++i) {
    const Pack cx = all(c.x[i]), cy = all(c.y[i]), cz = all(c.z[i]), weight = all(c.weight[i]);
    for (std::size_t k = 0; k < packs; ++k)
      sum[k] = sum[k] + weight * phi_of<kernel>(relative_distance(x[k] - cx, y[k] - cy, z[k] - cz, scale));
  }
  for (std::size_t k = 0; k < packs; ++k) store(out + k * width, sum[k]);
}

template <Kernel kernel, bool slope>
void terms(double per_radius, const CentreList& c, const double* place, double* out) {
  const Pack px = all(place[0]), py = all(place[1]), pz = all(place[2]), scale = all(per_radius);
  for (std::size_t i = 0; i < c.size; i += width) {
    const Pack x = relative_distance(px - load(c.x + i), py - load(c.y + i), pz - load(c.z + i), scale);
    store(out + i, load(c.weight + i) * (slope ? slope_over_x<kernel>(x) : phi_of<kernel>(x)));
  }
}

inline Pack outside(Pack v, double least, double most) {
  return larger(larger(all(least) - v, v - all(most)), all(0.0));
}

inline std::size_t append_near(const Region& region, const CentreList& from, const CentreArrays& to,
                               std::size_t size) {
  constexpr int full = (1 << width) - 1;
  const Pack reach2 = all(region.reach2);
  for (std::size_t i = 0; i < from.size; i += width) {
    const Pack x = load(from.x + i), y = load(from.y + i), z = load(from.z + i);
    const Pack dx = outside(x, region.least[0], region.most[0]),
               dy = outside(y, region.least[1], region.most[1]),
               dz = outside(z, region.least[2], region.most[2]);
    int mask = not_above(dx * dx + dy * dy + dz * dz, reach2);
    if (from.size - i < width) mask &= (1 << (from.size - i)) - 1;
    if (mask == full) {
      store(to.x + size, x);
      store(to.y + size, y);
      store(to.z + size, z);
      store(to.weight + size, load(from.weight + i));
      size += width;
      continue;
    }
    for (std::size_t k = i; mask != 0; ++k, mask >>= 1) {
      to.x[size] = from.x[k];
      to.y[size] = from.y[k];
      to.z[size] = from.z[k];
      to.weight[size] = from.weight[k];
      size += static_cast<std::size_t>(mask & 1);
    }
  }
  return size;
}

template <Kernel kernel>
constexpr KernelLoops loops_of() {
  return {sums<kernel, sum_lanes>, sums<kernel, sum_lanes / 2>, terms<kernel, false>, terms<kernel, true>,
          append_near};
}

inline KernelLoops loops_for(Kernel kernel) {
  switch (kernel) {
    case Kernel::morse_c0:
      return loops_of<Kernel::morse_c0>();
    case Kernel::wendland_c2:
      return loops_of<Kernel::wendland_c2>();
    case Kernel::wendland_c4:
      break;
  }
  return loops_of<Kernel::wendland_c4>();
}

}  // namespace
}  // namespace ostia::lumen
