// The report's measurements in codes.

#include "ostia/core/error.h"
#include "ostia/session/dicom_objects.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

namespace codes = dicom::codes;
using dicom::MeasuredNumber;
using dicom::MeasurementGroup;

/// (code, scheme, meaning) of our own where the standard has none.
dicom::Code own_code(const std::string& value, const std::string& meaning) {
  return {value, "99OSTIA", meaning};
}

/// Values of codes have 16 characters at most.
dicom::Code feature_code(analysis::PlaqueFeature feature) {
  const std::string words = analysis::to_string(feature);
  std::string value =
      feature == analysis::PlaqueFeature::positive_remodelling ? std::string("pos_remodelling") : words;
  std::replace(value.begin(), value.end(), ' ', '_');
  return own_code(value, words);
}

dicom::Code unit_code(analysis::PlaqueFeature feature) {
  const std::string unit = analysis::unit_of(feature);
  return unit == "mm3"   ? dicom::codes::cubic_millimetre
         : unit == "mm"  ? dicom::codes::millimetre
         : unit == "deg" ? dicom::Code{"deg", "UCUM", "deg"}
                         : dicom::codes::ratio;
}

const std::array<dicom::Code, analysis::plaque_classes>& plaque_codes() {
  static const std::array<dicom::Code, analysis::plaque_classes> all{
      codes::soft_plaque, codes::fibrolipidic_plaque, codes::fibrous_plaque, codes::calcified_plaque};
  return all;
}

dicom::Code site_of_label(const std::string& label) {
  for (const analysis::AhaSegment& one : analysis::aha_segments())
    if (label == one.code + " (" + std::to_string(one.number) + ")") return dicom::segment_site(one.number);
  return codes::coronary_artery;
}

dicom::Code site_of_vessel(const std::string& name) {
  const std::string main = analysis::main_vessel_of(name);
  if (name == "RCA") return {"13647002", "SCT", "Right Coronary Artery"};
  if (name == "LAD") return {"59438005", "SCT", "Left Anterior Descending Coronary Artery"};
  if (name == "LCX") return {"57396003", "SCT", "Circumflex Coronary Artery"};
  if (name == "LM") return dicom::segment_site(5);
  for (const analysis::AhaSegment& one : analysis::aha_segments())
    if (!main.empty() && one.code == name) return dicom::segment_site(one.number);
  return codes::coronary_artery;
}

void add_plaque(const ReportPlaque& plaque, MeasurementGroup& group) {
  group.numbers.push_back({codes::lumen_volume, plaque.volumes.lumen_mm3, codes::cubic_millimetre, {}});
  group.numbers.push_back({codes::plaque_volume, plaque.volumes.plaque_mm3(), codes::cubic_millimetre, {}});
  group.numbers.push_back({codes::plaque_burden, plaque.volumes.burden_percent(), codes::percent, {}});
}

/// A group for each class of plaque that is there: what it is stands in the group, its volume in a number.
void add_classes(const ReportPlaque& plaque, const std::string& tracking, const dicom::Code& site,
                 std::vector<MeasurementGroup>& groups) {
  for (std::size_t c = 0; c < analysis::plaque_classes; ++c) {
    if (!(plaque.volumes.class_mm3[c] > 0.0)) continue;
    const std::string name = analysis::to_string(static_cast<analysis::PlaqueClass>(c));
    groups.push_back({tracking + ", " + name + " plaque",
                      plaque_codes()[c],
                      site,
                      {{codes::volume, plaque.volumes.class_mm3[c], codes::cubic_millimetre, {}}},
                      {}});
  }
}

void add_vessel(const ReportVessel& vessel, std::vector<MeasurementGroup>& groups) {
  const dicom::Code site = site_of_vessel(vessel.name);
  const std::string tracking = "vessel " + std::to_string(vessel.id);
  MeasurementGroup group{tracking, {}, site, {}, {}};
  group.numbers.push_back({codes::length, vessel.length_mm - vessel.own_from_mm, codes::millimetre, {}});
  if (vessel.plaque) add_plaque(*vessel.plaque, group);
  group.statements.push_back({own_code("vessel_name", "Name of the vessel"), {}, vessel.name});
  group.statements.push_back({own_code("checked", "Checked by a person"), {}, vessel.checked ? "yes" : "no"});
  groups.push_back(std::move(group));
  if (vessel.plaque) add_classes(*vessel.plaque, tracking, site, groups);
}

