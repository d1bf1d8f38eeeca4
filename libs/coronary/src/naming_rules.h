#pragma once
/// \file Rules by which paths of a coronary tree get their names; docs/methods/coronary-labels.md explains
/// them.

#include "tree_paths.h"

#include "ostia/coronary/labels.h"

#include <string>
#include <vector>

namespace ostia::coronary {

/// 0 far below, 1/2 at, 1 far above: how sure a rule is whose measure lies `x` over its bound.
double sure(double over, double softness);

/// What a path is thought to be.
struct PathName {
  std::string kind;  ///< "LAD", "D", "OM", ... without numbers; empty: none of them
  double confidence = 0.0;
  CoronarySide side = CoronarySide::left;
  int parent = -1;        ///< index of the path it leaves; -1: begins at a root
  double leave_mm = 0.0;  ///< where it leaves it
};

struct MainVessels {
  int lad = -1, lcx = -1, rca = -1;  ///< indices of paths
  double bifurcation_mm = -1.0;      ///< where LAD and LCX part; below 0 where they do not
};

/// The side to which each path's root belongs, with how sure that is.
void name_sides(const HeartFrame& frame, const std::vector<TreePath>& paths, std::vector<PathName>& names);
/// LAD, LCX and RCA among the paths of their sides.
MainVessels name_main_vessels(const std::vector<TreePath>& paths, std::vector<PathName>& names);
/// A path that leaves another which has its kind already.
void name_branch(const std::vector<TreePath>& paths, const MainVessels& main, std::vector<PathName>& names,
                 int branch);
/// Of the branches that run down behind, the posterior descending one and those beyond it.
void settle_posterior(const std::vector<TreePath>& paths, std::vector<PathName>& names);

/// Points of the main vessels that run between atria and ventricles.
std::vector<Vec3> groove_points(const std::vector<TreePath>& paths, const MainVessels& main);

/// From vessels that are named with this confidence at least.
CoronaryDominance dominance_of(const std::vector<TreePath>& paths, const MainVessels& main,
                               const std::vector<PathName>& names, double least_confidence);

}  // namespace ostia::coronary
