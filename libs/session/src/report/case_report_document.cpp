// The report as a person reads it: the same parts as HTML and as PDF.

#include "report/case_report_parts.h"
#include "report/case_report_text.h"
#include "report/case_report_words.h"

#include "ostia/core/quantity_text.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/pdf_document.h"
#include "ostia/session/case_report.h"

#include <algorithm>

namespace ostia::session {
namespace {

using figure::Notice;
using report_text::label;
using report_text::percent;
using report_words::own;
using Rows = std::vector<std::vector<std::string>>;

constexpr const char* kDisclaimer =
    "Made with research software that is not a medical device. Nothing in this report may be used for "
    "diagnosis or treatment unless a physician has verified it on the images.";

std::string checked_text(bool checked) {
  return checked ? "yes" : "NO";
}

/// Of a lesion: the reader's own word before that on its vessel.
std::string checked_text(const ReportStenosis& one) {
  return one.state == LesionState::open ? checked_text(one.checked) : to_string(one.state);
}

std::string joined(const std::vector<std::string>& texts, const std::string& between) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : between) + text;
  return all;
}

std::string worst_text(const CaseReport& report) {
  const ReportStenosis* worst = nullptr;
  for (const ReportStenosis& one : report.stenoses)
    if (one.graded && (!worst || one.stenosis.diameter_percent > worst->stenosis.diameter_percent))
      worst = &one;
  if (!worst) return "none from " + percent(report.options.stenosis.least_percent) + " % of the diameter on";
  return label(*worst) + ", " + worst->vessel_name + ", " + worst->segment + ": " +
         percent(worst->stenosis.diameter_percent) + " % of the diameter";
}

std::string quality_text(const CaseReport& report) {
  if (!report.quality) return "not known: the image was not at hand";
  const ScanQuality& q = *report.quality;
  std::string text = to_string(q.grade);
  for (const std::string& reason : q.reasons) text += "\n" + reason;
  return text + "\nOf the arteries' length " + core::percent_text(100.0 * q.evaluable_share) +
         " % evaluable, " + core::percent_text(100.0 * q.limited_share) + " % limited, " +
         core::percent_text(100.0 * q.not_evaluable_share) + " % not evaluable";
}

std::string evaluable_text(const std::optional<analysis::EvaluableStretch>& stretch) {
  return stretch ? report_text::grade(*stretch) : "not known";
}

/// Stretches of a vessel that are less than evaluable.
std::string doubtful_text(const ReportVessel& vessel) {
  if (vessel.evaluable.empty()) return "not known";
  std::string text;
  for (const analysis::EvaluableStretch& one : vessel.evaluable) {
    if (one.grade == analysis::Evaluability::evaluable && !one.by_person) continue;
    text += (text.empty() ? "" : "\n") + core::length_text(one.from_mm) + "-" + core::length_text(one.to_mm) +
            " mm: " + report_text::grade(one);
    if (!one.reasons.empty()) text += ", " + report_text::reasons(one);
  }
  return text.empty() ? "all of it" : text;
}

std::string lesions_text(const CaseReport& report) {
  const auto of = [&](const auto& is) {
    return std::to_string(std::count_if(report.stenoses.begin(), report.stenoses.end(), is));
  };
  return std::to_string(report.stenoses.size()) + ", of which " +
         of([](const ReportStenosis& one) { return one.state == LesionState::accepted; }) +
         " were accepted and " +
         of([](const ReportStenosis& one) { return one.state == LesionState::rejected; }) +
         " rejected by a person";
}

