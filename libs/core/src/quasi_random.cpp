#include "ostia/core/quasi_random.h"

#include "ostia/core/error.h"

#include <array>
#include <cmath>
#include <numeric>
#include <string>

namespace ostia::core {
namespace {

constexpr std::size_t most_dimensions = 1000;

/// SplitMix64 (Steele, Lea and Flood 2014) of a counter.
std::uint64_t mixed_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::vector<std::uint32_t> first_primes(std::size_t count) {
  std::vector<std::uint32_t> primes;
  for (std::uint32_t n = 2; primes.size() < count; ++n) {
    bool prime = true;
    for (const std::uint32_t p : primes) {
      if (p * p > n) break;
      if (n % p == 0) {
        prime = false;
        break;
      }
    }
    if (prime) primes.push_back(n);
  }
  return primes;
}

/// As many digits as a double between 0 and 1 can tell apart.
int digits_in(std::uint32_t base) {
  return static_cast<int>(std::ceil(53.0 / std::log2(static_cast<double>(base))));
}

double polynomial(const std::array<double, 8>& c, double x) {
  double sum = 0.0;
  for (std::size_t i = c.size(); i-- > 0;) sum = sum * x + c[i];
  return sum;
}

}  // namespace

ScrambledHalton::ScrambledHalton(std::size_t dimensions, std::uint64_t seed) {
  if (dimensions == 0 || dimensions > most_dimensions)
    throw InvalidInput("a sequence of points has 1 to 1000 dimensions, not " + std::to_string(dimensions));
  const std::vector<std::uint32_t> primes = first_primes(dimensions);
  for (std::size_t d = 0; d < dimensions; ++d) {
    Digits one;
    one.base = primes[d];
    const auto base = static_cast<std::size_t>(one.base);
    const int count = digits_in(one.base);
    one.turned.resize(base * static_cast<std::size_t>(count));
    std::uint64_t drawn = 0;
    for (int k = 0; k < count; ++k) {
      const auto first = one.turned.begin() + static_cast<std::ptrdiff_t>(base) * k;
      std::iota(first, first + static_cast<std::ptrdiff_t>(base), std::uint16_t{0});
      for (std::size_t i = base - 1; i > 0; --i) {  // Fisher and Yates
        const auto j = static_cast<std::size_t>(uniform_number(seed + 0x51ed270b * (d + 1), drawn++) *
                                                static_cast<double>(i + 1));
        std::swap(first[static_cast<std::ptrdiff_t>(i)], first[static_cast<std::ptrdiff_t>(j)]);
      }
    }
    digits_.push_back(std::move(one));
  }
}

double ScrambledHalton::at(std::uint64_t index, std::size_t dimension) const {
  const Digits& of = digits_[dimension];
  const double inverse = 1.0 / static_cast<double>(of.base);
  double value = 0.0, place = inverse;
  for (std::size_t k = 0; k < of.turned.size(); k += of.base) {
    value += place * static_cast<double>(of.turned[k + static_cast<std::size_t>(index % of.base)]);
    index /= of.base;
    place *= inverse;
  }
  constexpr double least = 0x1.0p-54;  // never 0 and never 1
  return value < least ? least : value > 1.0 - 2.0 * least ? 1.0 - 2.0 * least : value;
}

double uniform_number(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t bits = mixed_bits(mixed_bits(seed) ^ index) >> 11;
  return (static_cast<double>(bits) + 0.5) * 0x1.0p-53;
}

double normal_quantile(double p) {
  constexpr std::array<double, 8> a = {
      3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3, 1.3731693765509461125e4,
      4.5921953931549871457e4, 6.7265770927008700853e4, 3.3430575583588128105e4, 2.5090809287301226727e3};
  constexpr std::array<double, 8> b = {1.0,
                                       4.2313330701600911252e1,
                                       6.8718700749205790830e2,
                                       5.3941960214247511077e3,
                                       2.1213794301586595867e4,
                                       3.9307895800092710610e4,
                                       2.8729085735721942674e4,
                                       5.2264952788528545610e3};
  constexpr std::array<double, 8> c = {1.42343711074968357734e0,  4.63033784615654529590e0,
                                       5.76949722146069140550e0,  3.64784832476320460504e0,
                                       1.27045825245236838258e0,  2.41780725177450611770e-1,
                                       2.27238449892691845833e-2, 7.74545014278341407640e-4};
  constexpr std::array<double, 8> d = {1.0,
                                       2.05319162663775882187e0,
                                       1.67638483018380384940e0,
                                       6.89767334985100004550e-1,
                                       1.48103976427480074590e-1,
                                       1.51986665636164571966e-2,
                                       5.47593808499534494600e-4,
                                       1.05075007164441684324e-9};
  constexpr std::array<double, 8> e = {6.65790464350110377720e0,  5.46378491116411436990e0,
                                       1.78482653991729133580e0,  2.96560571828504891230e-1,
                                       2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                       2.71155556874348757815e-5, 2.01033439929228813265e-7};
  constexpr std::array<double, 8> f = {1.0,
                                       5.99832206555887937690e-1,
                                       1.36929880922735805310e-1,
                                       1.48753612908506148525e-2,
                                       7.86869131145613259100e-4,
                                       1.84631831751005468180e-5,
                                       1.42151175831644588870e-7,
                                       2.04426310338993978564e-15};
  if (!(p > 0.0 && p < 1.0)) throw InvalidInput("a quantile's share lies between 0 and 1");
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(a, r) / polynomial(b, r);
  }
  const double r = std::sqrt(-std::log(q < 0.0 ? p : 1.0 - p));
  const double x = r <= 5.0 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6)
                            : polynomial(e, r - 5.0) / polynomial(f, r - 5.0);
  return q < 0.0 ? -x : x;
}

void fill_normal_numbers(std::uint64_t seed, std::span<double> out) {
  const std::uint64_t stream = mixed_bits(seed);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint64_t bits = mixed_bits(stream ^ static_cast<std::uint64_t>(i)) >> 11;
    out[i] = normal_quantile((static_cast<double>(bits) + 0.5) * 0x1.0p-53);
  }
}

}  // namespace ostia::core
