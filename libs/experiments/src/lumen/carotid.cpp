#include "ostia/experiments/carotid.h"

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/kd_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/polyline.h"
#include "ostia/phantom/noise.h"
#include "ostia/pipeline/lumen_surface.h"
#include "ostia/pipeline/repair.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::experiments {
namespace {

using geometry::Mat3;
using geometry::RigidFit;
using geometry::Vec3;

constexpr double ct_surroundings = 50.0, ct_contrast = 300.0;
constexpr double mr_signal = 1000.0;
constexpr double mr_plane_mm = 0.78, mr_slice_mm = 2.0;  // acquired; twice as fine after zero-filling
constexpr double ct_plane_mm = 0.25;
constexpr double margin_mm = 6.0;  // about the phantom

/// A seed, and which way the vessel ends there.
struct Seed {
  Vec3 point, outward;
};

Seed seed_at(const geometry::Centerline& line, double abscissa, double to_end) {
  const Vec3 at = geometry::at_abscissa(line.points, abscissa).point;
  return {at, (geometry::at_abscissa(line.points, abscissa + to_end).point - at).normalized()};
}

/// The inlet's seed, then each outlet's.
std::vector<Seed> seeds_of(const CarotidPhantom& phantom, double inset) {
  std::vector<Seed> seeds{seed_at(phantom.lines.front(), inset, -1.0)};
  for (const geometry::Centerline& line : phantom.lines)
    seeds.push_back(seed_at(line, line.abscissa.back() - inset, 1.0));
  return seeds;
}

RigidFit pose_of(const CarotidPhantom& phantom, CarotidScan scan, const CarotidOptions& options) {
  const Vec3 centre = geometry::bounds(phantom.lumen.points).center();
  const auto drawn = [&](std::uint64_t n) {
    return 2.0 * phantom::uniform(options.seed, 16 * (1 + static_cast<std::uint64_t>(scan)) + n) - 1.0;
  };
  RigidFit pose;
  for (int d = 0; d < 3; ++d) {
    const double angle = options.tilt_deg * std::numbers::pi / 180.0 * drawn(static_cast<std::uint64_t>(d));
    pose.rotation = Eigen::AngleAxisd(angle, Vec3::Unit(d)).toRotationMatrix() * pose.rotation;
  }
  pose.shift = centre - pose.rotation * centre + 0.5 * Vec3(drawn(3), drawn(4), drawn(5));
  return pose;
}

geometry::TriMesh moved(const geometry::TriMesh& mesh, const RigidFit& motion) {
  geometry::TriMesh out = mesh;
  for (Vec3& p : out.points) p = motion(p);
  return out;
}

/// A grid about the phantom whose axes hold a whole number of `sample` each.
imaging::Geometry grid_about(const geometry::TriMesh& mesh, const Mat3& axes, const Vec3& spacing,
                             const Vec3& sample) {
  imaging::Geometry grid;
  grid.direction = axes;
  grid.spacing = spacing;
  geometry::Box3 box;
  for (const Vec3& p : mesh.points) box.extend(axes.transpose() * p);
  Vec3 first;
  for (int d = 0; d < 3; ++d) {
    const double samples = std::ceil((box.sizes()[d] + 2.0 * margin_mm) / sample[d]);
    grid.size[d] = std::llround(samples * sample[d] / spacing[d]);
    first[d] = box.center()[d] - 0.5 * spacing[d] * static_cast<double>(grid.size[d] - 1);
  }
  grid.origin = axes * first;
  return grid;
}

SurfaceScanOptions scanner_of(CarotidScan scan, const geometry::TriMesh& lumen,
                              const CarotidOptions& options) {
  using Kind = AxisResponse::Kind;
  SurfaceScanOptions how;
  how.seed = options.seed + 10 * static_cast<std::uint64_t>(scan);
  if (scan == CarotidScan::ct) {
    const Vec3 spacing(ct_plane_mm, ct_plane_mm, options.ct_slice_mm);
    how.grid = grid_about(lumen, Mat3::Identity(), spacing, spacing);
    how.response = {AxisResponse{Kind::gaussian, options.ct_fwhm_mm},
                    AxisResponse{Kind::gaussian, options.ct_fwhm_mm},
                    AxisResponse{Kind::gaussian, options.ct_slice_mm}};
    how.outside = ct_surroundings;
    how.inside = ct_surroundings + ct_contrast;
    how.noise = options.ct_noise;
    return how;
  }
  Mat3 axes = Mat3::Identity();
  if (scan == CarotidScan::mr_coronal) axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // k runs to the back, j down
  const Vec3 sample(mr_plane_mm, mr_plane_mm, mr_slice_mm);
  how.grid = grid_about(lumen, axes, 0.5 * sample, sample);
  for (int d = 0; d < 3; ++d) how.response[static_cast<std::size_t>(d)] = {Kind::k_space, sample[d]};
  how.outside = 0.0;
  how.inside = mr_signal;
  how.noise = options.mr_noise;
  how.magnitude = true;
  return how;
}

segmentation::SegmentOptions method_of(CarotidScan scan, segmentation::WallFeature feature,
                                       double threshold) {
  segmentation::SegmentOptions how;
  how.feature = feature;
  how.level_set.inflation = 0.0;
  how.level_set.curvature = 0.0;
  how.level_set.advection = 1.0;
  const bool ct = scan == CarotidScan::ct;
  how.fronts.lower_hu = (ct ? ct_surroundings : 0.0) + threshold * (ct ? ct_contrast : mr_signal);
  how.fronts.upper_hu = 3000.0;
  return how;
}

/// A person lowers the threshold until the fronts meet; where the surface ends up does not depend on it.
segmentation::SegmentationResult segmented_at_highest(const CarotidImage& scan,
                                                      const std::vector<segmentation::BranchSeeds>& branches,
                                                      segmentation::WallFeature feature,
                                                      const CarotidOptions& options, double& threshold,
                                                      const core::TaskContext& task) {
  for (const double tried : options.thresholds) {
    threshold = tried;
    try {
      return segmentation::segment_vessels(scan.image, branches, method_of(scan.scan, feature, tried), task);
    } catch (const GeometryError&) {
      if (tried == options.thresholds.back()) throw;
    }
  }
  throw InvalidInput("carotid experiment: no threshold is given");
}

/// Whether a place of the phantom lies at an end, or beyond.
bool at_end(const Vec3& place, const std::vector<Seed>& seeds, double end_mm) {
  constexpr double about_mm = 8.0;  // farther off it belongs to another vessel
  return std::any_of(seeds.begin(), seeds.end(), [&](const Seed& seed) {
    const Vec3 away = place - seed.point;
    const double along = away.dot(seed.outward);
    return along > -end_mm && (away - along * seed.outward).norm() < about_mm && along < 2.0 * about_mm;
  });
}

/// The radius of the lumen about places, from the nearest point of its axes.
class Calibre {
 public:
  explicit Calibre(const CarotidPhantom& phantom) : tree_(points_of(phantom)) {
    for (const auto& line : phantom.lines)
      radius_.insert(radius_.end(), line.radius.begin(), line.radius.end());
  }
  double at(const Vec3& place) const { return radius_[static_cast<std::size_t>(tree_.nearest(place))]; }