std::vector<std::pair<std::string, std::string>> summary_of(const CaseReport& report) {
  const std::size_t unchecked = report.unchecked().size();
  std::vector<std::pair<std::string, std::string>> rows;
  if (!report.options.date.empty()) rows.emplace_back("Date", report.options.date);
  rows.emplace_back("Image", report.options.image ? report.options.image->pseudonym +
                                                        (report.has_image ? "" : " (not at hand)")
                                                  : "the case names none");
  if (report.options.image && !report.options.image->axes.empty())
    rows.emplace_back("Orientation", report.options.image->axes + ", given by a person");
  rows.emplace_back("CAD-RADS",
                    analysis::to_string(report.statement) + ": " + analysis::description(report.category));
  rows.emplace_back("Worst graded stenosis", worst_text(report));
  rows.emplace_back("Image quality", quality_text(report));
  if (const std::string technique = report_parts::technique_text(report); !technique.empty())
    rows.emplace_back("Technique", technique);
  rows.emplace_back("Dominance", report_parts::dominance_text(report));
  if (!report.not_found.empty()) rows.emplace_back("Not found", joined(report.not_found, "\n"));
  rows.emplace_back("Lesions", lesions_text(report));
  rows.emplace_back("Vessels", std::to_string(report.vessels.size()) + ", of which " +
                                   std::to_string(report.vessels.size() - unchecked) +
                                   " were checked by a person");
  const auto edits = std::count_if(report.steps.begin(), report.steps.end(),
                                   [](const ReportStep& step) { return step.op != "case.begin"; });
  rows.emplace_back("Steps taken", std::to_string(edits));
  rows.emplace_back("Program", "Ostia " + report.program_version);
  rows.emplace_back("Model", report.model_digest.substr(0, 16));
  return rows;
}

Rows stenosis_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportStenosis& one : report.stenoses) {
    const analysis::Stenosis& s = one.stenosis;
    rows.push_back({label(one), own(one.vessel_name), one.segment, core::length_text(s.throat_mm),
                    core::length_text(s.length_mm()), core::calibre_text(s.least_diameter_mm),
                    core::calibre_text(s.reference_diameter_mm), percent(s.diameter_percent) + " %",
                    core::area_text(s.least_area_mm2), percent(s.area_percent) + " %",
                    one.category ? analysis::to_string(*one.category) + (one.graded ? "" : " *")
                    : one.state == LesionState::rejected ? "rejected"
                                                         : "not graded",
                    evaluable_text(one.evaluable), checked_text(one)});
  }
  return rows;
}

Rows segment_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportSegment& s : report.segments)
    rows.push_back({s.label, own(s.vessel_name), core::length_text(s.to_mm - s.from_mm),
                    core::calibre_text(s.mean_diameter_mm), core::calibre_text(s.least_diameter_mm),
                    core::area_text(s.least_area_mm2), core::volume_text(s.volume_mm3),
                    s.worst_stenosis > 0
                        ? "S" + std::to_string(s.worst_stenosis) + ": " + percent(s.worst_percent) + " %"
                        : "none",
                    evaluable_text(s.evaluable), checked_text(s.checked)});
  return rows;
}

Rows vessel_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportVessel& v : report.vessels)
    rows.push_back({own(v.name), core::length_text(v.length_mm - v.own_from_mm), doubtful_text(v),
                    checked_text(v.checked), own(v.note)});
  return rows;
}

Rows measurement_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportMeasurement& m : report.measurements) {
    std::string values = m.problem;
    for (const analysis::MeasuredValue& value : m.values)
      values += (values.empty() ? "" : "\n") + value.name + ": " + analysis::to_text(value);
    rows.push_back({std::to_string(m.measurement.id),
                    report_text::kind_words(analysis::to_string(m.measurement.kind)), own(m.measurement.name),
                    own(m.vessel_name), values});
  }
  return rows;
}

Rows step_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportStep& step : report.steps) {
    std::string words = step.words;
    for (const std::string& note : step.notes) words += "\n" + note;
    rows.push_back({std::to_string(step.number), words, step.vessel});
  }
  return rows;
}

template <class Document>
void add_identity(Document& document, const imaging::ShownIdentity& named) {
  if (named.anonymous()) return;
  std::vector<std::pair<std::string, std::string>> rows;
  const auto add = [&](const char* what, const std::string& value) {
    if (!value.empty()) rows.emplace_back(what, own(value));
  };
  add("Patient", named.patient_name);
  add("Patient ID", named.patient_id);
  add("Study date", named.study_date);
  add("Series", named.series_description);
  document.key_values(rows);
  document.notice(
      Notice::warning,
      "This document names a patient, as its reader asked. The tables and pictures beside it do not.");
}

