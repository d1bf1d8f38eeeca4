#pragma once
/// \file Radians to degrees.

#include <numbers>

namespace ostia::analysis {

inline constexpr double degrees = 180.0 / std::numbers::pi;

}  // namespace ostia::analysis
