#pragma once
/// \file A cage over the cycle of the heart: what carries a surface, or any other points, from phase to
/// phase.

#include "ostia/geometry/cage.h"

#include <string>
#include <vector>

namespace ostia::geometry {

/// Where a phase's cage comes from.
enum class PhaseOrigin {
  at_rest,  ///< the template's own phase
  fitted,   ///< to a surface of that phase
  bridged,  ///< there was none: from its neighbours in time
};

/// One phase of the cycle.
struct CagePhase {
  double phase = 0.0;                ///< share of the cycle since the R peak, in [0, 1)
  std::vector<Vec3> control_points;  ///< mm, as many as the grid has
  PhaseOrigin origin = PhaseOrigin::fitted;
};

/// The grid is the cage at rest, around the template: what is inside goes with its control points.
struct CageMotion {
  CageGrid grid;
  double template_phase = 0.75;   ///< share of the cycle
  std::vector<CagePhase> phases;  ///< rising
};

/// A share of the cycle as people say it: "35 %", "12.5 %"; to a hundredth of a percent.
std::string percent_text(double phase);

/// Throws InvalidInput that names the phase: no phases, phases that do not rise from 0 to below 1, another
/// number of points than the grid has, values that are not finite, a grid without size, more than 2^8 cells a
/// side. `name` begins the message.
void validate(const CageMotion& motion, const std::string& name = "the cage's motion");

}  // namespace ostia::geometry
