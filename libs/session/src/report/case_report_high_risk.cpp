// Features of high-risk plaque of a report's lesions.

#include "report/case_report_grading.h"

#include <algorithm>

namespace ostia::session {
namespace {

using analysis::FeatureConfidence;

// Share of a vessel's outer wall that borders on fat, below which its features are of low, of moderate
// confidence at most.
constexpr double seen_for_moderate = 0.5, seen_for_high = 0.8;

FeatureConfidence most_confidence(const ReportStenosis& one, const VesselWalls& walls) {
  const double seen = walls.outer.seen_share;
  FeatureConfidence most = seen < seen_for_moderate ? FeatureConfidence::low
                           : seen < seen_for_high   ? FeatureConfidence::moderate
                                                    : FeatureConfidence::high;
  if (!one.evaluable || one.evaluable->grade == analysis::Evaluability::not_evaluable)
    return FeatureConfidence::low;
  if (one.evaluable->grade == analysis::Evaluability::limited)
    most = std::min(most, FeatureConfidence::moderate);
  return most;
}

bool feature_counts(const ReportFeature& one) {
  if (one.state != LesionState::open) return one.state == LesionState::accepted;
  return one.finding.known && one.finding.present && one.finding.confidence > FeatureConfidence::low;
}

}  // namespace

void find_high_risk_plaque(CaseReport& report) {
  for (ReportStenosis& one : report.stenoses) {
    const auto walls = report.walls.find(one.stenosis.vessel);
    if (walls == report.walls.end() || !one.plaque) continue;
    const FeatureConfidence most = most_confidence(one, walls->second);
    for (analysis::PlaqueFeatureFinding& finding : analysis::plaque_features_of(
             walls->second.plaque, walls->second.maps, one.stenosis, report.options.high_risk)) {
      finding.confidence = std::min(finding.confidence, most);
      ReportFeature feature{finding, word_on(report.notes, one.stenosis.vessel, one.stenosis.from_mm,
                                             one.stenosis.to_mm, finding.feature)};
      feature.counts = one.state != LesionState::rejected && feature_counts(feature);
      one.features.push_back(feature);
    }
    const auto counted = std::count_if(one.features.begin(), one.features.end(),
                                       [](const ReportFeature& feature) { return feature.counts; });
    one.high_risk = counted >= analysis::least_high_risk_features &&
                    one.stenosis.reference_diameter_mm >= report.options.least_graded_mm;
  }
}

}  // namespace ostia::session
