// The standard segments of a report, its plaque burden, and CAD-RADS as it is written.

#include "report/case_report_grading.h"

#include <algorithm>

namespace ostia::session {
namespace {

constexpr double least_within_mm = 1.0;  // of a lesion, for its plaque to be a segment's

/// A lesion's plaque lies in a stretch: its throat, or a millimetre of it.
bool reaches_into(const ReportStenosis& one, const ReportSegment& segment) {
  if (one.stenosis.vessel != segment.vessel) return false;
  const double within =
      std::min(one.stenosis.to_mm, segment.to_mm) - std::max(one.stenosis.from_mm, segment.from_mm);
  const bool throat = one.stenosis.throat_mm >= segment.from_mm && one.stenosis.throat_mm < segment.to_mm;
  return throat || within >= least_within_mm;
}

void add_segment_plaque(std::optional<analysis::PlaqueVolumes>& sum, const CaseReport& report,
                        const ReportSegment& segment) {
  const auto walls = report.walls.find(segment.vessel);
  if (walls == report.walls.end()) return;
  const analysis::PlaqueVolumes one =
      analysis::plaque_between(walls->second.plaque, segment.from_mm, segment.to_mm);
  if (!(one.length_mm > 0.0)) return;
  if (!sum) sum.emplace();
  analysis::add(*sum, one);
}

void take_least(std::optional<double>& least, const std::optional<double>& value) {
  if (value && (!least || *value < *least)) least = value;
}

void add_lesions_of(ReportStandardSegment& row, const CaseReport& report, const ReportSegment& segment) {
  for (const ReportStenosis& one : report.stenoses) {
    if (one.state == LesionState::rejected || !reaches_into(one, segment)) continue;
    row.has_plaque = row.has_plaque || one.graded;
    for (const ReportFeature& feature : one.features)
      if (feature.counts &&
          std::find(row.features.begin(), row.features.end(), feature.finding.feature) == row.features.end())
        row.features.push_back(feature.finding.feature);
    if (one.segment != segment.label) continue;  // its throat is elsewhere
    // One that is graded goes before all that are not.
    const bool first = row.worst_stenosis == 0 || (one.graded && !row.category);
    if (!first && (one.graded != row.category.has_value() || one.graded_percent <= row.worst_percent))
      continue;
    row.worst_percent = one.graded_percent;
    row.worst_stenosis = one.number;
    row.category = one.graded ? one.category : std::nullopt;
  }
}

/// Nothing but what could not be judged is left without a category.
bool can_be_judged(const ReportSegment& segment) {
  if (segment.checked)
    return !segment.evaluable || !segment.evaluable->by_person ||
           segment.evaluable->grade != analysis::Evaluability::not_evaluable;
  return segment.evaluable && segment.evaluable->grade == analysis::Evaluability::evaluable;
}

ReportStandardSegment standard_segment(const analysis::AhaSegment& standard, const CaseReport& report) {
  ReportStandardSegment row;
  row.number = standard.number;
  row.code = standard.code;
  row.name = standard.name;
  bool judged = true;
  row.checked = true;
  for (const ReportSegment& segment : report.segments) {
    if (segment.number != standard.number) continue;
    row.vessels.push_back(segment.vessel_name);
    row.checked = row.checked && segment.checked;
    judged = judged && can_be_judged(segment);
    take_least(row.least_diameter_mm, segment.least_diameter_mm);
    take_least(row.least_area_mm2, segment.least_area_mm2);
    if (segment.evaluable && (!row.evaluable || segment.evaluable->grade > row.evaluable->grade))
      row.evaluable = segment.evaluable;
    add_segment_plaque(row.plaque, report, segment);
    add_lesions_of(row, report, segment);
  }
  if (row.vessels.empty())
    row.checked = false;
  else if (judged && row.worst_stenosis == 0 && !row.category)
    row.category = row.has_plaque ? analysis::CadRads::one : analysis::CadRads::zero;
  return row;
}

ReportBurden burden_of(const CaseReport& report) {
  ReportBurden burden;
  const ReportModifiers& said = report.notes.modifiers;
  burden.segments =
      static_cast<int>(std::count_if(report.standard_segments.begin(), report.standard_segments.end(),
                                     [](const ReportStandardSegment& one) { return one.has_plaque; }));
  burden.at_least = !report.not_judged.empty();
  burden.by_segments = analysis::burden_by_segments(burden.segments);
  burden.agatston = report.options.agatston ? report.options.agatston : said.agatston;
  if (burden.agatston) burden.by_calcium = analysis::burden_by_calcium(*burden.agatston);
  if (said.seen)
    burden.by_sight = analysis::burden_by_sight({said.seen->lad, said.seen->lcx, said.seen->rca});
  burden.stated = burden.by_segments;
  if (burden.by_calcium && !said.stent) burden.stated = std::max(burden.stated, *burden.by_calcium);
  if (burden.by_sight) burden.stated = std::max(burden.stated, *burden.by_sight);
  if (said.burden) burden.stated = *said.burden, burden.by_reader = true;
  return burden;
}

}  // namespace

void state_category(CaseReport& report, const std::vector<analysis::VesselSegment>& cut) {
  report.standard_segments.clear();
  for (const analysis::AhaSegment& one : analysis::aha_segments())
    report.standard_segments.push_back(standard_segment(one, report));
  const ReportModifiers& said = report.notes.modifiers;
  report.dominance_by_reader = said.dominance != analysis::Dominance::unknown;
  report.dominance = report.dominance_by_reader ? said.dominance : analysis::dominance_of(cut);
  report.burden = burden_of(report);
  analysis::CadRadsStatement& statement = report.statement;
  statement.category = report.category;
  statement.burden = report.burden.stated;
  statement.high_risk_plaque = std::any_of(report.stenoses.begin(), report.stenoses.end(),
                                           [](const ReportStenosis& one) { return one.high_risk; });
  statement.ischaemia = said.ischaemia;
  statement.stent = said.stent;
  statement.graft = said.graft;
  statement.exception = !said.exception.empty();
  if (report.category.category != analysis::CadRads::zero || statement.burden == analysis::PlaqueBurden::none)
    return;
  // Category 0 is no plaque at all; plaque that does not narrow is 1.
  report.category.category = statement.category.category = analysis::CadRads::one;
  report.warnings.push_back("the category is 1 and not 0: a plaque burden of " +
                            analysis::to_string(statement.burden) +
                            " was given, so there is plaque that the tables do not have");
}

}  // namespace ostia::session