/// At the foot of each page, so that pages that are parted can be told apart.
std::string foot_of(const imaging::ShownIdentity& named) {
  if (named.anonymous()) return {};
  std::string text;
  for (const std::string& part : {named.patient_name, named.patient_id, named.study_date})
    if (!part.empty()) text += part + "  \xC2\xB7  ";
  return text;
}

template <class Document>
void add_summary(Document& document, const CaseReport& report) {
  document.notice(Notice::note, kDisclaimer);
  const std::vector<std::string> unchecked = report.unchecked();
  if (unchecked.empty())
    document.notice(Notice::good, "Every vessel was checked by a person.");
  else
    document.notice(Notice::warning, "Not checked by a person: " + report_text::listed(unchecked) +
                                         ". What stands here of these vessels is the program's own finding.");
  document.section("Summary");
  document.key_values(summary_of(report));
  if (!report.not_judged.empty())
    document.notice(Notice::warning, "Not judged: " + joined(report.not_judged, "; ") + ".");
  for (const std::string& warning : report.warnings) document.notice(Notice::warning, warning);
}

/// The reader's text as it stands, or the draft.
template <class Document>
void add_impression(Document& document, const CaseReport& report) {
  document.section("Impression");
  if (!report.impression_by_person)
    document.notice(Notice::note, "Drafted by the program from the findings; nobody has written it.");
  std::string line;
  const auto end_line = [&] {
    if (!line.empty()) document.paragraph(report.impression_by_person ? own(line) : line);
    line.clear();
  };
  for (const char c : report.impression) {
    if (c == '\n')
      end_line();
    else if (c != '\r')
      line += c;
  }
  end_line();
}

template <class Document>
void add_cad_rads(Document& document, const CaseReport& report) {
  document.section("CAD-RADS 2.0");
  document.key_values(report_parts::cad_rads_facts(report));
  document.paragraph(
      "Category, plaque burden and modifiers after Cury et al. 2022; the ways to the plaque burden often "
      "differ: the highest is stated, that by calcium not beside a stent, and the reader's word before all. "
      "Next investigation: what their table names for stable chest "
      "pain; it is no advice for this patient.");
}

/// Features that are there, and those that a reader speaks of; nothing without any.
template <class Document>
void add_high_risk(Document& document, const CaseReport& report) {
  const report_parts::Rows rows = report_parts::high_risk_rows(report);
  if (rows.empty()) return;
  document.section("High-risk plaque");
  document.table(report_parts::high_risk_header(), rows, "Features of high-risk plaque, by lesion");
  document.paragraph(report_parts::high_risk_note(report));
}

template <class Document>
void add_standard_segments(Document& document, const CaseReport& report) {
  document.section("Standard segments");
  document.table(report_parts::standard_header(), report_parts::standard_rows(report),
                 "The 18 segments of the SCCT");
}

template <class Document>
void add_versions(Document& document, const CaseReport& report) {
  document.section("Versions");
  document.notice(report.is_signed                ? Notice::good
                  : report.notes.versions.empty() ? Notice::note
                                                  : Notice::warning,
                  report_parts::version_note(report));
  if (!report.notes.versions.empty())
    document.table(report_parts::version_header(), report_parts::version_rows(report),
                   "Versions that were signed");
}

template <class Document>
void add_stenoses(Document& document, const CaseReport& report) {
  document.section("Stenoses");
  if (report.stenoses.empty()) {
    document.paragraph("No narrowing of " + percent(report.options.stenosis.least_percent) +
                       " % of the diameter or more was found.");
  } else {
    document.table(
        {"No.", "Vessel", "Segment", "At (mm)", "Length (mm)", "MLD (mm)", "Reference (mm)",
         "Diameter stenosis", "MLA (mm\xC2\xB2)", "Area stenosis", "CAD-RADS", "Evaluable", "Checked"},
        stenosis_rows(report), "Narrowings and plaques, each at its own vessel");
    for (const ReportStenosis& one : report.stenoses)
      if (!one.comment.empty()) document.paragraph(own(label(one) + ": " + one.comment));
    for (const ReportStenosis& one : report.stenoses)
      if (!one.category) document.paragraph(label(one) + " is not graded: " + one.not_graded + ".");
    if (std::any_of(report.stenoses.begin(), report.stenoses.end(),
                    [](const ReportStenosis& one) { return one.category && !one.graded; }))
      document.paragraph("* The reference is thinner than " +
                         core::calibre_text(report.options.least_graded_mm) +
                         " mm: without a say in the patient's category.");
  }
  document.paragraph(
      "CAD-RADS of a lesion is by its diameter alone, of what can be judged. Narrowings below " +
      percent(report.options.stenosis.least_percent) +
      " % are listed where plaque is seen; plaque without narrowing is category 1. MLD and MLA: least lumen "
      "diameter and area. Percentages are against the "
      "calibre that the vessel would have without disease.");
}

