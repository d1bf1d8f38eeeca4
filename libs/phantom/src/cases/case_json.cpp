#include "cases/case_parts.h"
#include "coronaries/axis_place.h"
#include "heart/motion_json.h"

#include "ostia/phantom/body.h"
#include "ostia/phantom/case_folder.h"
#include "ostia/phantom/moving_case.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using nlohmann::json;

/// Six decimals: what a reader can use, the same on every machine.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

json point(const Vec3& p) {
  return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

const char* word(Dominance dominance) {
  switch (dominance) {
    case Dominance::right:
      return "right";
    case Dominance::left:
      return "left";
    case Dominance::balanced:
      return "balanced";
  }
  return "";
}

const char* word(geometry::Health health) {
  return health == geometry::Health::healthy ? "healthy" : "diseased";
}

/// What is as usual is left out.
json realism_parameters(const ScanRealism& r) {
  const ScanRealism usual;
  json out = json::object();
  for (const RealismMember& member : realism_members()) {
    const double value = value_of(r, member.name);
    if (value == value_of(usual, member.name)) continue;
    if (member.whole)
      out[member.name] = static_cast<int>(value);
    else
      out[member.name] = value;
  }
  return out;
}

json scan_parameters(const ScanOptions& o) {
  json out{{"supersampling", o.supersampling},
           {"psf_fwhm_mm", o.psf_fwhm_mm},
           {"psf_fwhm_z_mm", o.psf_fwhm_z_mm},
           {"noise_hu", o.noise_hu},
           {"noise_peak_per_mm", o.noise_peak_per_mm},
           {"noise_fwhm_z_mm", o.noise_fwhm_z_mm},
           {"stair_step_mm", o.stair_step_mm},
           {"stair_block_mm", o.stair_block_mm},
           {"motion_mm", o.motion_mm},
           {"beam_hardening", o.beam_hardening}};
  const json realism = realism_parameters(o.realism);
  if (!realism.empty()) out["realism"] = realism;
  return out;
}

/// What is as usual is left out.
json variant_parameters(const CaseVariant& v) {
  json out = json::object();
  if (v.anatomy != Anatomy::usual) out["anatomy"] = word(v.anatomy);
  if (v.calcium != 1.0) out["calcium"] = v.calcium;
  if (v.stent_mm > 0.0) out["stent_mm"] = v.stent_mm;
  if (v.contrast_hu) out["contrast_hu"] = *v.contrast_hu;
  if (v.venous > 0.0) out["venous"] = v.venous;
  return out;
}

/// What is as usual is left out.
json obstacle_parameters(const Obstacles& o) {
  const Obstacles usual;
  json out = json::object();
  const auto tell = [&](const char* name, double Obstacles::*member) {
    if (o.*member != usual.*member) out[name] = o.*member;
  };
  tell("calibre", &Obstacles::calibre);
  tell("contrast_fall", &Obstacles::contrast_fall);
  tell("vein_closeness", &Obstacles::vein_closeness);
  tell("lobes", &Obstacles::lobes);
  tell("groove_fat", &Obstacles::groove_fat);
  tell("calcified_mm", &Obstacles::calcified_mm);
  tell("closed", &Obstacles::closed);
  tell("filling", &Obstacles::filling);
  return out;
}

json parameters(const CaseOptions& o) {
  json out{{"seed", o.seed},
           {"preset", preset_name(o.preset)},
           {"disease", o.disease},
           {"scan", scan_parameters(o.scan)},
           {"contours",
            {{"spacing_mm", o.contours.spacing_mm},
             {"observer_spacing_mm", o.contours.observer_spacing_mm},
             {"points", o.contours.points}}},
           {"observers",
            {{"count", o.observers.count},
             {"healthy_mm", o.observers.healthy_mm},
             {"diseased_mm", o.observers.diseased_mm},
             {"axis_mm", o.observers.axis_mm},
             {"axis_length_mm", o.observers.axis_length_mm}}},
           {"surface_spacing_mm", o.surface_spacing_mm}};
  if (o.patient) out["patient"] = {{"sha256", o.patient->digest}, {"rim_mm", o.patient->rim_mm}};
  const json variant = variant_parameters(o.variant);
  if (!variant.empty()) out["variant"] = variant;
  const json obstacles = obstacle_parameters(o.obstacles);
  if (!obstacles.empty()) out["obstacles"] = obstacles;
  return out;
}

}  // namespace

const char* preset_name(Preset preset) {
  switch (preset) {
    case Preset::tiny:
      return "tiny";
    case Preset::small:
      return "small";
    case Preset::full:
      return "full";
  }
  return "";
}

