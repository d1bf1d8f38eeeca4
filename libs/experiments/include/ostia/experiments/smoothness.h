#pragma once
/// \file The experiment of [Luboz] 3.2: how smooth reconstructed surfaces of the phantom are, and how near to
/// the isosurfaces of its scans, beside what VTK makes of the same isosurfaces.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/experiments/orientations.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_graph.h"

#include <string>
#include <vector>

namespace ostia::experiments {

struct SmoothnessOptions {
  OrientationsOptions scans;
  int levels = 3;                                       ///< 0 to levels - 1; in [1, 4]
  std::vector<double> decimations{0.3, 0.5, 0.7, 0.9};  ///< shares of the triangles that go, in (0, 1)
  /// Iterations on an isosurface decimated to the triangles of level 1; ascending, > 0.
  std::vector<int> smoothings{1, 3, 10, 30, 100};
  double relaxation = 0.1;  ///< of the smoothing, in (0, 1]
  std::size_t vtk_at = 6;   ///< the orientation whose isosurface VTK decimates and smooths: the paper's M7
  double clear_mm = 6.0;    ///< what is nearer to a joint or a free end is not of the tubes alone; > 0
  double sample_mm = 0.2;   ///< distances are taken at points at least so dense; > 0
};
void validate(const SmoothnessOptions& options);  ///< throws InvalidInput

/// Root mean squares of the principal curvatures over the vertices, weighted by area, 1/mm; positive where
/// the surface bulges. NaN where no vertex counts.
struct Bending {
  double rms_kappa1 = 0.0;  ///< the lesser one: along a straight tube, where it is 0
  double rms_kappa2 = 0.0;  ///< the greater one: around it, where it is 1 / r
  /// Each without the hundredth of the area where it is greatest: isosurfaces have needles, at whose corners
  /// the fit tells little.
  double trimmed_kappa1 = 0.0, trimmed_kappa2 = 0.0;
  std::size_t vertices = 0;
};
/// By evaluation::curvatures (a quadric over direct neighbours, [Luboz] 3.2) where `counts` holds.
Bending bending_of(const geometry::TriMesh& mesh, const evaluation::Region& counts,
                   const core::TaskContext& task = core::no_task());

/// A third of the triangles around each vertex, mm2.
std::vector<double> vertex_areas(const geometry::TriMesh& mesh);

enum class PhantomPlace { tube, joint, end };
/// What of the phantom a point, in the phantom's own frame, is nearest to: a joint or a free end, if within
/// `clear_mm`, or else a tube.
PhantomPlace place_of(const std::vector<PhantomTube>& tubes, const Vec3& point, double clear_mm);

/// Reconstructed with circles of the skeleton's radii at each level; at the level of the comparison with
/// circles of the isosurface's sections' areas, and with ellipses of their second moments as well.
enum class SurfaceKind { isosurface, level, areas, elliptic, decimated, smoothed };
/// Where sections are compared: level 1, or 0 without it.
int level_of_sections(const SmoothnessOptions& options);
/// One surface of one scan.
struct SurfaceFigures {
  std::string orientation;
  SurfaceKind kind = SurfaceKind::isosurface;
  double parameter =
      0.0;  ///< level (of areas and elliptic, too); share of the triangles that went; iterations
  std::size_t triangles = 0;
  Bending tubes;  ///< away from joints and free ends
  Bending wall;   ///< away from free ends
  Bending whole;
  /// From and to the isosurface ([Luboz] 3.2), ends and joints included; 0 for the isosurface itself.
  double rms_mm = 0.0, hausdorff_mm = 0.0;
  double tubes_rms_mm = 0.0;  ///< the same away from joints and free ends
  /// Of the vertices from the true tubes' surface, weighted by area; the mean away from joints and free ends
  /// is positive where the tubes are too wide.
  double true_rms_mm = 0.0, tubes_true_mean_mm = 0.0;
  bool closed = false;
  std::size_t self_intersections = 0;
};

/// A skeleton with all its loops as a network: its lines at equal steps no longer than `step_mm`, radii as
/// their means over a step to both sides, the nearest counting most.
geometry::VesselGraph network_of(const centerline::SkeletonGraph& skeleton, double step_mm);
/// Signed distance of a point, in the phantom's own frame, from the surface of all tubes together: negative
/// inside. Exact outside of joints and near the wall.
double distance_to_phantom(const std::vector<PhantomTube>& tubes, const Vec3& point);

/// One scan: segmented, its isosurface, its skeleton reconstructed at each level and from elliptic sections;
/// with `vtk`, what VTK makes of the isosurface as well. Deterministic. Throws what the steps throw.
std::vector<SurfaceFigures> measure_smoothness(const std::vector<PhantomTube>& tubes,
                                               const Orientation& orientation, bool vtk,
                                               const SmoothnessOptions& options = {},
                                               const core::TaskContext& task = core::no_task());
/// All scans, one behind the other.
std::vector<SurfaceFigures> measure_smoothness(const std::vector<PhantomTube>& tubes,
                                               const std::vector<Orientation>& orientations,
                                               const SmoothnessOptions& options = {},
                                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
