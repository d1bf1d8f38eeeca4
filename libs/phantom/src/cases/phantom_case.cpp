#include "ostia/phantom/phantom_case.h"

#include "coronaries/coronary_obstacles.h"

#include "ostia/core/error.h"
#include "ostia/phantom/body.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace ostia::phantom {
namespace {

constexpr double tiny_share = 0.18;  // of the sections' lengths, for an image that holds little of the tree

void require_case(bool good, const char* what) {
  if (!good) throw InvalidInput(std::string("phantom case: ") + what);
}

/// The heart moves; the chest about it does not.
void let_the_heart_move(const HeartShape& heart, ScanOptions& scan) {
  scan.moving_centre = heart.base + 0.35 * heart.length_mm * heart.long_axis;
  scan.moving_radius_mm = 0.85 * heart.length_mm;
}

SectionOptions section_options(const CaseOptions& options, const imaging::Geometry& grid) {
  SectionOptions out;
  out.quota = section_quota(options.seed);
  if (!(options.disease > 0.0)) {
    out.quota.diseased = 0;
    out.quota.diseased_mm = 0.0;
  }
  if (options.preset == Preset::tiny) {  // the first centimetres alone
    out.quota.healthy_mm *= tiny_share;
    out.quota.diseased_mm *= tiny_share;
    out.least_length_mm *= 0.5;
  }
  out.image = grid;
  out.seed = options.seed;
  return out;
}

/// Severity and make of a lesion that a section needs.
LesionOptions lesion_at(const LesionSite& site, std::uint64_t seed, std::uint64_t index) {
  const auto draw = [&](std::uint64_t what) { return uniform(seed, 7300 + 16 * index + what); };
  LesionOptions lesion;
  lesion.s_throat_mm = site.s_centre_mm;
  lesion.length_mm = std::clamp(site.length_mm, 2.0, 40.0);
  lesion.diameter_stenosis = 0.25 + 0.45 * draw(0);
  // The side of the plaque narrows most, by (1 + eccentricity) of the mean, and must stay open.
  lesion.eccentricity = draw(1) * std::min(0.8, 0.95 / lesion.diameter_stenosis - 1.0);
  lesion.theta = 2.0 * std::numbers::pi * draw(2);
  lesion.remodelling = 1.05 + 0.2 * draw(3);
  constexpr std::array kinds{PlaqueKind::mixed, PlaqueKind::calcified, PlaqueKind::soft, PlaqueKind::fibrous};
  lesion.kind = kinds[static_cast<std::size_t>(draw(4) * kinds.size()) % kinds.size()];
  lesion.seed = seed + 7919 * (index + 1);
  return lesion;
}

void add_missing_lesions(CoronaryTree& tree, const SectionOptions& wanted, std::uint64_t seed) {
  std::uint64_t index = 0;
  for (const LesionSite& site : missing_lesions(tree, wanted)) {
    for (CoronaryVessel& vessel : tree.vessels)
      if (vessel.id == site.vessel) add_lesion(vessel, lesion_at(site, seed, index));
    ++index;
  }
}

/// Just beyond the left main.
void stent_the_lad(CoronaryTree& tree, double length_mm, bool struts) {
  for (CoronaryVessel& vessel : tree.vessels) {
    if (vessel.name != "LAD") continue;
    double begin = 10.0;
    for (const SegmentSpan& span : vessel.segments)
      if (span.aha == 6) begin = span.s_from_mm;
    add_stent(vessel, begin + 3.0, length_mm, struts);
  }
}

}  // namespace

