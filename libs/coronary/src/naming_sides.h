#pragma once
/// \file Which of a tree's paths belong to the left coronary artery, which to the right one, and which to
/// neither.

#include "naming_rules.h"

#include <vector>

namespace ostia::coronary {

struct SidedNames {
  std::vector<PathName> names;  ///< one a path: its side, and a kind for main vessels and grafts
  MainVessels main;
  double log_likelihood = 0.0;  ///< of all ways to share the roots between left and right, up to a constant
};

/// Names grafts, then the main vessels under the likeliest sides of the roots: each root's ways lead to the
/// left or to the right, and what they lead to must make LAD, LCX and RCA. So an LCX from the right sinus and
/// an RCA from the left one are found; of a single coronary artery, each half has a side of its own. The
/// paths' places in the heart are those of `frame`.
SidedNames name_sided(const HeartFrame& frame, const std::vector<TreePath>& paths);

}  // namespace ostia::coronary
