#include "options/model_options.h"

#include "flow/solver_case.h"
#include "input/seeds.h"

namespace ostia::app {

pipeline::SourceOptions source_options(const InputOptions& input) {
  pipeline::SourceOptions options;
  options.dicom.series_uid = input.series;
  options.dicom.resample_uneven = input.resample;
  options.dicom.pixel_spacing_mm = input.pixel_spacing_mm;
  options.dicom.slice_spacing_mm = input.slice_spacing_mm;
  if (input.units == "m") options.unit_mm = 1000.0;
  if (input.units == "cm") options.unit_mm = 10.0;
  if (input.units == "mm") options.unit_mm = 1.0;
  options.strict = input.strict;
  return options;
}

namespace {

constexpr double kBalloonInflation = 0.5;  // of the balloon, where no weight is given

void apply_filters(const LumenOptions& from, segmentation::SegmentOptions& to) {
  if (from.balloon) {
    to.balloon.emplace();
    to.balloon->tau = from.balloon_tau;
    to.balloon->mean_hu = from.balloon_mean_hu;
    to.balloon->sigma_hu = from.balloon_sigma_hu;
    if (from.inflation < 0.0) to.level_set.inflation = kBalloonInflation;
  } else if (from.balloon_mean_hu || from.balloon_sigma_hu) {
    throw UsageError("--balloon-mean and --balloon-sigma need --balloon");
  }
  if (!from.denoise.empty()) {
    to.denoise.emplace();
    if (from.denoise == "gradient") to.denoise->method = imaging::Diffusion::gradient;
    if (from.denoise == "curvature") to.denoise->method = imaging::Diffusion::curvature;
    if (from.denoise_iterations >= 0) to.denoise->iterations = from.denoise_iterations;
    to.denoise->contrast_hu_per_mm = from.denoise_contrast;
  } else if (from.denoise_iterations >= 0 || from.denoise_contrast > 0.0) {
    throw UsageError("--denoise-iterations and --denoise-contrast need --denoise");
  }
  for (const std::string& tissue : from.remove) {
    to.remove.bone |= tissue == "bone";
    to.remove.calcium |= tissue == "calcium";
    to.remove.skin |= tissue == "skin";
  }
}

}  // namespace

void apply(const LumenOptions& from, const SeedFrame& frame, pipeline::ModelOptions& to) {
  for (const std::string& branch : from.branches) {
    const std::vector<segmentation::BranchSeeds> pieces = seed_branches(branch, frame);
    to.branches.insert(to.branches.end(), pieces.begin(), pieces.end());
  }
  to.segment.leave_out_unfollowed = true;  // one closed vessel does not lose the others
  to.segment.fronts.lower_hu = from.lower_hu;
  to.segment.fronts.upper_hu = from.upper_hu;
  to.segment.bright_is_lumen = from.bright_is_lumen;
  if (from.whole_volume) to.segment.fronts.domain = segmentation::FrontDomain::whole_volume;
  if (from.feature == "upwind") to.segment.feature = segmentation::WallFeature::upwind;
  if (from.feature == "centred") to.segment.feature = segmentation::WallFeature::centred;
  if (from.feature == "gaussian") to.segment.feature = segmentation::WallFeature::gaussian;
  to.segment.gaussian_sigma_mm = from.gaussian_sigma_mm;
  if (from.curvature_term == "minimal")
    to.segment.level_set.curvature_term = segmentation::CurvatureTerm::minimal;
  if (from.curvature >= 0.0) to.segment.level_set.curvature = from.curvature;
  if (from.inflation >= 0.0) to.segment.level_set.inflation = from.inflation;
  if (from.advection >= 0.0) to.segment.level_set.advection = from.advection;
  if (from.iterations >= 0) to.segment.level_set.iterations_max = from.iterations;
  apply_filters(from, to.segment);
  if (from.smooth > 0) {
    to.smoothing.emplace();
    to.smoothing->iterations = from.smooth;
  }
}

void apply(const EndOptions& from, const SeedFrame& frame, pipeline::ModelOptions& to) {
  if (!from.source.empty()) to.source = seed_point("--source", from.source, frame);
  for (const std::string& target : from.targets) {
    const std::vector<geometry::Vec3> places = seed_points(target, frame);
    to.targets.insert(to.targets.end(), places.begin(), places.end());
  }
  if (from.step_mm > 0.0) to.centerline.step_mm = from.step_mm;
}

namespace {

constexpr double round_end_diameters = 0.25;

/// Layers, order and formats.
void apply_volume(const MeshOptions& from, pipeline::VolumeOptions& to) {
  if (from.layers > 0) {
    to.layers.emplace();
    to.layers->layers = from.layers;
    if (from.layer_thickness) to.layers->thickness = *from.layer_thickness;
    if (from.layer_growth) to.layers->growth = *from.layer_growth;
  } else if (from.layer_thickness || from.layer_growth || from.split_prisms) {
    throw UsageError("--layer-thickness, --layer-growth and --split-prisms need --layers");
  }
  to.split_prisms = from.split_prisms;
  to.order = from.order;
  for (const std::string& format : from.formats) to.formats.push_back(io::mesh_format(format));
  if (from.with_case.empty()) return;
  CaseOptions asked = from.solver_case;
  asked.solver = from.with_case;
  to.solver_case = solver_case(asked);
}

}  // namespace

void apply(const MeshOptions& from, pipeline::ModelOptions& to) {
  if (from.edge_ratio > 0.0) to.sizing.edge_ratio = from.edge_ratio;
  to.sizing.measure = from.size == "radius" ? meshing::SizeMeasure::radius : meshing::SizeMeasure::distance;
  if (from.min_edge_mm > 0.0) to.sizing.min_edge_mm = from.min_edge_mm;
  if (from.max_edge_mm > 0.0) to.sizing.max_edge_mm = from.max_edge_mm;
  if (from.most_distance_radii) to.sizing.most_distance_radii = *from.most_distance_radii;
  if (from.curvature_ratio) to.sizing.curvature_ratio = *from.curvature_ratio;
  if (from.stenosis_share) to.sizing.throat_share = *from.stenosis_share;
  if (from.size_factor > 0.0) to.volume.tetrahedralize.size_factor = from.size_factor;
  if (from.inset_radii >= 0.0) to.inset_radii = from.inset_radii;
  to.clip.ends_as_they_are = from.ends == "as-they-are";
  if (from.side_branches == "stubs") to.side_branches = pipeline::SideBranches::stubs;
  if (from.side_branches == "axes") to.side_branches = pipeline::SideBranches::axes;
  if (from.extensions) {
    to.extensions.emplace();
    to.extensions->inlet_diameters = to.extensions->outlet_diameters = *from.extensions;
  } else if (from.ends == "round") {
    to.extensions.emplace();  // no longer than it takes to become a circle
    to.extensions->inlet_diameters = to.extensions->outlet_diameters = to.extensions->min_diameters =
        round_end_diameters;
    to.extensions->transition_share = 1.0;
  }
  apply_volume(from, to.volume);
  pipeline::validate(to);  // what does not go together is told before anything is read
}

}  // namespace ostia::app
