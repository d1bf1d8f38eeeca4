#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using nlohmann::json;

json point(const geometry::Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

json surface_json(const meshing::SurfaceQuality& q) {
  return {{"points", q.points},
          {"triangles", q.triangles},
          {"min_angle_deg", q.min_angle_deg},
          {"mean_min_angle_deg", q.mean_min_angle_deg},
          {"max_frobenius_aspect", q.max_frobenius_aspect},
          {"mean_frobenius_aspect", q.mean_frobenius_aspect},
          {"valence", q.valence},
          {"mean_edge_mm", q.mean_edge_mm},
          {"open_edges", q.open_edges},
          {"non_manifold_edges", q.non_manifold_edges},
          {"self_intersections", q.self_intersections},
          {"area_mm2", q.area_mm2},
          {"volume_mm3", q.volume_mm3}};
}

json volume_json(const meshing::VolumeQuality& q) {
  return {{"points", q.points},
          {"tetrahedra", q.tetrahedra},
          {"prisms", 0},
          {"min_dihedral_deg", q.min_dihedral_deg},
          {"max_dihedral_deg", q.max_dihedral_deg},
          {"mean_min_dihedral_deg", q.mean_min_dihedral_deg},
          {"min_scaled_jacobian", q.min_scaled_jacobian},
          {"mean_scaled_jacobian", q.mean_scaled_jacobian},
          {"inverted", q.inverted},
          {"boundary_mismatches", q.boundary_mismatches},
          {"mean_edge_mm", q.mean_edge_mm},
          {"volume_mm3", q.volume_mm3}};
}

json verdict_json(const meshing::QualityVerdict& verdict) {
  return {{"passed", verdict.ok()}, {"reasons", verdict.reasons}};
}

json vessel_json(const geometry::Vessel& vessel, const geometry::Centerline& axis) {
  const auto least = std::min_element(axis.radius.begin(), axis.radius.end()) - axis.radius.begin();
  double sum = 0.0;
  for (const double r : axis.radius) sum += r;
  return {{"name", vessel.name},
          {"length_mm", axis.abscissa.back()},
          {"mean_diameter_mm", 2.0 * sum / static_cast<double>(axis.size())},
          {"least_diameter_mm", 2.0 * axis.radius[static_cast<std::size_t>(least)]},
          {"least_diameter_at_mm", axis.abscissa[static_cast<std::size_t>(least)]},
          {"start", point(axis.points.front())},
          {"end", point(axis.points.back())}};
}

json truth_json(const TruthErrors& errors) {
  return {{"lumen",
           {{"msd_mm", errors.lumen.msd_mm},
            {"rms_sd_mm", errors.lumen.rms_sd_mm},
            {"hd95_mm", errors.lumen.hd95_mm},
            {"max_sd_mm", errors.lumen.max_sd_mm},
            {"signed_mean_mm", errors.lumen.signed_mean_mm},
            {"signed_sd_mm", errors.lumen.signed_sd_mm}}},
          {"axis",
           {{"mean_mm", errors.axis.mean_mm},
            {"max_mm", errors.axis.max_mm},
            {"radius_median_relative", errors.axis.radius_median_relative},
            {"radius_max_relative", errors.axis.radius_max_relative}}},
          {"throat",
           {{"radius_mm", errors.throat_radius_mm},
            {"true_radius_mm", errors.true_throat_radius_mm},
            {"relative", errors.throat_relative}}}};
}

std::string name_of(segmentation::WallFeature feature) {
  switch (feature) {
    case segmentation::WallFeature::edges:
      return "edges";
    case segmentation::WallFeature::upwind:
      return "upwind";
    case segmentation::WallFeature::gaussian:
      return "gaussian";
    case segmentation::WallFeature::centred:
      break;
  }
  return "centred";
}

std::string name_of(imaging::Diffusion method) {
  switch (method) {
    case imaging::Diffusion::gradient:
      return "gradient";
    case imaging::Diffusion::curvature:
      return "curvature";
    case imaging::Diffusion::flux:
      break;
  }
  return "flux";
}

json filters_json(const segmentation::SegmentOptions& o) {
  const auto given = [](const std::optional<double>& value) { return value ? json(*value) : json(); };
  json out = {{"balloon", json()}, {"denoise", json()}, {"remove", json::array()}};
  if (o.balloon)
    out["balloon"] = {{"tau", o.balloon->tau},
                      {"mean_hu", given(o.balloon->mean_hu)},
                      {"sigma_hu", given(o.balloon->sigma_hu)}};
  if (o.denoise)
    out["denoise"] = {{"method", name_of(o.denoise->method)},
                      {"iterations", o.denoise->iterations},
                      {"contrast_hu_per_mm", o.denoise->contrast_hu_per_mm},
                      {"attachment", o.denoise->attachment},
                      {"step", o.denoise->step}};
  if (o.remove.bone) out["remove"].push_back("bone");
  if (o.remove.calcium) out["remove"].push_back("calcium");
  if (o.remove.skin) out["remove"].push_back("skin");
  return out;
}

json branch_json(const segmentation::BranchDiagnostics& d) {
  return {{"lower_hu", d.range.lower},
          {"upper_hu", d.range.upper},
          {"range_was_chosen", d.range_was_chosen},
          {"lumen_hu", d.lumen_hu},
          {"initial_voxels", d.initial_voxels},
          {"touches_border", d.touches_border}};
}

}  // namespace

