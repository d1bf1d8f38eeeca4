#pragma once
/// \file From the ends of a scanned tree down to the capillaries, by published morphometry. See
/// docs/methods/tree-growth.md.

#include "ostia/analysis/coronary_morphometry.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_graph.h"

#include <functional>

namespace ostia::analysis {

/// Where vessels may grow: how far inside it a place is, mm; below 0 outside. Near the border to first order.
using GrowthDomain = std::function<double(const geometry::Vec3&)>;

/// The left ventricle's wall: between two ellipsoids of revolution about one axis, cut off at the base.
struct MyocardialShell {
  geometry::Vec3 base = geometry::Vec3::Zero();   ///< middle of the base's plane
  geometry::Vec3 axis = geometry::Vec3::UnitZ();  ///< from the base to the apex
  double length_mm = 90.0, radius_mm = 40.0;      ///< of the outer one: base to apex, and at the base
  double wall_mm = 12.0;
  bool whole = false;  ///< not cut off at the base, which is then the middle
};
GrowthDomain domain_of(const MyocardialShell& shell);  ///< Throws InvalidInput for sizes that make no shell
/// The inside of a closed surface, to round-off. A question takes some 20 us: growth through it is slower
/// than through a shell. Throws InvalidInput for a surface without triangles.
GrowthDomain domain_of(const geometry::TriMesh& closed);
/// A spherical shell whose outer surface is the sphere nearest to the tree's points, by least squares: where
/// nothing is known of the heart but the vessels that lie on it. Throws InvalidInput for fewer than four
/// points or points in a plane.
MyocardialShell shell_about(const geometry::VesselGraph& graph, double wall_mm = 12.0);

struct GrowthOptions {
  CoronaryArtery artery = CoronaryArtery::left_anterior;
  std::uint64_t seed = 1;
  std::int64_t most_segments = 20'000'000;
};

struct GrownTree {
  /// The scanned segments first, as they were; then the grown ones, each behind its parent. No references.
  geometry::VesselGraph graph;
  std::vector<std::int32_t> order;     ///< of each segment; 0: scanned
  std::vector<std::int32_t> element;   ///< of each segment: its element's number, from 0; -1: scanned
  std::int64_t elements = 0;           ///< that were asked for, with those left out
  std::int64_t elements_left_out = 0;  ///< that had no room, with all behind them
  std::int64_t elements_shortened = 0;
};

/// Grows a tree from each end of the graph (a point that is reached and not left) by its diameter's order.
/// Orders 9 and up run along the wall, the rest wherever there is room. No segment
/// grows into another, bends and forks apart (see OverlapOptions). The same for the same seed. Throws
/// InvalidInput (no ends, bad numbers), ResourceError for more than `most_segments`, Cancelled.
GrownTree grow_tree(const geometry::VesselGraph& scanned, const GrowthDomain& domain,
                    const GrowthOptions& options = {}, const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
