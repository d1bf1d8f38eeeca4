#pragma once
/// \file Made by `ostia experiment certainty`, not by hand (docs/methods/certainty.md).

namespace ostia::coronary {

inline constexpr double piece_constant = -14.8943;
inline constexpr double piece_weights[] = {-0.1915,  0.4589, -0.3691, 18.7210, -3.9944, 3.2196, -1.1441,
                                           -34.0006, 0.1139, -0.1853, 7.4030,  -0.0863, -0.2043};
inline constexpr double vessel_constant = -0.3274;
inline constexpr double vessel_weights[] = {0.5860, 0.3006, 0.3285};

}  // namespace ostia::coronary