namespace {

json grid_json(const imaging::Geometry& grid) {
  return {{"size", {grid.size[0], grid.size[1], grid.size[2]}},
          {"spacing_mm", point(grid.spacing)},
          {"origin_mm", point(grid.origin)}};
}

json tissue_json(const CaseOptions& options) {
  const TissueHu hu = body_of(options).hu;
  return {{"arterial", rounded(hu.arterial)},
          {"coronary_drop_per_100_mm", rounded(hu.coronary_drop)},
          {"right_heart", rounded(hu.right_heart)},
          {"myocardium", rounded(hu.myocardium)},
          {"epicardial_fat", rounded(hu.epicardial_fat)},
          {"lung", rounded(hu.lung)}};
}

json segments_json(const CoronaryVessel& vessel) {
  json out = json::array();
  for (const SegmentSpan& one : vessel.segments) {
    out.push_back({{"aha", one.aha},
                   {"name", one.name},
                   {"s_from_mm", rounded(one.s_from_mm)},
                   {"s_to_mm", rounded(one.s_to_mm)}});
  }
  return out;
}

/// The AHA segment in which an abscissa lies; null where the vessel has none there.
json segment_at(const CoronaryVessel& vessel, double s) {
  for (const SegmentSpan& one : vessel.segments)
    if (s >= one.s_from_mm && s <= one.s_to_mm) return one.aha;
  return nullptr;
}

json stenoses_json(const CoronaryVessel& vessel) {
  json out = json::array();
  for (const Stenosis& one : vessel.stenoses) {
    out.push_back({{"s_from_mm", rounded(one.s_from_mm)},
                   {"s_to_mm", rounded(one.s_to_mm)},
                   {"s_throat_mm", rounded(one.s_throat_mm)},
                   {"throat_mm", point(place_at(vessel.axis, one.s_throat_mm).point)},
                   {"segment", segment_at(vessel, one.s_throat_mm)},
                   {"diameter_stenosis", rounded(one.diameter_stenosis)},
                   {"area_stenosis", rounded(one.area_stenosis)},
                   {"eccentricity", rounded(one.eccentricity)},
                   {"plaque", word(one.kind)},
                   {"cad_rads", stenosis_category(one.diameter_stenosis)}});
  }
  return out;
}

json plaques_json(const CoronaryVessel& vessel) {
  json out = json::array();
  for (const Plaque& one : vessel.plaques) {
    out.push_back({{"kind", word(one.kind)},
                   {"s_centre_mm", rounded(one.s_centre_mm)},
                   {"length_mm", rounded(one.length_mm)},
                   {"theta_centre_deg", rounded(one.theta_centre * 180.0 / std::numbers::pi)},
                   {"theta_extent_deg", rounded(one.theta_extent * 180.0 / std::numbers::pi)},
                   {"hu", rounded(one.hu)}});
  }
  return out;
}

json vessels_json(const CoronaryTree& tree) {
  json out = json::array();
  for (const CoronaryVessel& vessel : tree.vessels) {
    const double length = vessel.axis.abscissa.back();
    out.push_back({{"id", vessel.id},
                   {"name", vessel.name},
                   {"parent", vessel.parent < 0 ? json(nullptr) : json(vessel.parent)},
                   {"parent_s_mm", rounded(vessel.parent_s_mm)},
                   {"s_free_mm", rounded(vessel.s_free_mm)},
                   {"length_mm", rounded(length)},
                   {"start_mm", point(vessel.axis.points.front())},
                   {"end_mm", point(vessel.axis.points.back())},
                   {"first_diameter_mm", rounded(2.0 * vessel.lumen.mean_at(vessel.s_free_mm))},
                   {"last_diameter_mm", rounded(2.0 * vessel.lumen.mean_at(length))},
                   {"segments", segments_json(vessel)},
                   {"stenoses", stenoses_json(vessel)},
                   {"plaques", plaques_json(vessel)}});
  }
  return out;
}

json ostia_json(const CoronaryTree& tree) {
  json out = json::array();
  for (const CoronaryVessel& vessel : tree.vessels) {
    if (vessel.parent >= 0) continue;
    out.push_back({{"vessel", vessel.name},
                   {"position_mm", point(vessel.axis.points.front())},
                   {"direction", point(vessel.axis.frames.front().tangent)},
                   {"diameter_mm", rounded(2.0 * vessel.lumen.mean_at(0.0))}});
  }
  return out;
}

json sections_json(const CasePlan& plan) {
  json out = json::array();
  for (const AnnotatedSection& one : plan.sections.sections) {
    out.push_back({{"section", one.key},
                   {"vessel", vessel_of(plan.tree, one.vessel).name},
                   {"s_from_mm", rounded(one.s_from_mm)},
                   {"s_to_mm", rounded(one.s_to_mm)},
                   {"length_mm", rounded(one.length_mm())},
                   {"health", word(one.health)}});
  }
  return out;
}

json challenge_json(const CasePlan& plan) {
  json out = json::array();
  for (const ChallengeVessel& one : plan.challenge.vessels) {
    json path = json::array();
    for (const std::int32_t id : one.path) path.push_back(vessel_of(plan.tree, id).name);
    out.push_back({{"folder", "vessel" + std::to_string(one.number)},
                   {"vessel", one.name},
                   {"path", path},
                   {"cut_by_image", one.cut_by_image}});
  }
  return out;
}

/// How the heart was laid under a patient's arteries.
json patient_json(const PatientRecord& record) {
  json parts = json::array();
  for (const PatientPart& one : record.parts)
    parts.push_back({{"vessel", one.vessel},
                     {"measured_mm", rounded(one.measured_mm)},
                     {"grown_mm", rounded(one.grown_mm)}});
  json rotation = json::array();
  for (int row = 0; row < 3; ++row) rotation.push_back(point(record.rotation.row(row).transpose()));
  return {{"sha256", record.digest},
          {"rim_mm", rounded(record.rim_mm)},
          {"rotation", rotation},
          {"shift_mm", point(record.shift_mm)},
          {"heart_size", point(record.size)},
          {"height_mm", rounded(record.height_mm)},
          {"groove_mm", rounded(record.groove_mm)},
          {"height_left_mm", rounded(record.height_left_mm)},
          {"groove_left_mm", rounded(record.groove_left_mm)},
          {"least_jacobian", rounded(record.least_jacobian)},
          {"largest_jacobian", rounded(record.largest_jacobian)},
          {"longest_mm", rounded(record.longest_mm)},
          {"smoothings", record.smoothings},
          {"parts", parts}};
}

json phases_json(const std::string& image, bool with_image, int phases) {
  json out = json::array();
  if (phases == 1) {
    out.push_back({{"percent", nullptr}, {"image", with_image ? json(image) : json(nullptr)}});
    return out;
  }
  for (const double percent : phase_percents(phases)) {
    const std::string folder = phase_name(percent);
    out.push_back({{"percent", rounded(percent)},
                   {"folder", folder},
                   {"image", with_image ? json(folder + "/" + image) : json(nullptr)}});
  }
  return out;
}

}  // namespace