void validate(const CaseOptions& options) {
  require_case(options.disease >= 0.0 && options.disease <= 5.0, "the share of disease must be 0 to 5");
  require_case(options.surface_spacing_mm >= 0.05 && options.surface_spacing_mm <= 1.0,
               "the surfaces' spacing must be 0.05 to 1 mm");
  const CaseVariant& variant = options.variant;
  require_case(variant.calcium >= 0.0 && variant.calcium <= 20.0, "calcium must be 0 to 20");
  require_case(variant.stent_mm >= 0.0 && variant.stent_mm <= 40.0, "a stent must be 0 to 40 mm long");
  require_case(!variant.contrast_hu || (*variant.contrast_hu >= 80.0 && *variant.contrast_hu <= 1000.0),
               "the contrast must be 80 to 1000 HU");
  require_case(variant.venous >= 0.0 && variant.venous <= 1.0, "the share of venous contrast must be 0 to 1");
  validate(options.obstacles);
  validate(options.scan.realism);
  validate(options.contours);
  validate(options.observers);
}

CasePlan plan_case(const CaseOptions& options) {
  validate(options);
  CasePlan plan;
  plan.options = options;
  plan.options.scan.seed = options.seed;
  plan.options.observers.seed = options.seed;
  plan.heart = draw_heart(options.seed);
  CoronaryOptions coronary;
  coronary.seed = options.seed;
  coronary.disease = options.disease;
  coronary.anatomy = options.variant.anatomy;
  coronary.calibre = options.obstacles.calibre;
  if (options.patient) {
    PatientHeart patient = patient_heart(*options.patient, plan.heart, coronary);
    plan.tree = std::move(patient.tree);
    plan.warp = std::move(patient.warp);
    plan.patient = std::move(patient.record);
  } else {
    plan.tree = draw_coronaries(plan.heart, coronary);
  }
  plan.options.scan.grid = grid_of(options.preset, plan.heart, &plan.tree);
  let_the_heart_move(plan.heart, plan.options.scan);
  validate(plan.options.scan);
  const SectionOptions wanted = section_options(options, plan.options.scan.grid);
  add_missing_lesions(plan.tree, wanted, options.seed);
  set_calcium(plan.tree, options.variant.calcium, options.seed);
  if (options.variant.stent_mm > 0.0)
    stent_the_lad(plan.tree, options.variant.stent_mm, options.scan.realism.stent_struts);
  plan.sections = plan_sections(plan.tree, wanted);
  add_obstacles(plan.tree, options.obstacles, plan.sections.sections, options.seed);
  plan.challenge = challenge_vessels(plan.tree, plan.options.observers, plan.options.scan.grid);
  if (plan.patient) plan.warnings = plan.patient->remarks;
  plan.warnings.insert(plan.warnings.end(), plan.sections.warnings.begin(), plan.sections.warnings.end());
  plan.warnings.insert(plan.warnings.end(), plan.challenge.warnings.begin(), plan.challenge.warnings.end());
  return plan;
}

BodyOptions body_of(const CaseOptions& options) {
  BodyOptions body = draw_body(options.seed);
  TissueHu& hu = body.hu;
  if (options.variant.contrast_hu) hu.arterial = static_cast<float>(*options.variant.contrast_hu);
  const ScanRealism& realism = options.scan.realism;
  if (realism.cava_hu > 0.0) hu.superior_vena_cava = static_cast<float>(realism.cava_hu);
  body.mixing = realism.mixing;
  const Obstacles& obstacles = options.obstacles;
  if (obstacles.contrast_fall >= 0.0) hu.coronary_drop = static_cast<float>(obstacles.contrast_fall);
  body.vein_closeness = obstacles.vein_closeness;
  body.lobes = obstacles.lobes;
  body.groove_fat = obstacles.groove_fat;
  const auto share = static_cast<float>(options.variant.venous);
  for (float* tissue : {&hu.right_heart, &hu.pulmonary, &hu.vein}) *tissue += share * (hu.arterial - *tissue);
  return body;
}

std::vector<CarriedThing> things_of(const CasePlan& plan, const Body& body) {
  return carried_things({plan.heart, plan.tree, plan.warp.get(), body}, plan.options.scan.realism,
                        plan.options.seed);
}

Scan scan_case(const CasePlan& plan, const core::TaskContext& task) {
  const Body body(plan.heart, plan.tree, body_of(plan.options), plan.warp);
  const CarriedScene scene(body, things_of(plan, body));
  return acquire(scene, plan.options.scan, task);
}

}  // namespace ostia::phantom
