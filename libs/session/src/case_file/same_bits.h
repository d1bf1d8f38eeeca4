#pragma once
/// \file Numbers compared as they are stored.

#include <cstring>

namespace ostia::session {

inline bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace ostia::session
