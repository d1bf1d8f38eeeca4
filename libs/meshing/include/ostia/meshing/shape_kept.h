#pragma once
/// \file How a mesh keeps the shape of the surface that it was made of, looked at from both. See
/// docs/methods/mesh-quality.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/quality.h"

#include <vector>

namespace ostia::meshing {

/// Distances of one wall from the other. Names of the members are those of the JSON reports.
struct OneWayDeviation {
  std::size_t samples = 0;
  double max_mm = 0.0, p999_mm = 0.0, mean_mm = 0.0;
  /// The 99.9th percentile of distance over what is allowed there, 0.05 radii + 0.05 mm.
  double p999_share = 0.0;
  geometry::Vec3 worst_at = geometry::Vec3::Zero();  ///< where the share is largest, mm
};

struct ShapeKept {
  OneWayDeviation mesh_to_surface;  ///< what the mesh has beside the surface
  OneWayDeviation
      surface_to_mesh;  ///< what of the surface the mesh has not: a branch that is gone shows here
  double surface_volume_mm3 = 0.0, volume_mm3 = 0.0;
  double volume_change() const {  ///< of the mesh over that of the surface, less 1
    return surface_volume_mm3 > 0.0 ? volume_mm3 / surface_volume_mm3 - 1.0 : 0.0;
  }
};

/// Walls alone: points and centres of the triangles of both (of bent ones the four that their nodes make).
/// `surface` is closed, before remeshing; `radii_mm` has half the lumen's width at each of its points. Throws
/// InvalidInput (lists of different lengths, a surface or mesh without wall), Cancelled.
ShapeKept shape_kept(const geometry::MixedMesh& mesh, const geometry::FacedSurface& surface,
                     const std::vector<double>& radii_mm, const core::TaskContext& task = core::no_task());

/// Halves target edge lengths at the points of `surface` near which `remeshed` is off by more than
/// `most_share` of what is allowed, either way: for another round of remeshing. Both are closed and have
/// faces; `radii_mm` as above. Returns at how many points; 0 where the 99.9th percentiles are within
/// `most_share`. Throws as shape_kept does.
std::size_t shorten_where_off(const geometry::FacedSurface& surface, const geometry::FacedSurface& remeshed,
                              const std::vector<double>& radii_mm, double most_share,
                              std::vector<double>& edge_lengths_mm,
                              const core::TaskContext& task = core::no_task());

/// What a mesh must keep to pass. Meshing aims at less (a share of 0.8), which rough walls of segmented
/// images do not always reach; a branch that is gone is ten or more.
struct ShapeBounds {
  double max_volume_change = 0.01;  ///< (0, 1]
  double max_p999_share = 3.0;      ///< > 0
};
void validate(const ShapeBounds& bounds);
/// Reasons name the value, the bound and the place.
QualityVerdict check(const ShapeKept& shape, const ShapeBounds& bounds = {});

}  // namespace ostia::meshing