std::string quality_json(const meshing::SurfaceQuality& surface, const meshing::QualityVerdict& verdict) {
  return json{{"v", 1}, {"surface", surface_json(surface)}, {"verdict", verdict_json(verdict)}}.dump();
}

std::string quality_json(const meshing::SurfaceQuality& surface, const meshing::VolumeQuality& volume,
                         const meshing::QualityVerdict& verdict) {
  return json{{"v", 1},
              {"surface", surface_json(surface)},
              {"volume", volume_json(volume)},
              {"verdict", verdict_json(verdict)}}
      .dump();
}

std::string report_json(const Model& model, const ModelOptions& options,
                        const std::optional<TruthErrors>& truth) {
  json report{{"v", 1},
              {"program", {{"name", "ostia"}, {"version", program_version()}}},
              {"axes", "LPS"},
              {"unit", "mm"}};
  report["source"] = {{"kind", pipeline::name_of(model.source.kind)},
                      {"sha256", model.source.sha256},
                      {"pseudonym", model.source.pseudonym}};
  report["parameters"] = json::parse(parameters_json(options));
  report["branches"] = json::array();
  for (const auto& branch : model.branches) report["branches"].push_back(branch_json(branch));
  report["vessels"] = json::array();
  for (const geometry::Vessel& vessel : model.meshed.centerlines.tree.vessels) {
    report["vessels"].push_back(
        vessel_json(vessel, geometry::vessel_axis(model.meshed.centerlines.tree, vessel)));
  }
  report["faces"] = json::array();
  for (const geometry::Face& face : model.meshed.surface.faces)
    report["faces"].push_back({{"id", face.id}, {"name", face.name}});
  report["surface"] = surface_json(model.meshed.surface_quality);
  report["volume"] = volume_json(model.meshed.volume_quality);
  report["verdict"] = verdict_json(model.meshed.verdict);
  report["truth"] = truth ? truth_json(*truth) : json();
  report["stages"] = json::array();
  for (const StageTime& stage : model.stages)
    report["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  report["peak_mb"] = peak_memory_mb();
  report["warnings"] = json::array();
  for (const std::string& warning : model.warnings) report["warnings"].push_back(core::redacted(warning));
  return report.dump(2) + "\n";
}

std::string parameters_json(const ModelOptions& options, const SourceOptions& reading) {
  json out;
  out["reading"] = {
      {"series", reading.dicom.series_uid.empty() ? json() : json(core::sha256(reading.dicom.series_uid))},
      {"resample", reading.dicom.resample_uneven},
      {"pixel_spacing_mm", reading.dicom.pixel_spacing_mm ? json(*reading.dicom.pixel_spacing_mm) : json()},
      {"slice_spacing_mm", reading.dicom.slice_spacing_mm ? json(*reading.dicom.slice_spacing_mm) : json()},
      {"unit_mm", reading.unit_mm ? json(*reading.unit_mm) : json()}};
  out["branches"] = json::array();
  for (const auto& branch : options.branches) {
    json points = json::array({point(branch.from)});
    if (branch.through) points.push_back(point(*branch.through));
    points.push_back(point(branch.to));
    out["branches"].push_back(points);
  }
  out["source"] = options.source ? point(*options.source) : json();
  out["targets"] = json::array();
  for (const auto& target : options.targets) out["targets"].push_back(point(target));
  const auto& segment = options.segment;
  out["segment"] = {
      {"lower_hu", segment.fronts.lower_hu ? json(*segment.fronts.lower_hu) : json()},
      {"upper_hu", segment.fronts.upper_hu ? json(*segment.fronts.upper_hu) : json()},
      {"whole_volume", segment.fronts.domain == segmentation::FrontDomain::whole_volume},
      {"feature", name_of(segment.feature)},
      {"gaussian_sigma_mm", segment.gaussian_sigma_mm},
      {"filters", filters_json(segment)},
      {"bright_is_lumen", segment.bright_is_lumen},
      {"inflation", segment.level_set.inflation},
      {"curvature", segment.level_set.curvature},
      {"curvature_term",
       segment.level_set.curvature_term == segmentation::CurvatureTerm::mean ? "mean" : "minimal"},
      {"advection", segment.level_set.advection},
      {"iterations_max", segment.level_set.iterations_max}};
  out["smoothing"] = options.smoothing ? json{{"iterations", options.smoothing->iterations},
                                              {"pass_band", options.smoothing->pass_band}}
                                       : json();
  out["centerline"] = {{"step_mm", options.centerline.step_mm},
                       {"smoothing_radii", options.centerline.smoothing_radii}};
  out["clip"] = {{"inset_radii", options.inset_radii ? json(*options.inset_radii) : json()}};
  out["sizing"] = {
      {"edge_ratio", options.sizing.edge_ratio},
      {"measure", options.sizing.measure == meshing::SizeMeasure::distance ? "distance" : "radius"},
      {"gradation", options.sizing.gradation},
      {"min_edge_mm", options.sizing.min_edge_mm},
      {"max_edge_mm", std::isfinite(options.sizing.max_edge_mm) ? json(options.sizing.max_edge_mm) : json()}};
  out["tetrahedra"] = {{"size_factor", options.tetrahedralize.size_factor},
                       {"max_radius_edge_ratio", options.tetrahedralize.max_radius_edge_ratio},
                       {"min_dihedral_deg", options.tetrahedralize.min_dihedral_deg}};
  return out.dump();
}

}  // namespace ostia::pipeline
