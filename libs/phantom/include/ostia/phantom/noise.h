#pragma once
/// \file Random numbers that depend on a seed and a place alone, so that any number of threads draws the
/// same.

#include <cstdint>

namespace ostia::phantom {

/// Uniform in (0, 1), of the pair (seed, index).
double uniform(std::uint64_t seed, std::uint64_t index);
/// Normal with mean 0 and deviation 1, of the pair (seed, index) (Box and Muller 1958).
double normal(std::uint64_t seed, std::uint64_t index);

}  // namespace ostia::phantom
