#include "orientation/orientation_lines.h"

#include "motion/level_set_image.h"

#include "ostia/imaging/diffusion.h"
#include "ostia/segmentation/feature.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

/// Negative where the image is brighter than `threshold_hu`.
imaging::FloatVolume start_above(const imaging::ImageVolume& image, double threshold_hu) {
  imaging::FloatVolume start{image.geometry, std::vector<float>(image.voxels.size())};
  std::transform(image.voxels.begin(), image.voxels.end(), start.voxels.begin(), [&](std::int16_t hu) {
    return static_cast<float>((threshold_hu - hu) / std::max(1.0, std::abs(threshold_hu)));
  });
  return start;
}

imaging::Region whole(const imaging::Geometry& grid) {
  return {{0, 0, 0}, grid.size};
}

segmentation::LevelSetResult segmented(const imaging::ImageVolume& image, const OrientationsOptions& options,
                                       const core::TaskContext& task) {
  const TubeScanOptions& scan = options.scan;
  // The paper gives one pair of numbers for start and balloon: what is within one deviation of the mean.
  const imaging::FloatVolume start = start_above(image, scan.lumen_hu - options.vessel_sigma_hu);
  const imaging::FloatVolume speed = segmentation::balloon_speed(image, whole(image.geometry), scan.lumen_hu,
                                                                 options.vessel_sigma_hu, options.tau);
  segmentation::EdgeFeature edge;
  edge.noise_hu_per_mm = 0.1 * (scan.lumen_hu - scan.gel_hu) / scan.psf_fwhm_z_mm;
  segmentation::LevelSetOptions how;
  how.inflation = options.inflation;
  how.curvature = options.curvature;
  how.curvature_term = segmentation::CurvatureTerm::minimal;
  how.iterations_max = options.iterations;
  return segmentation::level_set(start, image, edge, speed, how, task);
}

}  // namespace

ScannedLines scanned_lines(const std::vector<PhantomTube>& tubes, const Orientation& orientation,
                           const OrientationsOptions& options, const core::TaskContext& task) {
  task.set_stage("scanning");
  ScannedLines out;
  imaging::ImageVolume image = scan_of(tubes, orientation, options.scan, task.sub(0.0, 0.17));
  out.scanned = image;
  if (options.diffusion_iterations > 0) {
    imaging::DiffusionOptions how;
    how.iterations = options.diffusion_iterations;
    image = imaging::diffused(image, how, task.sub(0.17, 0.28));
  }
  task.set_stage("level set");
  out.surface = segmented(image, options, task.sub(0.28, 0.78));
  const imaging::MaskVolume mask = mask_inside(out.surface.level_set);
  pipeline::SkeletonOptions how;
  how.prune.length_mm = options.prune_mm;
  how.gaps.distance_mm = options.gap_mm;
  how.sections.sigma_mm = options.sigma_mm;
  how.smooth->knot_spacing_mm = options.knots_mm;
  if (!options.settle) how.settle.reset();
  task.set_stage("skeleton");
  out.sections = how.sections;
  out.lines = pipeline::skeleton_of(mask, nullptr, how, task.sub(0.78, 1.0));
  return out;
}

}  // namespace ostia::experiments
