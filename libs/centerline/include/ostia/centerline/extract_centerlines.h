#pragma once
/// \file Centerlines of a vessel's surface: paths of minimal action on its inner Voronoi diagram ([Antiga]
/// section 4, eqs. 5 and 6), made smooth and centred, and joined to a tree.

#include "ostia/centerline/inner_voronoi.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::centerline {

using geometry::Centerline;
using geometry::TriMesh;
using geometry::Vec3;
using geometry::VesselTree;

struct CenterlineOptions {
  double step_mm = 0.1;  ///< longest step between points of the result, > 0
  double smoothing_radii =
      2.0;  ///< waves of the axis shorter than this many local radii are smoothed away, >= 0
  bool recentre =
      true;  ///< moves the axis to the centre of the wall around it, by no more than the surface's spacing
  double merge_fraction =
      0.15;  ///< paths become one where they are closer than this part of the inscribed radius, in (0, 1)
  std::vector<std::string> vessel_names;  ///< one a target; left empty they are vessel_1, vessel_2, ...
  bool keep_voronoi = false;              ///< fills CenterlineResult::voronoi
};
/// Throws InvalidInput that names the option.
void validate(const CenterlineOptions& options);

struct CenterlineDiagnostics {
  std::size_t surface_points = 0;  ///< of the capped, welded surface
  std::size_t welded_points = 0;   ///< duplicates that were joined to an equal point first
  std::size_t dropped_points = 0;  ///< points that the Delaunay triangulation did not take; always 0
  std::size_t delaunay_cells = 0;
  std::size_t inner_cells = 0;     ///< those whose circumcentre lies inside
  std::size_t doubtful_cells = 0;  ///< those whose normals disagreed and were settled by the winding number
  std::size_t polygons = 0;        ///< faces of the inner Voronoi diagram
  std::vector<std::string> warnings;
};

/// The inner Voronoi diagram with the solution of eq. 5, for display.
struct VoronoiDisplay {
  std::vector<Vec3> points;
  std::vector<double> radius;   ///< mm
  std::vector<double> arrival;  ///< T from the source; infinite where not reached
  std::vector<std::int32_t>
      polygon_first;  ///< first corner of each polygon in `corners`, and the end: one more than polygons
  std::vector<std::int32_t> corners;
};

struct CenterlineResult {
  VesselTree
      tree;  ///< split at bifurcations; one vessel a target that no other vessel passes, from the source
  std::vector<Centerline> lines;  ///< one a target, from the source; those of one tree share their points
                                  ///< upstream of where they part
  Vec3 source = Vec3::Zero();     ///< as used: the hole's barycentre, or the first point
  double source_radius = 0.0;     ///< mm
  std::vector<Vec3> ends;         ///< the targets as used
  std::vector<double> end_radii;  ///< mm, one a target
  CenterlineDiagnostics diagnostics;
  VoronoiDisplay voronoi;  ///< empty unless asked for
};

/// Centerlines from `source` to each of `targets`, in mm.
///
/// `lumen` may be closed or open, with needles, duplicate points and small holes; holes are capped inside the
/// function, so that its inside is defined. Without `targets` every open end but the source's is a target;
/// without `source` the open end with the longest border is the source. A hole in the wall (its centre is far
/// off the axis) is no end and is reported as a warning. `known`, where it is of this surface, spares finding
/// again what it holds. A given point belongs to an open end when it is
/// close to its centre, and the line then reaches that hole's barycentre; any other point is moved to the
/// centre of the inscribed sphere that holds it deepest.
///
/// Throws InvalidInput (options; points that are not finite; no ends to work with; names that do not match),
/// GeometryError (no triangles, all points in a plane, a border that is not manifold, a point outside the
/// surface, a target that cannot be reached; named by index and coordinates), Cancelled.
CenterlineResult extract_centerlines(const TriMesh& lumen, std::optional<Vec3> source,
                                     const std::vector<Vec3>& targets, const CenterlineOptions& options = {},
                                     const core::TaskContext& task = core::no_task(),
                                     const KnownSurface* known = nullptr);

}  // namespace ostia::centerline
