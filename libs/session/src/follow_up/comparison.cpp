#include "ostia/session/comparison.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

/// What makes the numbers of two scans differ although the patient has not.
void warn_of_scans(Comparison& made) {
  const ComparedCase &before = made.before, &after = made.after;
  for (const auto& [one, which] : {std::pair(&before, "former"), std::pair(&after, "later")}) {
    for (const std::string& warning : one->warnings)
      made.warnings.push_back("the " + std::string(which) + " scan: " + warning);
    if (!one->has_image)
      made.warnings.push_back("plaque is not compared: the image of the " + std::string(which) +
                              " case was not at hand");
  }
  if (before.tube_kv && after.tube_kv && *before.tube_kv != *after.tube_kv)
    made.warnings.push_back("the scans were taken at " + core::fixed_text(*before.tube_kv, 0) + " and " +
                            core::fixed_text(*after.tube_kv, 0) +
                            " kV: classes of plaque and the fat's CT number change with that alone");
  if (made.repeatability.spreads == analysis::Repeatability().spreads)
    made.warnings.push_back(
        "no repeatability was given: differences are told, and none of them is called a change");
}

}  // namespace

ComparedCase compared_case(const lumen::LumenModel& model, const CaseReport& report, const CaseFat* fat) {
  ComparedCase out;
  out.tree.tree = model.tree;
  out.tree.segments = analysis::segments_of(model);
  out.model_digest = report.model_digest;
  out.image = report.options.image;
  out.has_image = report.has_image;
  if (fat) out.tube_kv = fat->tube_kv;
  for (const ReportVessel& vessel : report.vessels) {
    analysis::ScannedVessel one{vessel.id, vessel.name, vessel.own_from_mm, report.profiles.at(vessel.id),
                                report.references.at(vessel.id)};
    if (const auto walls = report.walls.find(vessel.id); walls != report.walls.end())
      one.plaque = walls->second.plaque;
    if (fat)
      for (const VesselFat& around : fat->vessels)
        if (around.vessel == vessel.id && around.profile.fat.voxels > 0)
          one.fat_hu = around.profile.fat.mean_hu;
    out.tree.vessels.push_back(std::move(one));
  }
  for (const ReportStenosis& lesion : report.stenoses)
    if (lesion.state != LesionState::rejected)
      out.tree.lesions.push_back({"S" + std::to_string(lesion.number), lesion.stenosis, lesion.narrows});
  for (const ReportVessel& vessel : report.vessels)
    if (vessel.unmeasured_mm > 0.0)
      out.warnings.push_back(vessel.name + ": " + core::fixed_text(vessel.unmeasured_mm, 1) +
                             " mm could not be measured, the wall does not close there");
  return out;
}

Comparison compare_cases(ComparedCase before, ComparedCase after, const ComparisonOptions& options,
                         const std::optional<ScanMap>& map) {
  Comparison made;
  made.before = std::move(before);
  made.after = std::move(after);
  made.repeatability = options.change.repeatability;
  const analysis::ScannedTree &was = made.before.tree, &is = made.after.tree;
  made.fit = analysis::fit_trees(was.tree, is.tree);
  analysis::PointMap carry = made.fit.motion;
  made.map_words = "rigid, by the trees";
  if (map) {
    carry = map->map;
    made.map_words = map->words;
  }
  made.change = analysis::compare_scans(was, is, carry, options.change);
  // Whether they are one patient's is asked of the trees, whatever map they are compared by.
  made.another_patient = analysis::why_another_patient(
      made.fit,
      map ? analysis::match_trees(was.tree, is.tree, made.fit.motion, options.change.match)
          : made.change.match,
      options.bounds);
  if (!made.another_patient.empty() && !options.anyway)
    throw InvalidInput("the two cases are hardly of one patient: " + made.another_patient +
                       "; compare them with --anyway if they are");
  if (!made.another_patient.empty()) made.warnings.push_back("hardly one patient: " + made.another_patient);
  warn_of_scans(made);
  return made;
}

}  // namespace ostia::session
