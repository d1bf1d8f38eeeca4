// The impression: drafted of the findings, the reader's where there is one.

#include "report/case_report_grading.h"
#include "report/case_report_parts.h"
#include "report/case_report_text.h"
#include "report/case_report_words.h"

#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"

#include <algorithm>

namespace ostia::session {
namespace {

constexpr double told_percent = 25.0;  // a lesion that is told by itself
constexpr std::size_t most_told_lesions = 6;

/// "S1, LAD, pLAD (6): 72 % of the diameter, severe; MLD 0.90 mm; plaque: mixed".
std::string lesion_line(const ReportStenosis& one) {
  std::string text = report_text::label(one) + ", " + one.vessel_name + ", " + one.segment + ": " +
                     report_text::percent(one.stenosis.diameter_percent) + " % of the diameter, " +
                     report_parts::extent(*one.category) + "; MLD " +
                     core::calibre_text(one.stenosis.least_diameter_mm) + " mm";
  if (!one.plaque) return text;
  const std::string type = analysis::to_string(analysis::plaque_type(one.plaque->volumes));
  return text + "; plaque: " + type;
}

std::vector<const ReportStenosis*> told_lesions(const CaseReport& report) {
  std::vector<const ReportStenosis*> told;
  for (const ReportStenosis& one : report.stenoses)
    if (one.graded && one.category && one.stenosis.diameter_percent >= told_percent) told.push_back(&one);
  std::stable_sort(told.begin(), told.end(), [](const ReportStenosis* a, const ReportStenosis* b) {
    return a->stenosis.diameter_percent > b->stenosis.diameter_percent;
  });
  if (told.size() > most_told_lesions) told.resize(most_told_lesions);
  return told;
}

std::string features_text(const ReportStenosis& one) {
  std::string text;
  for (const ReportFeature& feature : one.features)
    if (feature.counts) text += (text.empty() ? "" : ", ") + analysis::to_string(feature.finding.feature);
  return text;
}

void add_burden_lines(std::vector<std::string>& lines, const ReportBurden& burden) {
  if (burden.stated == analysis::PlaqueBurden::none && !burden.by_calcium) return;
  lines.push_back("Plaque in " + std::string(burden.at_least ? "at least " : "") +
                  std::to_string(burden.segments) +
                  " of 18 segments: " + analysis::to_string(burden.by_segments));
  if (burden.by_calcium)
    lines.push_back("Calcium score " + core::shown_text(*burden.agatston, 0) + ": " +
                    analysis::to_string(*burden.by_calcium));
}

std::vector<std::string> draft_lines(const CaseReport& report) {
  std::vector<std::string> lines{"CAD-RADS " + analysis::to_string(report.statement) + ": " +
                                 analysis::description(report.category)};
  const auto told = told_lesions(report);
  for (const ReportStenosis* one : told) lines.push_back(lesion_line(*one));
  if (told.empty() && report.category.category)
    lines.push_back("No graded narrowing of " + report_text::percent(told_percent) +
                    " % of the diameter or more");
  add_burden_lines(lines, report.burden);
  for (const ReportStenosis& one : report.stenoses)
    if (one.high_risk)
      lines.push_back("High-risk plaque, " + report_text::label(one) + " in " + one.segment + ": " +
                      features_text(one));
  if (report.notes.modifiers.ischaemia != analysis::Ischaemia::not_tested)
    lines.push_back("Test for ischaemia: " + analysis::to_string(report.notes.modifiers.ischaemia));
  if (!report.not_judged.empty()) {
    std::string list;
    for (const std::string& one : report.not_judged) list += (list.empty() ? "" : "; ") + one;
    lines.push_back("Not judged: " + list + ".");
  }
  if (report.dominance != analysis::Dominance::unknown)
    lines.push_back("Dominance: " + analysis::to_string(report.dominance));
  if (report.quality) lines.push_back("Image quality: " + to_string(report.quality->grade));
  return lines;
}

}  // namespace

void write_impression(CaseReport& report) {
  report.impression_draft.clear();
  for (const std::string& line : draft_lines(report))
    report.impression_draft += (report.impression_draft.empty() ? "" : "\n") + line;
  const std::string& own =
      report.options.impression.empty() ? report.notes.impression : report.options.impression;
  report.impression_by_person = !own.empty();
  report.impression = report.impression_by_person ? own : report.impression_draft;
  report.is_signed =
      !report.notes.versions.empty() && report.notes.versions.back().digest == report.content_digest &&
      own == report.notes.impression && report.burden.agatston == report.notes.modifiers.agatston;
}

std::string drafted_impression(const CaseReport& report) {
  return report_words::of(report.options.language).say(report.impression_draft);
}

}  // namespace ostia::session
