#pragma once
/// \file A coronary-like tree over a heartbeat, for the tests of motions.

#include "moved_tree.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::motion::testing {

/// How far the beat has gone: none at 75 %, where the heart is nearly still; the largest half a cycle off.
inline double amount_at(double phase) {
  return 0.2 * (1.0 - std::cos(2.0 * std::numbers::pi * (phase - 0.75)));
}

inline const geometry::TriMesh& still_tree() {
  static const geometry::TriMesh mesh = geometry::surface_of(geometry::coronary_like_tree(), 1.0, false);
  return mesh;
}

struct BeatingPhase {
  double phase;      ///< share of the cycle
  std::string name;  ///< of a file
  geometry::TriMesh surface;
};

/// Phases evenly spaced from 0 on; every second in other triangles, as segmentations have them.
inline std::vector<BeatingPhase> beating_tree(int count) {
  static const geometry::TriMesh other = geometry::surface_of(geometry::coronary_like_tree(), 1.1, false);
  std::vector<BeatingPhase> phases;
  for (int k = 0; k < count; ++k) {
    const double phase = static_cast<double>(k) / count;
    const bool own = std::abs(phase - 0.75) < 1e-9 || k % 2 == 0;
    phases.push_back({phase, "phase_" + std::to_string(100 * k / count) + ".vtp",
                      moved(own ? still_tree() : other, amount_at(phase))});
  }
  return phases;
}

}  // namespace ostia::motion::testing