Rows bifurcation_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportBifurcation& one : report.bifurcations) {
    const analysis::MedinaClass& m = one.medina;
    if (!m.any()) continue;
    rows.push_back({own(one.main_name + " / " + one.side_name), analysis::to_string(m),
                    core::length_text(m.joint_mm), percent(m.proximal_percent) + " %",
                    percent(m.distal_percent) + " %", percent(m.side_percent) + " %"});
  }
  return rows;
}

/// Medina's classes of the bifurcations with a lesion; nothing without one.
template <class Document>
void add_bifurcations(Document& document, const CaseReport& report) {
  const Rows rows = bifurcation_rows(report);
  if (rows.empty()) return;
  document.section("Bifurcation lesions");
  document.table({"Bifurcation", "Medina", "At (mm)", "Main, proximal", "Main, distal", "Side branch"}, rows,
                 "Main vessel / side branch; worst narrowing of the diameter in each");
  document.paragraph(
      "Medina's class: main vessel before the bifurcation, main vessel behind it, side branch; 1 where "
      "the diameter is narrowed by " +
      percent(report.options.medina.least_percent) + " % or more within " +
      core::length_text(report.options.medina.region_mm) + " mm. Side branches from " +
      core::calibre_text(report.options.medina.least_side_mm) + " mm on.");
}

/// A stretch's volumes, mm^3, and what follows from them.
std::vector<std::string> plaque_row(const std::string& name, const ReportPlaque& plaque,
                                    const std::string& remodelling) {
  const analysis::PlaqueVolumes& v = plaque.volumes;
  std::vector<std::string> row{own(name), to_string(analysis::plaque_type(v)),
                               core::volume_text(v.plaque_mm3())};
  for (const double volume : v.class_mm3) row.push_back(core::volume_text(volume));
  row.push_back(core::volume_text(v.thin_wall_mm3));
  row.push_back(core::percent_text(v.burden_percent()) + " %");
  row.push_back(remodelling);
  row.push_back(core::percent_text(100.0 * plaque.seen_share) + " %");
  return row;
}

Rows plaque_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportVessel& vessel : report.vessels) {
    if (!vessel.plaque) continue;
    rows.push_back(plaque_row(vessel.name, *vessel.plaque, ""));
    for (const ReportStenosis& one : report.stenoses)
      if (one.stenosis.vessel == vessel.id && one.plaque)
        rows.push_back(plaque_row("  " + label(one), *one.plaque, core::ratio_text(one.remodelling_index)));
  }
  return rows;
}

