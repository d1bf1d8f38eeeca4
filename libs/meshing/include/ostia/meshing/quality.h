#pragma once
/// \file How good a surface or a volume mesh is, and whether a solver may have it.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <array>
#include <string>
#include <vector>

namespace ostia::meshing {

/// Smallest angle of a triangle, degrees; 0 when degenerate.
double min_angle_deg(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c);
/// (e1^2 + e2^2 + e3^2) / (4 sqrt(3) area), [Antiga] 6.1: 1 for an equilateral triangle, infinite when
/// degenerate.
double frobenius_aspect(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c);
/// Smallest and largest of the six dihedral angles of a tetrahedron, degrees; {0, 180} when degenerate.
std::array<double, 2> dihedral_range_deg(const geometry::Vec3& a, const geometry::Vec3& b,
                                         const geometry::Vec3& c, const geometry::Vec3& d);
/// sqrt(2) det / the largest product of three edges at a corner: 1 for a regular tetrahedron, negative when
/// inverted.
double scaled_jacobian(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c,
                       const geometry::Vec3& d);

/// Names of the members are those of the JSON reports.
struct SurfaceQuality {
  std::size_t points = 0, triangles = 0;
  double min_angle_deg = 0.0;
  double mean_min_angle_deg = 0.0;
  double max_frobenius_aspect = 0.0;
  double mean_frobenius_aspect = 0.0;
  std::array<std::size_t, 13> valence{};  ///< used points by valence; the last counts 12 and more
  double mean_edge_mm = 0.0;
  std::size_t open_edges = 0, non_manifold_edges = 0, inconsistent_edges = 0;
  std::size_t self_intersections = 0;  ///< pairs; 0 when not asked for
  double area_mm2 = 0.0;
  double volume_mm3 = 0.0;  ///< 0 for an open surface
};
SurfaceQuality surface_quality(const geometry::TriMesh& mesh, bool with_self_intersections = true,
                               const core::TaskContext& task = core::no_task());

struct VolumeQuality {
  std::size_t points = 0, tetrahedra = 0, boundary_triangles = 0;
  double min_dihedral_deg = 0.0, max_dihedral_deg = 0.0;
  double mean_min_dihedral_deg = 0.0;
  std::array<std::size_t, 18>
      min_dihedral_histogram{};  ///< tetrahedra by smallest dihedral, bins of 5 degrees
  double min_scaled_jacobian = 0.0, mean_scaled_jacobian = 0.0;
  std::size_t inverted = 0;  ///< tetrahedra whose volume is not positive
  std::size_t boundary_mismatches =
      0;  ///< outer faces of tetrahedra that `boundary` has not, and the reverse
  double mean_edge_mm = 0.0;
  double volume_mm3 = 0.0;
};
VolumeQuality volume_quality(const geometry::VolumeMesh& mesh,
                             const core::TaskContext& task = core::no_task());

/// The gate of surfaces (that of volumes: mixed_quality.h). A bound that is not passed becomes a reason.
struct QualityBounds {
  double min_angle_deg = 20.0;        ///< of the surface, [0, 60)
  double max_frobenius_aspect = 3.0;  ///< >= 1
};
void validate(const QualityBounds& bounds);

struct QualityVerdict {
  std::vector<std::string> reasons;  ///< empty when all is well
  bool ok() const { return reasons.empty(); }
  std::string summary() const;  ///< "passed", or the reasons joined by "; "
};
/// A surface must be closed, manifold, consistently oriented and outward, free of self-intersections, and
/// within bounds.
QualityVerdict check(const SurfaceQuality& quality, const QualityBounds& bounds = {});

}  // namespace ostia::meshing
