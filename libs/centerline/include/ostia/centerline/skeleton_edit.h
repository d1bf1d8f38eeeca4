#pragma once
/// \file What is done to a skeleton's graph. All functions return a new graph; docs/methods/skeleton.md gives
/// the order in which they are used.

#include "ostia/centerline/skeleton_graph.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::centerline {

struct PruneOptions {
  double length_mm = 5.0;  ///< shorter leaves go, [0, 1000] ([Luboz] 3.1)
  /// Leaves go, too, that are no longer than this part of the radius at their junction: noise of a wide
  /// vessel's wall. [0, 5].
  double junction_radii = 1.0;
  bool isolated = true;  ///< components that are one short line or one voxel go as well
};
void validate(const PruneOptions& options);  ///< throws InvalidInput
/// Without short leaves: lines with an end that is no junction ([Luboz] 2.1). The shortest goes first; a
/// junction that is left with two lines becomes part of one line, whose length then counts. Loops stay.
SkeletonGraph pruned(const SkeletonGraph& graph, const PruneOptions& options = {});

/// Without loops: of each the line with the smallest mean radius goes, so that components stay what they are
/// (the lines that are left are a spanning forest of the widest). Where vessels touch, that is the bridge
/// between them. A closed line on its own goes whole. Two lines left at a node become one.
SkeletonGraph loops_opened(const SkeletonGraph& graph);

struct EndOptions {
  /// The end's own course is given up over this many radii (thinning leads it to an edge of the cap), [0, 3].
  double trimmed_radii = 1.0;
  double direction_mm = 5.0;  ///< length of line whose direction is followed, (0, 50]
  double most_radii = 3.0;    ///< how far beyond what is trimmed the new end may lie, [0, 20]
  double most_voxels = 6.0;   ///< and this many of the largest spacing more, [0, 20]
};
void validate(const EndOptions& options);  ///< throws InvalidInput
/// Thinning ends a line about a radius inside the object. Here each end's last part gives way to a straight
/// line to where the mask, linear between voxels, falls to one half. Of a short line half is trimmed at most;
/// ends outside the mask stay.
SkeletonGraph ends_extended(const SkeletonGraph& graph, const imaging::MaskVolume& mask,
                            const EndOptions& options = {});

struct JunctionOptions {
  /// A line's own course is given up over this many of the junction's radii, where other vessels' walls and
  /// the thinning lead it, [0, 5]; over no more than a third of the line.
  double trimmed_radii = 1.5;
  double direction_mm = 5.0;  ///< length of line beyond that whose direction is followed, (0, 50]
  double most_radii = 1.5;    ///< how far a junction may move, [0, 10]
};
void validate(const JunctionOptions& options);  ///< throws InvalidInput
/// Thinning puts a junction where the voxels fall, and leads lines to it that are nobody's axis. Here each
/// junction moves to where the straight lines that go on from its lines' outer parts come nearest to each
/// other (least squares), and the lines lead there straight. Radii are those where the course is given up.
SkeletonGraph junctions_settled(const SkeletonGraph& graph, const JunctionOptions& options = {});

struct GapOptions {
  double distance_mm = 2.0;   ///< between ends, [0, 100] ([Luboz] 3.1)
  double angle_deg = 45.0;    ///< most between either line's direction and the other's, and the gap, (0, 180]
  double direction_mm = 5.0;  ///< length of line that gives a direction, (0, 50]
};
void validate(const GapOptions& options);  ///< throws InvalidInput
/// Joins ends that are near and go on in each other's direction ([Luboz] 2.1), the nearest first, each end
/// once. A gap below a quarter of `direction_mm` says nothing itself: there the lines' directions alone
/// count.
SkeletonGraph gaps_closed(const SkeletonGraph& graph, const GapOptions& options = {});

struct OrientOptions {
  double snap_mm = 10.0;  ///< how far an inlet may lie off the graph, (0, 1000]
  /// In a component without an inlet the flow begins at the widest end (or node); else its lines keep the
  /// direction that they had.
  bool guess = true;
};
void validate(const OrientOptions& options);  ///< throws InvalidInput
struct OrientedSkeleton {
  SkeletonGraph graph;
  std::vector<std::int32_t> inlets;   ///< node ids, one a given place
  std::vector<std::int32_t> guessed;  ///< node ids, one a component without a given inlet
};
/// Directs all edges away from the inlets: from the end that is nearer to an inlet along the lines (of equals
/// the lower id) to the other, those in loops too, so that there is no directed circle but of an edge from a
/// node to itself. An inlet takes the nearest end within `snap_mm`, else the nearest place of a line, which
/// is cut there. Throws InvalidInput for a place farther off or not finite, or no edges.
OrientedSkeleton oriented(const SkeletonGraph& graph, const std::vector<Vec3>& inlets,
                          const OrientOptions& options = {});

struct SplineOptions {
  double knot_spacing_mm =
      4.0;               ///< between the knots of each line, about: they are equally spaced, [0.1, 1000]
  double step_mm = 0.5;  ///< between the points of the result; 0: as many as there were, [0, 10]
};
void validate(const SplineOptions& options);  ///< throws InvalidInput
/// Each line replaced by the cubic B-spline of least squares to its points over their chord lengths, its ends
/// (so all bifurcations) fixed ([Wischgoll] 3); in a closed line without junction the anchor moves to
/// the opposite side.
/// Radii are interpolated.
SkeletonGraph smoothed(const SkeletonGraph& graph, const SplineOptions& options = {});

/// By hand. A place within `snap_mm` of a node means the node, else the nearest point of a line, which is cut
/// there. All throw InvalidInput for places farther than `reach_mm` from the graph or not finite. The result
/// is not oriented.
struct PlaceOptions {
  double snap_mm = 1.0;
  double reach_mm = 5.0;
};
void validate(const PlaceOptions& options);  ///< throws InvalidInput
/// A straight line between two places of the graph. Throws where both are the same place.
SkeletonGraph connected(const SkeletonGraph& graph, const Vec3& from, const Vec3& to,
                        const PlaceOptions& options = {});
/// The line at the place becomes two with an end each; a closed line becomes open. Throws where a node is
/// within snap_mm of the place, unless it is a passage or a loop's anchor, which is then opened.
SkeletonGraph cut(const SkeletonGraph& graph, const Vec3& place, const PlaceOptions& options = {});
/// Without an edge; nodes that only it had go too, and two lines that are left at a node become one. Throws
/// for an unknown id.
SkeletonGraph removed(const SkeletonGraph& graph, std::int32_t edge_id);
/// The edge whose line is nearest to the place (of equals the lower id). Throws where none is within
/// reach_mm.
std::int32_t edge_at(const SkeletonGraph& graph, const Vec3& place, const PlaceOptions& options = {});

}  // namespace ostia::centerline
