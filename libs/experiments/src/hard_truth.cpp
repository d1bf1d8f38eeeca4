#include "hard_truth.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

const phantom::ChallengeVessel* annotated(const phantom::CasePlan& plan, const std::string& name) {
  for (const phantom::ChallengeVessel& vessel : plan.challenge.vessels)
    if (vessel.name == name) return &vessel;
  return nullptr;
}

io::RotterdamReference own_reference(const phantom::CasePlan& plan, const phantom::CoronaryVessel& vessel) {
  constexpr double observers_mm = 0.2;  // no observer traced it; the spread of those that did
  const geometry::Centerline path = phantom::path_from_ostium(plan.tree, vessel.id);
  return {path.points, path.radius, std::vector<double>(path.size(), observers_mm)};
}

}  // namespace

ExtractionTruth truth_of_plan(const phantom::CasePlan& plan, double least_mm) {
  ExtractionTruth truth;
  truth.case_name = "seed " + std::to_string(plan.options.seed);
  truth.tree = phantom::vessel_tree(plan.tree);
  phantom::ObserverOptions nobody;
  nobody.count = 0;
  truth.contours = phantom::annotate(plan.tree, plan.sections.sections, plan.options.contours, nobody);
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels) {
    for (const phantom::Stenosis& one : vessel.stenoses)
      truth.lesions.push_back({vessel.name, one.s_from_mm, one.s_to_mm, one.s_throat_mm,
                               1.0 - std::sqrt(1.0 - one.area_stenosis)});
    const phantom::ChallengeVessel* drawn = annotated(plan, vessel.name);
    if (!drawn && 2.0 * vessel.lumen.mean_at(vessel.s_free_mm) < least_mm) continue;
    truth.vessels.push_back(
        {vessel.name, drawn != nullptr, drawn ? drawn->reference : own_reference(plan, vessel)});
  }
  return truth;
}

}  // namespace ostia::experiments