 private:
  static std::vector<Vec3> points_of(const CarotidPhantom& phantom) {
    std::vector<Vec3> points;
    for (const auto& line : phantom.lines)
      points.insert(points.end(), line.points.begin(), line.points.end());
    return points;
  }
  geometry::KdTree tree_;
  std::vector<double> radius_;
};

/// Vertices of the model that count, in the scanner's frame, with the surface's normals.
struct Counted {
  std::vector<Vec3> points, normals;
};

Counted counted(const geometry::TriMesh& model, const RigidFit& pose, const std::vector<Seed>& seeds,
                double end_mm) {
  const std::vector<Vec3> normals = geometry::vertex_normals(model);
  Counted out;
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const Vec3 place = pose.rotation.transpose() * (model.points[i] - pose.shift);
    if (at_end(place, seeds, end_mm)) continue;
    out.points.push_back(model.points[i]);
    out.normals.push_back(normals[i]);
  }
  return out;
}

std::vector<double> where_wide(const std::vector<double>& values, const std::vector<double>& radius,
                               double wide_mm) {
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (2.0 * radius[i] >= wide_mm) out.push_back(values[i]);
  return out;
}

}  // namespace

const char* name_of(CarotidScan scan) {
  switch (scan) {
    case CarotidScan::ct:
      return "CT";
    case CarotidScan::mr_axial:
      return "MR axial";
    case CarotidScan::mr_coronal:
      return "MR coronal";
  }
  return "";
}

void validate(const CarotidOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("carotid experiment: ") + what);
  };
  require(!o.scans.empty() && !o.features.empty(), "at least one scan and one feature are needed");
  require(o.ct_fwhm_mm > 0.0 && o.ct_fwhm_mm <= 5.0, "ct_fwhm_mm must be in (0, 5]");
  require(o.ct_slice_mm > 0.0 && o.ct_slice_mm <= 10.0, "ct_slice_mm must be in (0, 10]");
  require(o.ct_noise >= 0.0 && o.ct_noise <= 500.0 && o.mr_noise >= 0.0 && o.mr_noise <= 500.0,
          "noise must be in [0, 500]");
  require(!o.thresholds.empty() && std::all_of(o.thresholds.begin(), o.thresholds.end(),
                                               [](double t) { return t > 0.0 && t < 1.0; }),
          "at least one threshold is needed, each in (0, 1)");
  require(o.tilt_deg >= 0.0 && o.tilt_deg <= 10.0, "tilt_deg must be in [0, 10]");
  require(o.seed_inset_mm > 0.0 && o.end_mm >= 0.0, "the seeds must lie inside of the ends");
  require(o.section_step_mm > 0.0 && o.section_points >= 3, "sections need three points and a step above 0");
  require(o.measured_sigma_mm >= 0.0 && std::isfinite(o.measured_bias_mm),
          "the measured points' error must be finite");
}