template <class Document>
void add_plaque(Document& document, const CaseReport& report) {
  document.section("Plaque");
  const Rows rows = plaque_rows(report);
  if (rows.empty()) {
    document.paragraph(report.has_image ? "No outer wall was found."
                                        : "Not measured: the image was not at hand.");
    return;
  }
  const analysis::PlaqueOptions& o = report.options.walls.plaque;
  document.table({"Vessel", "Class", "Plaque (mm\xC2\xB3)", "Low attenuation", "Fibrofatty", "Fibrous",
                  "Calcified", "Thin wall (mm\xC2\xB3)", "Burden", "Remodelling index", "Outer wall seen"},
                 rows, "Between lumen and outer wall, by vessel and by stenosis");
  document.paragraph(
      "Low attenuation: below " + core::hu_text(o.low_attenuation_hu) + " HU; fibrofatty: to " +
      core::hu_text(o.fibrofatty_hu) + " HU; fibrous: to " + core::hu_text(o.fibrous_hu) +
      " HU; calcified: above, after the blur of lumen and fat was taken away. A wall thinner than " +
      core::calibre_text(o.thin_wall_mm) + " mm, or thicker by less than " +
      core::calibre_text(o.healthy_margin_mm) +
      " mm than a healthy one of that calibre, is wall and no plaque. Class: calcified from half of the "
      "plaque "
      "on, non-calcified below 5 %. Burden: plaque, of all within the outer wall. "
      "Remodelling index: vessel area at the throat over that at the places of reference. Where no fat "
      "borders "
      "on the wall it is not seen, and the outer wall is a bridge. All of this was found by the program.");
}

template <class Document>
void add_images(Document& document, const std::vector<KeyImage>& images) {
  if (images.empty()) return;
  document.section("Key images");
  for (const KeyImage& image : images) document.picture(image.picture, image.caption);
}

template <class Document>
void add_tables(Document& document, const CaseReport& report) {
  document.section("Segments");
  document.table({"Segment", "Vessel", "Length (mm)", "Mean diameter (mm)", "Least diameter (mm)",
                  "Least area (mm\xC2\xB2)", "Volume (mm\xC2\xB3)", "Worst stenosis", "Evaluable", "Checked"},
                 segment_rows(report), "Standard segments, AHA and SCCT numbers in brackets");
  document.section("Vessels");
  document.table({"Vessel", "Own length (mm)", "Evaluable", "Checked", "Note"}, vessel_rows(report),
                 "What was checked, and what was noted");
  document.section("Measurements");
  if (report.measurements.empty())
    document.paragraph("None were placed.");
  else
    document.table({"No.", "Kind", "Name", "Vessel", "Values"}, measurement_rows(report),
                   "Measurements placed by a person");
  document.section("Edit log");
  document.table({"Step", "What was done", "Vessel"}, step_rows(report),
                 "Steps of the journal; what was undone is left out");
}

template <class Document>
void compose(Document& written, const CaseReport& report, const std::vector<KeyImage>& images,
             const imaging::ShownIdentity& named) {
  report_words::Said<Document> document(written, report_words::of(report.options.language));
  add_identity(document, named);
  add_summary(document, report);
  add_impression(document, report);
  add_cad_rads(document, report);
  add_stenoses(document, report);
  add_high_risk(document, report);
  add_standard_segments(document, report);
  const bool brief = report.options.form == ReportTemplate::brief;
  if (brief) {
    if (!images.empty()) add_images(document, {images.front()});
  } else {
    add_bifurcations(document, report);
    add_plaque(document, report);
    add_images(document, images);
    add_tables(document, report);
  }
  add_versions(document, report);
}

std::string case_name(const CaseReport& report) {
  const std::string name = report.options.image ? "Case of " + report.options.image->pseudonym
                                                : "Case " + report.model_digest.substr(0, 8);
  return report_words::of(report.options.language).say(name);
}

std::string title_of(const CaseReport& report) {
  return report_words::of(report.options.language).say("Coronary arteries on CT angiography");
}

}  // namespace

std::string report_html(const CaseReport& report, const std::vector<KeyImage>& images,
                        const imaging::ShownIdentity& named) {
  figure::HtmlReport document(title_of(report), case_name(report),
                              report_words::document(report.options.language));
  compose(document, report, images, named);
  return document.html();
}

std::string report_pdf(const CaseReport& report, const std::vector<KeyImage>& images,
                       const imaging::ShownIdentity& named) {
  const core::Phrasebook& words = report_words::of(report.options.language);
  figure::PdfDocument document(
      title_of(report), case_name(report),
      {foot_of(named) + case_name(report) + "  \xC2\xB7  Ostia " + report.program_version + "  \xC2\xB7  " +
           words.say("research software, not a medical device"),
       report_words::document(report.options.language)});
  compose(document, report, images, named);
  return document.pdf();
}

}  // namespace ostia::session
