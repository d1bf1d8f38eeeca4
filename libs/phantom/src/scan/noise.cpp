#include "ostia/phantom/noise.h"

#include <array>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

/// SplitMix64 (Steele, Lea and Flood 2014) of a counter.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// x with P(|normal| < x) = 1 - tail, by Newton's method on the complementary error function.
double half_normal_quantile(double tail) {
  if (tail >= 1.0) return 0.0;
  double x = std::sqrt(-2.0 * std::log(0.5 * tail)) * (1.0 - tail);
  for (int step = 0; step < 60; ++step) {
    const double density = std::sqrt(2.0 / std::numbers::pi) * std::exp(-0.5 * x * x);
    const double error = std::erfc(x / std::numbers::sqrt2) - tail;
    // Newton on log(erfc) converges from everywhere.
    const double change = std::log1p(error / tail) * (error + tail) / density;
    x += change;
    if (std::abs(change) < 1e-12 * (1.0 + x)) break;
  }
  return x;
}

/// Quantiles of |normal| at n / size; linear between them but for the last entries.
struct QuantileTable {
  static constexpr int bits = 12, size = 1 << bits, exact_from = size - 48;
  std::array<float, size + 1> value{};
  QuantileTable() {
    for (int n = 0; n < size; ++n)
      value[static_cast<std::size_t>(n)] =
          static_cast<float>(half_normal_quantile(1.0 - static_cast<double>(n) / size));
    value[size] = value[size - 1];
  }
};

/// Of 32 random bits: a sign and where in (0, 1).
float normal_of_bits(const QuantileTable& table, std::uint32_t bits) {
  constexpr int rest = 31 - QuantileTable::bits;
  const std::uint32_t entry = bits << 1 >> (1 + rest);
  const std::uint32_t fraction = bits & ((1u << rest) - 1);
  float x;
  if (entry >= QuantileTable::exact_from) {
    const double part = (static_cast<double>(bits & 0x7fffffffu) + 0.5) * 0x1.0p-31;
    x = static_cast<float>(half_normal_quantile(1.0 - part));
  } else {
    const float low = table.value[entry], high = table.value[entry + 1];
    x = low + (high - low) * (static_cast<float>(fraction) * (1.0f / static_cast<float>(1u << rest)));
  }
  return (bits >> 31) != 0 ? -x : x;
}

}  // namespace

double uniform(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t bits = mixed(mixed(seed) ^ index) >> 11;
  return (static_cast<double>(bits) + 0.5) * 0x1.0p-53;
}

double normal(std::uint64_t seed, std::uint64_t index) {
  const double u = uniform(seed, 2 * index), v = uniform(seed, 2 * index + 1);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

void fill_normal(std::uint64_t seed, std::uint64_t first, std::span<float> out) {
  static const QuantileTable table;
  const std::uint64_t stream = mixed(seed);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint64_t index = first + i;
    const std::uint64_t word = mixed(stream ^ (index >> 1));
    out[i] = normal_of_bits(table, static_cast<std::uint32_t>((index & 1) != 0 ? word >> 32 : word));
  }
}

}  // namespace ostia::phantom
