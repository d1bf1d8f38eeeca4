#pragma once
/// \file Where the branches of a surface end blindly: ends of closed lumens, and side branches that nobody
/// gave an axis. See docs/methods/foreign-surfaces.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <optional>
#include <vector>

namespace ostia::centerline {

struct TipOptions {
  /// A branch is as long as this many of its radii, at least; what is shorter is a bulge or a stub of the
  /// wall. A sphere on a thin neck measures about 5. In [2, 50].
  double least_length_radii = 6.0;
};
void validate(const TipOptions& options);

/// The blind end of a branch.
struct SurfaceTip {
  geometry::Vec3 point = geometry::Vec3::Zero();   ///< on the surface, mm
  geometry::Vec3 inside = geometry::Vec3::Zero();  ///< half a radius behind it, in the lumen
  double radius_mm = 0.0;  ///< of the branch near its end: area of a geodesic disc over its circumference
  double length_mm = 0.0;  ///< along the surface, from the tip to where the branch joins what is longer;
                           ///< of the farthest tip the distance from where the search began
  /// Wall in the last third of that length over wall in the middle one: 1 for a tube, more where a branch
  /// joins, below 0.7 for a ball, which narrows towards its neck. 1 without a look where the branch is longer
  /// than thirty radii, as no ball on a stalk is.
  double neck = 1.0;
  std::vector<geometry::Vec3> way;  ///< along the surface, from the tip to where the search began
};

/// Tips of one connected surface, closed or open, seen from `from` (a place in the lumen; left out: from the
/// point that is farthest from the farthest one, which is then a tip, too): maxima of the distance along the
/// surface that stand out by more than `least_length_radii` (0-dimensional persistence of its superlevel
/// sets). Open ends are none. Longest first. Deterministic. Throws InvalidInput (options; no triangles; more
/// than one part), Cancelled.
std::vector<SurfaceTip> find_tips(const geometry::TriMesh& surface,
                                  const std::optional<geometry::Vec3>& from = std::nullopt,
                                  const TipOptions& options = {},
                                  const core::TaskContext& task = core::no_task());

}  // namespace ostia::centerline
