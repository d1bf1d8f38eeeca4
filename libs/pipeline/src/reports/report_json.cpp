#include "meshes/export_parts.h"
#include "reports/quality_json.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/version.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using nlohmann::json;

json vessel_json(const geometry::Vessel& vessel, const geometry::Centerline& axis) {
  const auto least = std::min_element(axis.radius.begin(), axis.radius.end()) - axis.radius.begin();
  double sum = 0.0;
  for (const double r : axis.radius) sum += r;
  return {{"name", vessel.name},
          {"length_mm", axis.abscissa.back()},
          {"mean_diameter_mm", 2.0 * sum / static_cast<double>(axis.size())},
          {"least_diameter_mm", 2.0 * axis.radius[static_cast<std::size_t>(least)]},
          {"least_diameter_at_mm", axis.abscissa[static_cast<std::size_t>(least)]},
          {"start", point_json(axis.points.front())},
          {"end", point_json(axis.points.back())}};
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

std::string name_of(SideBranches side) {
  return side == SideBranches::axes ? "axes" : side == SideBranches::stubs ? "stubs" : "closed";
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

void add_volume_parameters(const VolumeOptions& options, json& out) {
  out["tetrahedra"] = {{"size_factor", options.tetrahedralize.size_factor},
                       {"max_radius_edge_ratio", options.tetrahedralize.max_radius_edge_ratio},
                       {"min_dihedral_deg", options.tetrahedralize.min_dihedral_deg}};
  out["layers"] = json();
  if (options.layers)
    out["layers"] = {{"count", options.layers->layers},
                     {"thickness", options.layers->thickness},
                     {"growth", options.layers->growth},
                     {"split", options.split_prisms}};
  out["order"] = options.order;
  out["export"] = json::array();
  for (const io::MeshFormat format : io::mesh_formats)
    if (std::ranges::find(options.formats, format) != options.formats.end())
      out["export"].push_back(io::name_of(format));
  if (options.solver_case) out["solver_case"] = json::parse(parameters_json(*options.solver_case));
}

}  // namespace

std::string report_json(const Model& model, const ModelOptions& options,
                        const std::optional<TruthErrors>& truth) {
  json report{{"v", 1},
              {"program", {{"name", "ostia"}, {"version", core::version()}}},
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
  report.update(figures_json(model.meshed.quality));
  report["verdict"] = verdict_json(model.meshed.quality.verdict);
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
      {"unit_mm", reading.unit_mm ? json(*reading.unit_mm) : json()},
      {"strict", reading.strict}};
  out["branches"] = json::array();
  for (const auto& branch : options.branches) {
    json points = json::array({point_json(branch.from)});
    if (branch.through) points.push_back(point_json(*branch.through));
    points.push_back(point_json(branch.to));
    out["branches"].push_back(points);
  }
  out["source"] = options.source ? point_json(*options.source) : json();
  out["targets"] = json::array();
  for (const auto& target : options.targets) out["targets"].push_back(point_json(target));
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
  out["clip"] = {{"inset_radii", options.inset_radii ? json(*options.inset_radii) : json()},
                 {"ends_as_they_are", options.clip.ends_as_they_are}};
  out["side_branches"] = name_of(options.side_branches);
  for (const meshing::PlacedPlane& plane : options.clip.planes)
    out["clip"]["planes"].push_back(
        {{"end", plane.end}, {"origin", point_json(plane.origin)}, {"normal", point_json(plane.normal)}});
  out["extensions"] = json();
  if (options.extensions)
    out["extensions"] = {{"inlet_diameters", options.extensions->inlet_diameters},
                         {"outlet_diameters", options.extensions->outlet_diameters},
                         {"transition_share", options.extensions->transition_share}};
  out["sizing"] = sizing_json(options.sizing);
  add_volume_parameters(options.volume, out);
  return out.dump();
}

}  // namespace ostia::pipeline
