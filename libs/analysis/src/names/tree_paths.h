#pragma once
/// \file A tree taken apart into the parts that its vessels own, and where those meet.

#include "ostia/analysis/moving_tree.h"

namespace ostia::analysis {

/// A branch's segments, proximal first.
struct BranchPath {
  std::int32_t vessel = 0;
  std::string name;
  std::vector<const geometry::TreeSegment*> segments;  ///< of the tree that was asked
};

/// Each segment goes to the first vessel that passes through it; those without a vessel are alone.
std::vector<BranchPath> branch_paths(const geometry::VesselTree& tree);

/// The branch's points and radii, shared nodes once, with abscissas. `node_points`: the index of the point at
/// each node of the path, the first and the last included.
geometry::Centerline joined(const BranchPath& path, std::vector<std::size_t>* node_points = nullptr);

/// `node_s[b]`: the abscissas of the nodes on branch b. Radii are taken from the branches.
std::vector<Joint> joints_of(const std::vector<BranchPath>& paths,
                             const std::vector<std::vector<double>>& node_s,
                             const std::vector<MovingBranch>& branches);

/// Linear between points, clamped to the ends.
double at_abscissa(const std::vector<double>& s_mm, const std::vector<double>& values, double s);
Vec3 at_abscissa(const std::vector<double>& s_mm, const std::vector<Vec3>& values, double s);

}  // namespace ostia::analysis