/// The FFR behind a lesion, by the place of its throat.
std::optional<double> ffr_behind(const nlohmann::json& ffr, const analysis::Stenosis& stenosis) {
  if (!ffr.is_object()) return std::nullopt;
  std::optional<double> found;
  double nearest = 1.0;  // mm
  for (const nlohmann::json& lesion : ffr.at("lesions")) {
    const nlohmann::json& throat = lesion.at("throat");
    const double away = std::abs(throat.at("s_mm").get<double>() - stenosis.throat_mm);
    if (throat.at("vessel").get<std::int32_t>() != stenosis.vessel || away > nearest ||
        lesion.at("ffr").is_null())
      continue;
    nearest = away;
    found = lesion.at("ffr").get<double>();
  }
  return found;
}

/// The features of high-risk plaque that count, and what was measured of each that is known.
void add_high_risk(const ReportStenosis& lesion, MeasurementGroup& group) {
  for (const ReportFeature& one : lesion.features) {
    const dicom::Code code = feature_code(one.finding.feature);
    // The remodelling index has a code of its own, under which it stands already.
    const bool own_number = one.finding.feature != analysis::PlaqueFeature::positive_remodelling;
    if (one.finding.known && own_number)
      group.numbers.push_back({code, one.finding.value, unit_code(one.finding.feature), {}});
    if (one.counts)
      group.statements.push_back({own_code("hrp_feature", "Feature of high-risk plaque"), code, {}});
  }
  if (lesion.high_risk)
    group.statements.push_back(
        {own_code("hrp", "High-risk plaque"), dicom::Code{"373066001", "SCT", "Yes"}, {}});
}

MeasurementGroup group_of_stenosis(const ReportStenosis& lesion, const nlohmann::json& ffr) {
  const analysis::Stenosis& s = lesion.stenosis;
  MeasurementGroup group{"S" + std::to_string(lesion.number),
                         lesion.narrows ? codes::stenosis : codes::plaque,
                         site_of_label(lesion.segment),
                         {},
                         {}};
  group.numbers = {{codes::lesion_length, s.length_mm(), codes::millimetre, {}},
                   {codes::lumen_diameter, s.least_diameter_mm, codes::millimetre, codes::minimum},
                   {codes::lumen_area, s.least_area_mm2, codes::square_millimetre, codes::minimum},
                   {codes::diameter_stenosis, s.diameter_percent, codes::percent, {}},
                   {codes::area_stenosis, s.area_percent, codes::percent, {}}};
  if (lesion.remodelling_index)
    group.numbers.push_back({codes::remodelling_index, *lesion.remodelling_index, codes::ratio, {}});
  if (lesion.plaque)
    group.numbers.push_back(
        {codes::plaque_volume, lesion.plaque->volumes.plaque_mm3(), codes::cubic_millimetre, {}});
  if (const auto value = ffr_behind(ffr, s))
    group.numbers.push_back({codes::fractional_flow_reserve, *value, codes::ratio, {}});
  add_high_risk(lesion, group);
  group.statements.push_back({own_code("vessel_name", "Name of the vessel"), {}, lesion.vessel_name});
  group.statements.push_back({own_code("segment", "Segment"), {}, lesion.segment});
  if (lesion.category)
    group.statements.push_back({own_code("lesion_category", "CAD-RADS by this lesion alone"),
                                {},
                                analysis::to_string(*lesion.category)});
  if (!lesion.graded && !lesion.not_graded.empty())
    group.statements.push_back({own_code("not_graded", "Not graded since"), {}, lesion.not_graded});
  if (!lesion.comment.empty()) group.statements.push_back({{"121106", "DCM", "Comment"}, {}, lesion.comment});
  return group;
}

MeasurementGroup group_of_segment(const ReportSegment& segment) {
  MeasurementGroup group{"segment " + segment.label + " of vessel " + std::to_string(segment.vessel),
                         {},
                         site_of_label(segment.label),
                         {},
                         {}};
  const auto add = [&](const dicom::Code& name, const std::optional<double>& value, const dicom::Code& unit,
                       const std::optional<dicom::Code>& derivation) {
    if (value) group.numbers.push_back({name, *value, unit, derivation});
  };
  group.numbers.push_back({codes::length, segment.to_mm - segment.from_mm, codes::millimetre, {}});
  add(codes::lumen_diameter, segment.mean_diameter_mm, codes::millimetre, codes::mean);
  add(codes::lumen_diameter, segment.least_diameter_mm, codes::millimetre, codes::minimum);
  add(codes::lumen_area, segment.least_area_mm2, codes::square_millimetre, codes::minimum);
  add(codes::lumen_volume, segment.volume_mm3, codes::cubic_millimetre, {});
  group.statements.push_back({own_code("segment", "Segment"), {}, segment.label});
  return group;
}

