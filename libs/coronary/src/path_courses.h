#pragma once
/// \file Courses of paths that rules of names speak of.

#include "tree_paths.h"

namespace ostia::coronary {

// Angles about the long axis, degrees.
inline constexpr double anterior_groove = 5.0;
inline constexpr double posterolateral_to_posterior = 136.0;  // on the left
inline constexpr double acute_to_posterior = -165.0;          // on the right

// Depths towards the apex, mm.
inline constexpr double groove_depth = 30.0;  // no deeper: still between atria and ventricles
inline constexpr double least_lad_depth = 26.0;

/// 0 far below, 1/2 at, 1 far above: how sure a rule is whose measure lies `over` its bound.
double sure(double over, double softness);

/// How far a path follows the groove between atria and ventricles, `sign` * degrees, from `from_mm` on.
double sweep_deg(const TreePath& path, double from_mm, double sign);

/// How deep a path comes, and the angle at which it runs there: past its turn from the base, and before it
/// may wrap about the apex, where angles say nothing.
HeartPlace way_to_apex(const TreePath& path);

}  // namespace ostia::coronary