CarotidPhantom carotid_phantom(const geometry::TriMesh& open, const core::TaskContext& task) {
  const pipeline::Repaired repaired = pipeline::repaired(open, task);
  CarotidPhantom phantom;
  phantom.lines = centerline::extract_centerlines(repaired.mesh, std::nullopt, {}).lines;
  phantom.lumen = geometry::fill_holes(repaired.mesh).mesh;
  if (phantom.lines.empty())
    throw GeometryError("carotid experiment: the surface has fewer than two open ends");
  return phantom;
}

CarotidImage scan_carotid(const CarotidPhantom& phantom, CarotidScan scan, const CarotidOptions& options,
                          const core::TaskContext& task) {
  validate(options);
  CarotidImage out;
  out.scan = scan;
  out.pose = pose_of(phantom, scan, options);
  const geometry::TriMesh lumen = moved(phantom.lumen, out.pose);
  out.image = scan_surface(lumen, scanner_of(scan, lumen, options), task);
  return out;
}

CarotidRun segment_carotid(const CarotidPhantom& phantom, const CarotidImage& scan,
                           segmentation::WallFeature feature, const std::vector<MeasuredPoint>& measured,
                           const CarotidOptions& options, const core::TaskContext& task) {
  validate(options);
  const std::vector<Seed> seeds = seeds_of(phantom, options.seed_inset_mm);
  std::vector<segmentation::BranchSeeds> branches;
  std::vector<Vec3> clicked;
  for (const Seed& seed : seeds) clicked.push_back(scan.pose(seed.point));
  for (std::size_t s = 1; s < clicked.size(); ++s)
    branches.push_back({clicked.front(), std::nullopt, clicked[s]});
  CarotidRun run;
  const auto segmented =
      segmented_at_highest(scan, branches, feature, options, run.threshold, task.sub(0.0, 0.7));
  run.scan = scan.scan;
  run.feature = feature;
  run.iterations = segmented.iterations;
  run.converged = segmented.converged;
  run.model = segmentation::surface_of(segmented.level_set, clicked);
  const Counted vertices = counted(run.model, scan.pose, seeds, options.end_mm);
  const geometry::AabbTree truth(phantom.lumen);
  run.alignment = evaluation::align_to(truth, vertices.points, {}, task.sub(0.8, 0.9));
  const Calibre calibre(phantom);
  std::vector<Vec3> places, normals;
  for (std::size_t i = 0; i < vertices.points.size(); ++i) {
    places.push_back(run.alignment.motion(vertices.points[i]));
    normals.push_back(run.alignment.motion.rotation * vertices.normals[i]);
    run.distance_mm.push_back(truth.signed_distance(places.back()));
    run.radius_mm.push_back(calibre.at(places.back()));
  }
  const std::vector<double> to_points = distances_to(measured, places, normals);
  run.surface = spread_of(run.distance_mm);
  run.points = spread_of(to_points);
  run.wide_surface = spread_of(where_wide(run.distance_mm, run.radius_mm, options.wide_mm));
  run.wide_points = spread_of(where_wide(to_points, run.radius_mm, options.wide_mm));
  return run;
}

CarotidResult run_carotid(const CarotidPhantom& phantom, const CarotidOptions& options,
                          const core::TaskContext& task) {
  validate(options);
  CarotidResult result;
  result.measured = measured_points(phantom.lumen, options);
  const geometry::AabbTree truth(phantom.lumen);
  std::vector<double> errors;
  for (const MeasuredPoint& m : result.measured) errors.push_back(truth.signed_distance(m.point));
  result.measured_error = spread_of(errors);
  const double share = 1.0 / static_cast<double>(options.scans.size());
  for (std::size_t s = 0; s < options.scans.size(); ++s) {
    const core::TaskContext part =
        task.sub(share * static_cast<double>(s), share * static_cast<double>(s + 1));
    part.set_stage(std::string("scanning: ") + name_of(options.scans[s]));
    result.images.push_back(scan_carotid(phantom, options.scans[s], options, part.sub(0.0, 0.4)));
    part.set_stage(std::string("segmenting: ") + name_of(options.scans[s]));
    for (const segmentation::WallFeature feature : options.features)
      result.runs.push_back(
          segment_carotid(phantom, result.images.back(), feature, result.measured, options));
  }
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::experiments
