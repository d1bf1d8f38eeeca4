#include "report/case_report_grading.h"

#include "report/case_report_text.h"

#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"
#include "ostia/session/lesion_grading.h"

#include <algorithm>

namespace ostia::session {
namespace {

using analysis::Evaluability;
using analysis::EvaluableStretch;

constexpr double least_stretch_mm = 1.5;  // that is told
constexpr double counts_percent = 25.0;   // a lesion that may change the category

const ReportVessel& vessel_of(const CaseReport& report, std::int32_t id) {
  return *std::find_if(report.vessels.begin(), report.vessels.end(),
                       [id](const ReportVessel& one) { return one.id == id; });
}

std::string reasons_of(const EvaluableStretch& stretch) {
  return stretch.by_person ? "says the reader" : report_text::reasons(stretch);
}

bool thin(const CaseReport& report, const ReportStenosis& one) {
  return one.stenosis.reference_diameter_mm < report.options.least_graded_mm;
}

/// Why a lesion cannot be judged; empty where it can.
std::string objection(const ReportStenosis& one, const ReportVessel& vessel) {
  switch (grade_bar(one.state, one.checked, one.evaluable, vessel.unlikely.has_value())) {
    case GradeBar::none:
      return {};
    case GradeBar::rejected:
      return "rejected by the reader";
    case GradeBar::not_evaluable_by_reader:
      return "not evaluable, says the reader";
    case GradeBar::image_unknown:
      return "nobody has checked it, and no image was at hand";
    case GradeBar::unlikely:
      return "its vessel is hardly an artery (probability " + core::shown_text(*vessel.unlikely, 2) +
             "), and nobody has checked it";
    case GradeBar::limited:
    case GradeBar::not_evaluable:
      break;
  }
  return analysis::to_string(one.evaluable->grade) + " (" + reasons_of(*one.evaluable) +
         "), and nobody has checked it";
}

/// The reference calibre at an abscissa.
double calibre_at(const CaseReport& report, std::int32_t vessel, double s_mm) {
  const analysis::LumenProfile& profile = report.profiles.at(vessel);
  const std::vector<double>& line = report.references.at(vessel).diameter_mm;
  if (line.empty() || !(profile.length_mm > 0.0)) return 0.0;
  const double place = s_mm / profile.length_mm * static_cast<double>(line.size() - 1);
  return line[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(line.size() - 1)))];
}

void add_stretches(CaseReport& report, const ReportVessel& vessel) {
  if (vessel.evaluable.empty()) {
    if (!vessel.checked && !report.has_image)
      report.not_judged.push_back(vessel.name + ": nobody has checked it, and no image was at hand");
    return;
  }
  for (const EvaluableStretch& one : vessel.evaluable) {
    const bool told =
        one.to_mm - one.from_mm >= least_stretch_mm &&
        calibre_at(report, vessel.id, 0.5 * (one.from_mm + one.to_mm)) >= report.options.least_graded_mm;
    if (!told || one.grade != Evaluability::not_evaluable || (vessel.checked && !one.by_person)) continue;
    report.not_judged.push_back(vessel.name + " from " + core::length_text(one.from_mm) + " to " +
                                core::length_text(one.to_mm) + " mm: not evaluable (" + reasons_of(one) +
                                ")");
  }
}

}  // namespace

void grade_report(CaseReport& report) {
  for (const std::string& artery : report.not_found) report.not_judged.push_back(artery);
  for (const ReportVessel& vessel : report.vessels) add_stretches(report, vessel);
  std::vector<analysis::GradedStenosis> graded;
  for (ReportStenosis& one : report.stenoses) {
    const ReportVessel& vessel = vessel_of(report, one.stenosis.vessel);
    one.evaluable = analysis::worst_within(vessel.evaluable, one.stenosis.from_mm, one.stenosis.to_mm);
    one.not_graded = objection(one, vessel);
    if (!one.not_graded.empty()) one.category.reset();
    if (thin(report, one) && one.not_graded.empty())
      one.not_graded =
          "its vessel is thinner than " + core::calibre_text(report.options.least_graded_mm) + " mm";
    one.graded = one.not_graded.empty();
    if (one.graded)
      graded.push_back({one.main_vessel, one.graded_percent});
    else if (one.state != LesionState::rejected && one.stenosis.diameter_percent >= counts_percent &&
             !thin(report, one))
      report.not_judged.push_back(report_text::label(one) + " in " + one.segment + ", " +
                                  report_text::percent(one.stenosis.diameter_percent) +
                                  " % by the model: " + one.not_graded);
  }
  for (ReportSegment& segment : report.segments)
    segment.evaluable =
        analysis::worst_within(vessel_of(report, segment.vessel).evaluable, segment.from_mm, segment.to_mm);
  report.category = analysis::patient_category(graded, report.not_judged.empty());
}

}  // namespace ostia::session
