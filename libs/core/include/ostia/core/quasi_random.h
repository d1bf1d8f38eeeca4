#pragma once
/// \file Numbers for Monte Carlo that depend on a seed and a place alone: evenly spread points, and normal
/// numbers.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ostia::core {

/// Halton's points in (0, 1)^d, each digit of each dimension turned by a random permutation of its own (Owen
/// 2017, arXiv:1706.02808): every point is uniform, and the first n of them are spread more evenly than
/// chance would. Immutable; asked from many threads.
class ScrambledHalton {
 public:
  /// Throws InvalidInput for no dimension, or more than 1,000.
  ScrambledHalton(std::size_t dimensions, std::uint64_t seed);
  std::size_t dimensions() const { return digits_.size(); }
  double at(std::uint64_t index, std::size_t dimension) const;  ///< `dimension` below dimensions()

 private:
  struct Digits {
    std::uint32_t base = 2;
    std::vector<std::uint16_t> turned;  // digit k of value v: turned[k base + v]
  };
  std::vector<Digits> digits_;
};

/// Uniform in (0, 1), of the pair (seed, index).
double uniform_number(std::uint64_t seed, std::uint64_t index);

/// x with P(normal < x) = p, to 1e-15 of itself (Wichura 1988, algorithm AS 241). Throws InvalidInput unless
/// 0 < p < 1.
double normal_quantile(double p);

/// Normal numbers of mean 0 and deviation 1: element i of (seed, i).
void fill_normal_numbers(std::uint64_t seed, std::span<double> out);

}  // namespace ostia::core
