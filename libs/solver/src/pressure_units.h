#pragma once
/// \file Units of pressure.

namespace ostia::solver {

inline constexpr double pa_per_mmhg = 133.322387415;

}  // namespace ostia::solver
