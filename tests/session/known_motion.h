#pragma once
/// \file A motion that is known everywhere: affine, so that any cage carries it exactly.

#include "ostia/geometry/cage_motion.h"

#include <cmath>
#include <numbers>

namespace ostia::session::testing {

inline constexpr double own_phase = 0.75, thinning = 0.2, shortening = 0.1, shift_mm = 4.0;

/// 0 at the template's phase, 1 half a cycle from it.
inline double contraction(double phase) {
  return 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * (phase - own_phase)));
}

/// Thinner across z, shorter along it, and shifted along x.
inline geometry::Vec3 moved(const geometry::Vec3& p, double phase) {
  const double c = contraction(phase);
  return {(1.0 - thinning * c) * p.x() + shift_mm * c, (1.0 - thinning * c) * p.y(),
          (1.0 - shortening * c) * p.z()};
}

/// Of a cage around a box, `places_of(point, phase)` at evenly spaced phases; the fourth is bridged.
template <class Places>
geometry::CageMotion motion_of(const geometry::Vec3& low, const geometry::Vec3& high, const Places& places_of,
                               int phases = 20) {
  geometry::CageMotion motion;
  motion.grid = geometry::cage_around({low, high}, 2);
  motion.template_phase = own_phase;
  for (int k = 0; k < phases; ++k) {
    geometry::CagePhase one;
    one.phase = static_cast<double>(k) / phases;
    one.origin = k == 3 ? geometry::PhaseOrigin::bridged : geometry::PhaseOrigin::fitted;
    if (std::abs(one.phase - own_phase) < 1e-9) one.origin = geometry::PhaseOrigin::at_rest;
    for (const geometry::Vec3& p : geometry::rest_points(motion.grid))
      one.control_points.push_back(places_of(p, one.phase));
    motion.phases.push_back(std::move(one));
  }
  return motion;
}

inline geometry::CageMotion known_motion(const geometry::Vec3& low, const geometry::Vec3& high,
                                         int phases = 20) {
  return motion_of(
      low, high, [](const geometry::Vec3& p, double phase) { return moved(p, phase); }, phases);
}

}  // namespace ostia::session::testing
