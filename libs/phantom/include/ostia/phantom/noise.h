#pragma once
/// \file Random numbers that depend on a seed and a place alone, so that any number of threads draws the
/// same.

#include <cstdint>
#include <span>

namespace ostia::phantom {

/// Uniform in (0, 1), of the pair (seed, index).
double uniform(std::uint64_t seed, std::uint64_t index);
/// Normal with mean 0 and deviation 1, of the pair (seed, index) (Box and Muller 1958).
double normal(std::uint64_t seed, std::uint64_t index);
/// Normal with mean 0 and deviation 1, element i of the pair (seed, first + i): some ten times faster than
/// `normal`, and other numbers than it (the inverse distribution function, tabulated).
void fill_normal(std::uint64_t seed, std::uint64_t first, std::span<float> out);

}  // namespace ostia::phantom
