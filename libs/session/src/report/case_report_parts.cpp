#include "report/case_report_parts.h"

#include "report/case_report_text.h"
#include "report/case_report_words.h"

#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"

#include <algorithm>

namespace ostia::session::report_parts {
namespace {

using analysis::PlaqueBurden;
using analysis::PlaqueFeature;
using report_text::label;
using report_words::own;

std::string burden_text(PlaqueBurden burden) {
  if (burden == PlaqueBurden::none) return analysis::description(burden);
  return analysis::to_string(burden) + ", " + analysis::description(burden);
}

std::string by_segments_text(const ReportBurden& burden) {
  return std::string(burden.at_least ? "at least " : "") + std::to_string(burden.segments) +
         " of 18 segments: " + burden_text(burden.by_segments);
}

std::string stated_text(const ReportBurden& burden) {
  return burden_text(burden.stated) + (burden.by_reader ? " (reader)" : "");
}

std::string high_risk_text(const CaseReport& report) {
  std::string text;
  for (const ReportStenosis& one : report.stenoses)
    if (one.high_risk) text += (text.empty() ? "" : ", ") + label(one);
  if (!text.empty()) return text;
  return report.has_image ? "none found" : "not known: the image was not at hand";
}

std::string measured_text(const analysis::PlaqueFeatureFinding& finding) {
  if (!finding.known) return "not known";
  return finding.value > 0.0 ? feature_text(finding) : "none";
}

std::string bound_text(const analysis::PlaqueFeatureFinding& finding) {
  switch (finding.feature) {
    case PlaqueFeature::low_attenuation:
      return "at least " + core::volume_text(finding.bound) + " mm\u00b3";
    case PlaqueFeature::positive_remodelling:
      return "above " + core::ratio_text(finding.bound);
    case PlaqueFeature::spotty_calcium:
      return "below " + core::calibre_text(finding.bound) + " mm";
    case PlaqueFeature::napkin_ring:
      break;
  }
  return "at least " + core::set_angle_text(finding.bound) + "\u00b0";
}

std::string found_text(const analysis::PlaqueFeatureFinding& finding) {
  return !finding.known ? "not known" : finding.present ? "found" : "not found";
}

std::string stenosis_cell(const ReportStandardSegment& row) {
  if (row.vessels.empty()) return "not in the tree";
  const std::string worst = row.worst_stenosis > 0 ? "S" + std::to_string(row.worst_stenosis) + ": " +
                                                         report_text::percent(row.worst_percent) + " %, "
                                                   : "";
  if (!row.category) return worst + (worst.empty() ? "not judged" : "not graded");
  return worst + (*row.category == analysis::CadRads::zero ? "none" : extent(*row.category));
}

std::string plaque_cell(const ReportStandardSegment& row) {
  if (row.vessels.empty()) return "";
  if (row.plaque && row.has_plaque) return analysis::to_string(analysis::plaque_type(*row.plaque));
  return row.has_plaque || row.worst_stenosis > 0 || !row.plaque ? "not known" : "none";
}

std::string features_cell(const ReportStandardSegment& row) {
  std::string text;
  for (const PlaqueFeature feature : row.features)
    text += (text.empty() ? "" : "\n") + analysis::to_string(feature);
  return text;
}

}  // namespace

std::string extent(analysis::CadRads category) {
  switch (category) {
    case analysis::CadRads::zero:
    case analysis::CadRads::one:
      return "minimal";
    case analysis::CadRads::two:
      return "mild";
    case analysis::CadRads::three:
      return "moderate";
    case analysis::CadRads::four_a:
    case analysis::CadRads::four_b:
      return "severe";
    case analysis::CadRads::five:
      break;
  }
  return "occlusion";
}

Facts cad_rads_facts(const CaseReport& report) {
  const ReportBurden& burden = report.burden;
  const ReportModifiers& said = report.notes.modifiers;
  const auto given = [](bool yes) { return yes ? "yes" : "none known"; };
  return {{"As it is written", "CAD-RADS " + analysis::to_string(report.statement)},
          {"Plaque burden by segments (SIS)", by_segments_text(burden)},
          {"Plaque burden by calcium score",
           burden.by_calcium
               ? "Agatston " + core::shown_text(*burden.agatston, 0) + ": " + burden_text(*burden.by_calcium)
               : "not known"},
          {"Plaque burden by sight",
           burden.by_sight ? burden_text(*burden.by_sight) : "not judged by the reader"},
          {"Plaque burden stated", stated_text(burden)},
          {"High-risk plaque (HRP)", high_risk_text(report)},
          {"Ischaemia (I)", analysis::to_string(said.ischaemia)},
          {"Stent (S)", given(said.stent)},
          {"Graft (G)", given(said.graft)},
          {"Exceptions (E)", said.exception.empty() ? "none known" : own(said.exception)},
          {"Next investigation", analysis::further_investigation(report.category)}};
}

std::string dominance_text(const CaseReport& report) {
  return analysis::to_string(report.dominance) + (report.dominance_by_reader ? " (reader)" : "");
}

std::string technique_text(const CaseReport& report) {
  std::string text;
  const auto add = [&](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
  if (const auto& known = report.options.technique) {
    if (known->tube_kv) add(core::shown_text(*known->tube_kv, 0) + " kV");
    if (known->slice_mm) add("slices of " + core::calibre_text(*known->slice_mm) + " mm");
    if (!known->kernel.empty()) add("kernel " + known->kernel);
    if (known->phase_percent)
      add("at " + core::percent_text(*known->phase_percent) + " % of the cardiac cycle");
  }
  if (report.quality) {
    const geometry::Vec3& mm = report.quality->voxel_mm;
    add("voxels of " + core::calibre_text(mm.x()) + " x " + core::calibre_text(mm.y()) + " x " +
        core::calibre_text(mm.z()) + " mm");
  }
  return text;
}

std::vector<std::string> high_risk_header() {
  return {"Lesion",  "Segment",  "Feature",    "Measured", "Bound",
          "At (mm)", "By image", "Confidence", "Reader",   "Counts"};
}

Rows high_risk_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportStenosis& one : report.stenoses)
    for (const ReportFeature& feature : one.features) {
      const analysis::PlaqueFeatureFinding& finding = feature.finding;
      if (!finding.present && feature.state == LesionState::open) continue;
      rows.push_back({label(one), one.segment, analysis::to_string(finding.feature), measured_text(finding),
                      bound_text(finding), finding.s_mm ? core::length_text(*finding.s_mm) : "",
                      found_text(finding), analysis::to_string(finding.confidence),
                      feature.state == LesionState::open ? "" : to_string(feature.state),
                      feature.counts ? "yes" : "no"});
    }
  return rows;
}

