#include "points.h"

#include "solver_case.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ostia::app {
namespace {

using geometry::Vec3;

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = std::min(text.find(separator), text.size());
    parts.push_back(text.substr(0, at));
    if (at == text.size()) return parts;
    text.remove_prefix(at + 1);
  }
}

double number(std::string_view text, std::string_view whole) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw InvalidInput("\"" + std::string(whole) +
                       "\" is no point: write x,y,z, three numbers in millimetres with a decimal point");
  }
  return value;
}

}  // namespace

Vec3 parse_point(std::string_view text, const std::string& coords, const imaging::Geometry* grid) {
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 3)
    throw InvalidInput("\"" + std::string(text) +
                       "\" is no point: write x,y,z, three numbers in millimetres");
  const Vec3 given(number(parts[0], text), number(parts[1], text), number(parts[2], text));
  if (coords == "ras") return {-given.x(), -given.y(), given.z()};
  if (coords != "ijk") return given;
  if (!grid) throw InvalidInput("--coords ijk needs an image as input; a surface has no voxels");
  return grid->world(given);
}

segmentation::BranchSeeds parse_branch(std::string_view text, const std::string& coords,
                                       const imaging::Geometry* grid) {
  const std::vector<std::string_view> points = split(text, ':');
  if (points.size() != 2 && points.size() != 3) {
    throw InvalidInput("\"" + std::string(text) +
                       "\" is no branch: write P:P or P:P:P (from, through, to), each P as x,y,z");
  }
  segmentation::BranchSeeds seeds;
  seeds.from = parse_point(points.front(), coords, grid);
  seeds.to = parse_point(points.back(), coords, grid);
  if (points.size() == 3) seeds.through = parse_point(points[1], coords, grid);
  return seeds;
}

pipeline::SourceOptions source_options(const InputOptions& input) {
  pipeline::SourceOptions options;
  options.dicom.series_uid = input.series;
  options.dicom.resample_uneven = input.resample;
  options.dicom.pixel_spacing_mm = input.pixel_spacing_mm;
  options.dicom.slice_spacing_mm = input.slice_spacing_mm;
  if (input.units == "m") options.unit_mm = 1000.0;
  if (input.units == "cm") options.unit_mm = 10.0;
  if (input.units == "mm") options.unit_mm = 1.0;
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

void apply(const LumenOptions& from, const std::string& coords, const imaging::Geometry* grid,
           pipeline::ModelOptions& to) {
  for (const std::string& branch : from.branches) to.branches.push_back(parse_branch(branch, coords, grid));
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

void apply(const EndOptions& from, const std::string& coords, const imaging::Geometry* grid,
           pipeline::ModelOptions& to) {
  if (!from.source.empty()) to.source = parse_point(from.source, coords, grid);
  for (const std::string& target : from.targets) to.targets.push_back(parse_point(target, coords, grid));
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
