#pragma once
/// \file Rules by which paths of a coronary tree get their names; docs/methods/coronary-labels.md explains
/// them.

#include "path_courses.h"

#include "ostia/coronary/labels.h"

#include <string>
#include <vector>

namespace ostia::coronary {

/// What a path is thought to be.
struct PathName {
  std::string kind;  ///< "LAD", "D", "OM", ... without numbers; empty: none of them
  double confidence = 0.0;
  std::string second;  ///< what else; empty: nothing
  double second_confidence = 0.0;
  CoronarySide side = CoronarySide::left;
  int parent = -1;        ///< index of the path it leaves; -1: begins at a root
  double leave_mm = 0.0;  ///< where it leaves it
};

struct MainVessels {
  int lad = -1, lcx = -1, rca = -1;  ///< indices of paths
  double bifurcation_mm = -1.0;      ///< where LAD and LCX part; below 0 where they do not
};

/// LAD, LCX and RCA among the paths of their sides that have no kind.
MainVessels name_main_vessels(const std::vector<TreePath>& paths, std::vector<PathName>& names);

/// By how much the heart is turned about its long axis, as far as the LAD tells.
double roll_of(const std::vector<TreePath>& paths, const MainVessels& main);

/// Points of the main vessels that run between atria and ventricles.
std::vector<Vec3> groove_points(const std::vector<TreePath>& paths, const MainVessels& main);

/// From vessels that are named with this confidence at least.
CoronaryDominance dominance_of(const std::vector<TreePath>& paths, const MainVessels& main,
                               const std::vector<PathName>& names, double least_confidence);

}  // namespace ostia::coronary