std::string parameters_json(const CaseOptions& options) {
  return parameters(options).dump();
}

std::string parameters_json(const SuiteOptions& options) {
  json all = parameters(options.first);
  json formats = json::array();
  if (options.mhd) formats.push_back("mhd");
  if (options.nrrd) formats.push_back("nrrd");
  if (options.dicom) formats.push_back("dicom");
  all["cases"] = options.cases;
  all["truth_only"] = options.truth_only;
  all["formats"] = formats;
  all["report"] = options.report;
  all["phases"] = options.phases;
  if (options.hard) all["suite"] = "hard";
  return all.dump();
}

std::string case_json(const CasePlan& plan, int number, bool with_image, int phases) {
  const std::string name = "image" + two_digits(number);
  json out;
  out["v"] = 1;
  out["units"] = "mm";
  out["axes"] = "LPS";
  out["synthetic"] = true;
  out["parameters"] = parameters(plan.options);
  if (plan.patient) out["patient"] = patient_json(*plan.patient);
  out["dominance"] = word(plan.tree.dominance);
  out["tissue_hu"] = tissue_json(plan.options);
  out["grid"] = grid_json(plan.options.scan.grid);
  // One entry a phase of the heart's cycle.
  out["phases"] = phases_json(name, with_image, phases);
  out["ostia"] = ostia_json(plan.tree);
  out["vessels"] = vessels_json(plan.tree);
  out["data_set_vessels"] = challenge_json(plan);
  out["sections"] = sections_json(plan);
  out["warnings"] = plan.warnings;
  return out.dump(1) + "\n";
}

std::string suite_json(const SuiteOptions& options, const SuiteRecord& record) {
  json cases = json::array();
  for (const CaseRecord& one : record.cases) {
    json made{{"folder", one.folder},
              {"seed", one.seed},
              {"sections", one.healthy + one.diseased},
              {"healthy_mm", rounded(one.healthy_mm)},
              {"diseased_mm", rounded(one.diseased_mm)},
              {"warnings", one.warnings}};
    if (!one.motion.empty()) made["motion"] = vessel_motion_json(one.motion);
    cases.push_back(std::move(made));
  }
  const json out{{"v", 1},
                 {"units", "mm"},
                 {"parameters", json::parse(parameters_json(options))},
                 {"cases", cases},
                 {"sections", record.sections()},
                 {"healthy_mm", rounded(record.healthy_mm())},
                 {"diseased_mm", rounded(record.diseased_mm())}};
  return out.dump(1) + "\n";
}

}  // namespace ostia::phantom
