#pragma once
/// \file The carotid phantom of [Antiga] (appendix, table 1), in silico.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/rigid_alignment.h"
#include "ostia/experiments/carotid_scan.h"
#include "ostia/geometry/centerline.h"
#include "ostia/segmentation/segment.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ostia::experiments {

/// The true lumen, and where it ends.
struct CarotidPhantom {
  geometry::TriMesh lumen;                  ///< closed
  std::vector<geometry::Centerline> lines;  ///< from the inlet to each outlet
};
/// Repairs a surface with open ends (pipeline::repaired), finds its axes and closes it. Throws GeometryError
/// where it is no vessel with at least two ends.
CarotidPhantom carotid_phantom(const geometry::TriMesh& open,
                               const core::TaskContext& task = core::no_task());

enum class CarotidScan { ct, mr_axial, mr_coronal };
const char* name_of(CarotidScan scan);  ///< "CT", "MR axial", "MR coronal"

struct CarotidOptions {
  std::vector<CarotidScan> scans{CarotidScan::ct, CarotidScan::mr_axial, CarotidScan::mr_coronal};
  std::vector<segmentation::WallFeature> features{segmentation::WallFeature::centred,
                                                  segmentation::WallFeature::upwind,
                                                  segmentation::WallFeature::edges};
  double ct_fwhm_mm = 0.7;    ///< of the scanner's line-spread function in the plane
  double ct_slice_mm = 1.25;  ///< full width at half maximum of the slice profile, and slices' distance
  double ct_noise = 10.0;     ///< HU, of a contrast of 300
  double mr_noise = 10.0;     ///< of a signal of 1,000
  /// Lower bounds of the fronts between surroundings (0) and lumen (1), tried in turn until the fronts meet.
  std::vector<double> thresholds{0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1};
  double tilt_deg = 2.0;         ///< the phantom lies askew in the scanner by so much about each axis
  double seed_inset_mm = 4.0;    ///< seeds lie so far from the lumen's ends
  double end_mm = 3.0;           ///< what lies nearer to a seed than this, along the vessel, does not count
  double section_step_mm = 0.5;  ///< of the measured sections
  int section_points = 60;       ///< on each profile
  double measured_bias_mm = -0.09, measured_sigma_mm = 0.06;  ///< of the measured points, along the normal
  double wide_mm = 3.0;  ///< diameter from which on a place counts as of the paper's calibre
  std::uint64_t seed = 1;
};
void validate(const CarotidOptions& options);  ///< throws InvalidInput

/// How the phantom lies in one scan.
struct CarotidImage {
  CarotidScan scan = CarotidScan::ct;
  imaging::ImageVolume image;
  geometry::RigidFit pose;  ///< from the phantom's frame to the scanner's
};
CarotidImage scan_carotid(const CarotidPhantom& phantom, CarotidScan scan, const CarotidOptions& options,
                          const core::TaskContext& task = core::no_task());

/// A point measured on the phantom's wall, with the outward normal of the outline there.
struct MeasuredPoint {
  geometry::Vec3 point = geometry::Vec3::Zero(), normal = geometry::Vec3::Zero();
};
/// `section_points` on each closed outline of the lumen in planes `section_step_mm` apart along z, each off
/// the wall by a normal error of the given bias and deviation along the wall's normal.
std::vector<MeasuredPoint> measured_points(const geometry::TriMesh& closed, const CarotidOptions& options);
/// Signed distances of points (with outward normals) to measured points: the mean over the six nearest whose
/// wall faces the same way of (p - m) . n, n half-way between both normals, which on a round wall is 0
/// wherever m lies. NaN where there is none.
std::vector<double> distances_to(const std::vector<MeasuredPoint>& measured,
                                 const std::vector<geometry::Vec3>& points,
                                 const std::vector<geometry::Vec3>& normals);

/// Signed distances of a model's vertices, mm; positive outside the truth.
struct Spread {
  std::size_t points = 0;
  double mean = 0.0, sd = 0.0, low = 0.0, high = 0.0;
};
Spread spread_of(const std::vector<double>& distances);

struct CarotidRun {
  CarotidScan scan = CarotidScan::ct;
  segmentation::WallFeature feature = segmentation::WallFeature::upwind;
  geometry::TriMesh model;               ///< as it was found, in the scanner's frame
  evaluation::RigidAlignment alignment;  ///< of its counted vertices onto the phantom
  Spread surface, points;                ///< all counted vertices against the surface and the measured points
  Spread wide_surface, wide_points;      ///< those where the lumen is at least `wide_mm` across
  std::vector<double> radius_mm,
      distance_mm;         ///< of each counted vertex: the lumen's there, and the distance
  double threshold = 0.0;  ///< at which the fronts met
  int iterations = 0;
  bool converged = false;
};

/// Level set with advection alone (w1 = w2 = 0, w3 = 1) on one scan.
CarotidRun segment_carotid(const CarotidPhantom& phantom, const CarotidImage& scan,
                           segmentation::WallFeature feature, const std::vector<MeasuredPoint>& measured,
                           const CarotidOptions& options, const core::TaskContext& task = core::no_task());

/// All scans and features of the options.
struct CarotidResult {
  std::vector<CarotidImage> images;
  std::vector<CarotidRun> runs;  ///< scan by scan, feature by feature
  std::vector<MeasuredPoint> measured;
  Spread measured_error;  ///< of the measured points against the surface
};
CarotidResult run_carotid(const CarotidPhantom& phantom, const CarotidOptions& options,
                          const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