void add_category(const analysis::PatientCategory& category, dicom::MeasurementReport& report) {
  const auto coded = dicom::cad_rads_codes(category.category ? analysis::to_string(*category.category) : "N");
  if (!coded) return;
  report.statements.push_back({dicom::cad_assessment, coded->assessment, {}});
  if (coded->stenosis_modifier)
    report.statements.push_back({dicom::cad_stenosis_modifier, coded->stenosis_modifier, {}});
  if (category.category && category.not_diagnostic)
    report.statements.push_back({dicom::cad_modifier, dicom::not_diagnostic_segments, {}});
}

/// Plaque burden by each way that is known, the modifiers, and the whole as it is written.
void add_statement(const CaseReport& report, dicom::MeasurementReport& to) {
  using analysis::PlaqueBurden;
  const auto burden = [&](const char* value, const char* meaning, PlaqueBurden one) {
    if (one == PlaqueBurden::none) return;
    const std::string grade = analysis::to_string(one), words = grade + ", " + analysis::description(one);
    to.statements.push_back({own_code(value, meaning), own_code(grade, words), {}});
  };
  burden("plaque_burden", "CAD-RADS plaque burden", report.burden.stated);
  burden("burden_segments", "Plaque burden by segment involvement", report.burden.by_segments);
  if (report.burden.by_calcium)
    burden("burden_calcium", "Plaque burden by calcium score", *report.burden.by_calcium);
  const auto modifier = [&](const dicom::Code& code) {
    to.statements.push_back({dicom::cad_modifier, code, {}});
  };
  const analysis::CadRadsStatement& statement = report.statement;
  if (statement.stent) modifier(dicom::stent_modifier);
  if (statement.graft) modifier(dicom::graft_modifier);
  if (statement.high_risk_plaque) modifier(own_code("HRP", "HRP - High-risk plaque"));
  to.statements.push_back(
      {own_code("cad_rads", "CAD-RADS 2.0 as it is written"), {}, analysis::to_string(statement)});
}

nlohmann::ordered_json json_of(const dicom::Code& code) {
  return {{"code", code.value}, {"scheme", code.scheme}, {"meaning", code.meaning}};
}

nlohmann::ordered_json json_of(const dicom::Statement& one) {
  nlohmann::ordered_json json{{"name", json_of(one.name)}};
  if (one.value)
    json["value"] = json_of(*one.value);
  else
    json["text"] = one.text;
  return json;
}

nlohmann::ordered_json json_of(const MeasurementGroup& group) {
  nlohmann::ordered_json json{{"tracking", group.tracking}};
  if (group.finding) json["finding"] = json_of(*group.finding);
  if (group.site) json["site"] = json_of(*group.site);
  json["numbers"] = nlohmann::ordered_json::array();
  for (const MeasuredNumber& number : group.numbers) {
    nlohmann::ordered_json one{
        {"name", json_of(number.name)}, {"value", number.value}, {"unit", number.unit.value}};
    if (number.derivation) one["derivation"] = json_of(*number.derivation);
    json["numbers"].push_back(std::move(one));
  }
  json["statements"] = nlohmann::ordered_json::array();
  for (const dicom::Statement& one : group.statements) json["statements"].push_back(json_of(one));
  return json;
}

}  // namespace

dicom::MeasurementReport dicom_measurements(const CaseReport& report, const std::string& ffr_json) {
  dicom::MeasurementReport result;
  nlohmann::json ffr;
  if (!ffr_json.empty()) {
    ffr = nlohmann::json::parse(ffr_json, nullptr, false);
    if (!ffr.is_object() || ffr.value("kind", "") == "" || !ffr.contains("lesions"))
      throw InvalidInput("the FFR is not what `ostia ffr` writes: ffr.json has no list of lesions");
  }
  try {
    for (const ReportVessel& vessel : report.vessels) add_vessel(vessel, result.groups);
    for (const ReportSegment& segment : report.segments) result.groups.push_back(group_of_segment(segment));
    for (const ReportStenosis& lesion : report.stenoses) {
      result.groups.push_back(group_of_stenosis(lesion, ffr));
      if (lesion.plaque)
        add_classes(*lesion.plaque, result.groups.back().tracking, site_of_label(lesion.segment),
                    result.groups);
    }
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput(std::string("the FFR is not what `ostia ffr` writes: ") + error.what());
  }
  add_category(report.category, result);
  add_statement(report, result);
  return result;
}

std::string dicom_measurements_json(const dicom::MeasurementReport& report) {
  nlohmann::ordered_json json{{"v", 1}, {"kind", "measurements of a structured report"}};
  json["groups"] = nlohmann::ordered_json::array();
  for (const MeasurementGroup& group : report.groups) json["groups"].push_back(json_of(group));
  json["statements"] = nlohmann::ordered_json::array();
  for (const dicom::Statement& one : report.statements) json["statements"].push_back(json_of(one));
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace ostia::session