std::string high_risk_note(const CaseReport& report) {
  const analysis::HighRiskOptions& o = report.options.high_risk;
  return "Low attenuation: the largest piece of plaque below " +
         core::hu_text(report.options.walls.plaque.low_attenuation_hu) +
         " HU. Positive remodelling: outer diameter at the throat over that at the places of reference. "
         "Spotty "
         "calcium: a piece of calcium that is smaller than " +
         core::calibre_text(o.spot_mm) +
         " mm in every direction, in plaque that is not calcified as a whole. Napkin ring: low attenuation "
         "at "
         "the lumen within a brighter rim without calcium, around " +
         core::set_angle_text(o.ring_deg) + "\u00b0 or more over " + core::length_text(o.ring_mm) +
         " mm. What is of low confidence counts where a person has accepted it. Two features or more are "
         "high-risk plaque.";
}

std::vector<std::string> standard_header() {
  return {"No.",       "Segment",  "Vessel",         "Stenosis",
          "Plaque",    "MLD (mm)", "MLA (mm\u00b2)", "High-risk features",
          "Evaluable", "Checked"};
}

Rows standard_rows(const CaseReport& report) {
  Rows rows;
  for (const ReportStandardSegment& row : report.standard_segments) {
    const bool there = !row.vessels.empty();
    rows.push_back({std::to_string(row.number), row.code, own(report_text::listed(row.vessels)),
                    stenosis_cell(row), plaque_cell(row),
                    there ? core::calibre_text(row.least_diameter_mm) : "",
                    there ? core::area_text(row.least_area_mm2) : "", features_cell(row),
                    !there          ? ""
                    : row.evaluable ? report_text::grade(*row.evaluable)
                                    : "not known",
                    !there        ? ""
                    : row.checked ? "yes"
                                  : "NO"});
  }
  return rows;
}

std::vector<std::string> version_header() {
  return {"Version", "Date", "Signed by", "What changed"};
}

Rows version_rows(const CaseReport& report) {
  Rows rows;
  for (std::size_t i = 0; i < report.notes.versions.size(); ++i) {
    const ReportVersion& one = report.notes.versions[i];
    rows.push_back({std::to_string(i + 1), one.date, own(one.signer),
                    one.changes.empty() ? "first version" : own(one.changes)});
  }
  return rows;
}

std::string version_note(const CaseReport& report) {
  if (report.notes.versions.empty()) return "Nobody has signed this report.";
  const std::string number = std::to_string(report.notes.versions.size());
  return report.is_signed ? "This is version " + number + ", as it was signed."
                          : "Something has changed since version " + number + " was signed.";
}

}  // namespace ostia::session::report_parts

namespace ostia::session {

std::string feature_text(const analysis::PlaqueFeatureFinding& finding) {
  switch (finding.feature) {
    case analysis::PlaqueFeature::low_attenuation:
      return core::volume_text(finding.value) + " mm\u00b3";
    case analysis::PlaqueFeature::positive_remodelling:
      return core::ratio_text(finding.value);
    case analysis::PlaqueFeature::spotty_calcium:
      return core::calibre_text(finding.value) + " mm";
    case analysis::PlaqueFeature::napkin_ring:
      break;
  }
  return core::set_angle_text(finding.value) + "\u00b0";
}

}  // namespace ostia::session
