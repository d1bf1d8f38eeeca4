// report.json and the tables as CSV.

#include "report/case_report_text.h"

#include "ostia/core/csv.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/session/case_report.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

namespace ostia::session {
namespace {

using Json = nlohmann::ordered_json;
using report_text::label;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}
Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json();
}
Json text(const std::string& value) {
  return core::redacted(value);
}
Json texts(const std::vector<std::string>& values) {
  Json list = Json::array();
  for (const std::string& value : values) list.push_back(text(value));
  return list;
}

Json plaque_json(const std::optional<ReportPlaque>& plaque) {
  if (!plaque) return {};
  const analysis::PlaqueVolumes& v = plaque->volumes;
  return {{"from_mm", number(plaque->from_mm)},
          {"to_mm", number(plaque->to_mm)},
          {"lumen_mm3", number(v.lumen_mm3)},
          {"vessel_mm3", number(v.vessel_mm3)},
          {"thin_wall_mm3", number(v.thin_wall_mm3)},
          {"plaque_mm3", number(v.plaque_mm3())},
          {"low_attenuation_mm3", number(v.of(analysis::PlaqueClass::low_attenuation))},
          {"fibrofatty_mm3", number(v.of(analysis::PlaqueClass::fibrofatty))},
          {"fibrous_mm3", number(v.of(analysis::PlaqueClass::fibrous))},
          {"calcified_mm3", number(v.of(analysis::PlaqueClass::calcified))},
          {"type", to_string(analysis::plaque_type(v))},
          {"burden_percent", number(v.burden_percent())},
          {"seen_share", number(plaque->seen_share)}};
}

Json stretch_json(const analysis::EvaluableStretch& one) {
  Json reasons = Json::array();
  for (const analysis::EvaluabilityReason reason : one.reasons)
    reasons.push_back(analysis::to_string(reason));
  return {{"from_mm", number(one.from_mm)},
          {"to_mm", number(one.to_mm)},
          {"grade", analysis::to_string(one.grade)},
          {"by_person", one.by_person},
          {"reasons", reasons}};
}

Json grade_json(const std::optional<analysis::EvaluableStretch>& one) {
  return one ? Json(analysis::to_string(one->grade)) : Json();
}

Json quality_json(const std::optional<ScanQuality>& quality) {
  if (!quality) return {};
  const ScanQuality& q = *quality;
  return {{"grade", to_string(q.grade)},
          {"reasons", texts(q.reasons)},
          {"voxel_mm", {number(q.voxel_mm.x()), number(q.voxel_mm.y()), number(q.voxel_mm.z())}},
          {"noise_hu", number(q.noise_hu)},
          {"lumen_hu", number(q.lumen_hu)},
          {"contrast_hu", number(q.contrast_hu)},
          {"cnr", number(q.cnr)},
          {"blur_mm", number(q.blur_mm)},
          {"evaluable_share", number(q.evaluable_share)},
          {"limited_share", number(q.limited_share)},
          {"not_evaluable_share", number(q.not_evaluable_share)}};
}

Json vessel_json(const ReportVessel& v) {
  Json evaluable = Json::array();
  for (const analysis::EvaluableStretch& one : v.evaluable) evaluable.push_back(stretch_json(one));
  return {{"id", v.id},
          {"name", text(v.name)},
          {"length_mm", number(v.length_mm)},
          {"own_from_mm", number(v.own_from_mm)},
          {"unmeasured_mm", number(v.unmeasured_mm)},
          {"checked", v.checked},
          {"note", text(v.note)},
          {"evaluable", evaluable},
          {"unlikely", v.unlikely ? number(*v.unlikely) : Json()},
          {"plaque", plaque_json(v.plaque)}};
}

Json feature_json(const ReportFeature& one) {
  const analysis::PlaqueFeatureFinding& f = one.finding;
  return {{"feature", analysis::to_string(f.feature)},
          {"known", f.known},
          {"present", f.present},
          {"value", f.known ? number(f.value) : Json()},
          {"bound", number(f.bound)},
          {"unit", analysis::unit_of(f.feature)},
          {"s_mm", number(f.s_mm)},
          {"theta_deg", number(f.theta_deg)},
          {"confidence", analysis::to_string(f.confidence)},
          {"state", to_string(one.state)},
          {"counts", one.counts}};
}

/// A list of what `make` makes of each.
template <class Rows, class Make>
Json list_of(const Rows& rows, const Make& make) {
  Json all = Json::array();
  for (const auto& row : rows) all.push_back(make(row));
  return all;
}

Json burden_json(const ReportBurden& burden) {
  const auto word = [](const std::optional<analysis::PlaqueBurden>& one) {
    return one ? Json(analysis::to_string(*one)) : Json();
  };
  return {{"segments", burden.segments},
          {"at_least", burden.at_least},
          {"by_segments", analysis::to_string(burden.by_segments)},
          {"agatston", number(burden.agatston)},
          {"by_calcium", word(burden.by_calcium)},
          {"by_sight", word(burden.by_sight)},
          {"stated", analysis::to_string(burden.stated)},
          {"by_reader", burden.by_reader}};
}

Json cad_rads_json(const CaseReport& report) {
  const analysis::CadRadsStatement& s = report.statement;
  return {{"category", analysis::to_string(report.category)},
          {"description", analysis::description(report.category)},
          {"not_diagnostic", report.category.not_diagnostic},
          {"not_judged", texts(report.not_judged)},
          {"statement", analysis::to_string(s)},
          {"burden", burden_json(report.burden)},
          {"modifiers",
           {{"high_risk_plaque", s.high_risk_plaque},
            {"ischaemia", analysis::to_string(s.ischaemia)},
            {"stent", s.stent},
            {"graft", s.graft},
            {"exception", text(report.notes.modifiers.exception)}}},
          {"next_investigation", analysis::further_investigation(report.category)}};
}

Json standard_json(const ReportStandardSegment& row) {
  return {{"number", row.number},
          {"code", row.code},
          {"name", row.name},
          {"vessels", texts(row.vessels)},
          {"cad_rads", row.category ? Json(analysis::to_string(*row.category)) : Json()},
          {"worst_stenosis", row.worst_stenosis > 0 ? Json(row.worst_stenosis) : Json()},
          {"worst_percent", row.worst_stenosis > 0 ? number(row.worst_percent) : Json()},
          {"has_plaque", row.has_plaque},
          {"plaque_type", row.plaque ? Json(to_string(analysis::plaque_type(*row.plaque))) : Json()},
          {"plaque_mm3", row.plaque ? number(row.plaque->plaque_mm3()) : Json()},
          {"least_diameter_mm", number(row.least_diameter_mm)},
          {"least_area_mm2", number(row.least_area_mm2)},
          {"features",
           list_of(row.features, [](analysis::PlaqueFeature one) { return Json(analysis::to_string(one)); })},
          {"evaluable", grade_json(row.evaluable)},
          {"checked", row.checked}};
}

Json technique_json(const std::optional<imaging::ScanTechnique>& technique) {
  if (!technique) return {};
  return {{"tube_kv", number(technique->tube_kv)},
          {"slice_mm", number(technique->slice_mm)},
          {"phase_percent", number(technique->phase_percent)},
          {"kernel", technique->kernel.empty() ? Json() : text(technique->kernel)}};
}

Json versions_json(const ReportNotes& notes) {
  Json all = Json::array();
  for (const ReportVersion& one : notes.versions)
    all.push_back({{"number", static_cast<int>(all.size()) + 1},
                   {"date", one.date},
                   {"signer", text(one.signer)},
                   {"changes", text(one.changes)},
                   {"digest", one.digest}});
  return all;
}

Json segment_json(const ReportSegment& s) {
  return {{"vessel", s.vessel},
          {"vessel_name", text(s.vessel_name)},
          {"label", text(s.label)},
          {"from_mm", number(s.from_mm)},
          {"to_mm", number(s.to_mm)},
          {"length_mm", number(s.to_mm - s.from_mm)},
          {"mean_diameter_mm", number(s.mean_diameter_mm)},
          {"least_diameter_mm", number(s.least_diameter_mm)},
          {"least_area_mm2", number(s.least_area_mm2)},
          {"volume_mm3", number(s.volume_mm3)},
          {"worst_stenosis", s.worst_stenosis > 0 ? Json(s.worst_stenosis) : Json()},
          {"worst_percent", number(s.worst_percent)},
          {"evaluable", grade_json(s.evaluable)},
          {"checked", s.checked},
          {"number", s.number > 0 ? Json(s.number) : Json()}};
}

Json stenosis_json(const ReportStenosis& one) {
  const analysis::Stenosis& s = one.stenosis;
  return {{"number", one.number},
          {"vessel", s.vessel},
          {"vessel_name", text(one.vessel_name)},
          {"segment", text(one.segment)},
          {"main_vessel", one.main_vessel},
          {"narrows", one.narrows},
          {"state", to_string(one.state)},
          {"comment", text(one.comment)},
          {"from_mm", number(s.from_mm)},
          {"to_mm", number(s.to_mm)},
          {"throat_mm", number(s.throat_mm)},
          {"length_mm", number(s.length_mm())},
          {"proximal_mm", number(s.proximal_mm)},
          {"distal_mm", number(s.distal_mm)},
          {"least_diameter_mm", number(s.least_diameter_mm)},
          {"least_area_mm2", number(s.least_area_mm2)},
          {"reference_diameter_mm", number(s.reference_diameter_mm)},
          {"reference_area_mm2", number(s.reference_area_mm2)},
          {"diameter_percent", number(s.diameter_percent)},
          {"area_percent", number(s.area_percent)},
          {"cad_rads", one.category ? Json(analysis::to_string(*one.category)) : Json()},
          {"graded", one.graded},
          {"not_graded", text(one.not_graded)},
          {"evaluable", grade_json(one.evaluable)},
          {"checked", one.checked},
          {"plaque", plaque_json(one.plaque)},
          {"remodelling_index", number(one.remodelling_index)},
          {"medina", one.medina.empty() ? Json() : Json(one.medina)},
          {"bifurcation", one.bifurcation.empty() ? Json() : text(one.bifurcation)},
          {"features", list_of(one.features, feature_json)},
          {"high_risk", one.high_risk}};
}

Json bifurcation_json(const ReportBifurcation& one) {
  const analysis::MedinaClass& m = one.medina;
  return {{"main", m.main},
          {"side", m.side},
          {"main_name", text(one.main_name)},
          {"side_name", text(one.side_name)},
          {"joint_mm", number(m.joint_mm)},
          {"ostium_mm", number(m.ostium_mm)},
          {"medina", to_string(m)},
          {"proximal_percent", number(m.proximal_percent)},
          {"distal_percent", number(m.distal_percent)},
          {"side_percent", number(m.side_percent)}};
}

Json measurement_json(const ReportMeasurement& m) {
  Json values = Json::array();
  for (const analysis::MeasuredValue& value : m.values)
    values.push_back({{"name", value.name}, {"value", number(value.value)}, {"unit", value.unit}});
  return {{"id", m.measurement.id},
          {"kind", analysis::to_string(m.measurement.kind)},
          {"name", text(m.measurement.name)},
          {"vessel", needs_vessel(m.measurement) ? Json(m.measurement.vessel) : Json()},
          {"vessel_name", text(m.vessel_name)},
          {"values", values},
          {"problem", text(m.problem)}};
}

Json step_json(const ReportStep& step) {
  return {{"number", step.number},
          {"op", step.op},
          {"words", text(step.words)},
          {"vessel_name", text(step.vessel)},
          {"notes", texts(step.notes)}};
}

/// A line of a CSV file.
class Line {
 public:
  Line& add(const std::string& cell) {
    if (!line_.empty() || !first_) line_ += ',';
    first_ = false;
    line_ += core::csv_cell(core::redacted(cell));
    return *this;
  }
  /// What a person wrote: never a spreadsheet's formula.
  Line& free(const std::string& cell) {
    const bool formula = !cell.empty() && std::string("=+-@\t\r").find(cell[0]) != std::string::npos;
    return add(formula ? "'" + cell : cell);
  }
  Line& add(double value, int decimals) {
    return add(std::isfinite(value) ? core::shown_text(value, decimals) : "");
  }
  Line& add(const std::optional<double>& value, int decimals) {
    return add(value ? core::shown_text(*value, decimals) : "");
  }
  std::string end() const { return line_ + "\r\n"; }

 private:
  std::string line_;
  bool first_ = true;
};

/// Columns of plaque.csv from the stretch on.
void add_plaque(Line& line, const ReportPlaque& plaque) {
  const analysis::PlaqueVolumes& v = plaque.volumes;
  line.add(plaque.from_mm, 3).add(plaque.to_mm, 3).add(v.lumen_mm3, 3).add(v.vessel_mm3, 3);
  line.add(v.thin_wall_mm3, 3).add(v.plaque_mm3(), 3);
  for (const double volume : v.class_mm3) line.add(volume, 3);
  line.add(v.burden_percent(), 2).add(100.0 * plaque.seen_share, 1);
}

std::string counted_features(const ReportStenosis& one) {
  std::string text;
  for (const ReportFeature& feature : one.features)
    if (feature.counts) text += (text.empty() ? "" : "; ") + analysis::to_string(feature.finding.feature);
  return text;
}

std::string yes_no(bool value) {
  return value ? "yes" : "no";
}

}  // namespace

std::string report_json(const CaseReport& report, const std::vector<KeyImage>& images) {
  const ReportOptions& o = report.options;
  Json image;
  if (o.image)
    image = {{"pseudonym", o.image->pseudonym}, {"sha256", o.image->sha256}, {"at_hand", report.has_image}};
  if (o.image && !o.image->axes.empty()) image["axes"] = o.image->axes;
  const Json out{
      {"v", 1},
      {"kind", "case report"},
      {"program", {{"name", "ostia"}, {"version", report.program_version}}},
      {"date", o.date.empty() ? Json() : text(o.date)},
      {"image", image},
      {"model_digest", report.model_digest},
      {"cad_rads", cad_rads_json(report)},
      {"impression",
       {{"text", text(report.impression)},
        {"by_person", report.impression_by_person},
        {"draft", text(report.impression_draft)}}},
      {"dominance",
       {{"value", analysis::to_string(report.dominance)}, {"by_reader", report.dominance_by_reader}}},
      {"technique", technique_json(o.technique)},
      {"not_found", texts(report.not_found)},
      {"quality", quality_json(report.quality)},
      {"options",
       {{"profile_step_mm", o.profile.step_mm},
        {"profile_around", o.profile.around},
        {"reference_window_mm", o.reference.window_mm},
        {"least_percent", o.stenosis.least_percent},
        {"least_length_mm", o.stenosis.least_length_mm},
        {"least_graded_mm", o.least_graded_mm},
        {"medina_region_mm", o.medina.region_mm},
        {"medina_least_percent", o.medina.least_percent},
        {"medina_least_side_mm", o.medina.least_side_mm},
        {"low_attenuation_hu", o.walls.plaque.low_attenuation_hu},
        {"fibrofatty_hu", o.walls.plaque.fibrofatty_hu},
        {"fibrous_hu", o.walls.plaque.fibrous_hu},
        {"thin_wall_mm", o.walls.plaque.thin_wall_mm},
        {"healthy_margin_mm", o.walls.plaque.healthy_margin_mm},
        {"blur_sigma_mm", o.walls.plaque.blur_sigma_mm},
        {"least_low_mm3", o.high_risk.least_low_mm3},
        {"least_remodelling", o.high_risk.least_remodelling},
        {"spot_mm", o.high_risk.spot_mm},
        {"least_spot_mm3", o.high_risk.least_spot_mm3},
        {"ring_deg", o.high_risk.ring_deg},
        {"ring_mm", o.high_risk.ring_mm}}},
      {"all_checked", report.unchecked().empty()},
      {"vessels", list_of(report.vessels, vessel_json)},
      {"segments", list_of(report.segments, segment_json)},
      {"standard_segments", list_of(report.standard_segments, standard_json)},
      {"stenoses", list_of(report.stenoses, stenosis_json)},
      {"bifurcations", list_of(report.bifurcations, bifurcation_json)},
      {"measurements", list_of(report.measurements, measurement_json)},
      {"versions", versions_json(report.notes)},
      {"signed", report.is_signed},
      {"steps", list_of(report.steps, step_json)},
      {"images",
       list_of(images,
               [](const KeyImage& one) {
                 return Json{{"file", "images/" + one.name + ".png"}, {"caption", text(one.caption)}};
               })},
      {"warnings", texts(report.warnings)}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string segments_csv(const CaseReport& report) {
  std::string all =
      "vessel,segment,from_mm,to_mm,length_mm,mean_diameter_mm,least_diameter_mm,least_area_mm2,volume_mm3,"
      "worst_stenosis,worst_percent,evaluable,checked\r\n";
  for (const ReportSegment& s : report.segments)
    all += Line()
               .free(s.vessel_name)
               .free(s.label)
               .add(s.from_mm, 3)
               .add(s.to_mm, 3)
               .add(s.to_mm - s.from_mm, 3)
               .add(s.mean_diameter_mm, 4)
               .add(s.least_diameter_mm, 4)
               .add(s.least_area_mm2, 4)
               .add(s.volume_mm3, 3)
               .add(s.worst_stenosis > 0 ? "S" + std::to_string(s.worst_stenosis) : "")
               .add(s.worst_stenosis > 0 ? core::shown_text(s.worst_percent, 2) : "")
               .add(s.evaluable ? analysis::to_string(s.evaluable->grade) : "")
               .add(yes_no(s.checked))
               .end();
  return all;
}

std::string stenoses_csv(const CaseReport& report) {
  std::string all =
      "stenosis,vessel,segment,main_vessel,from_mm,to_mm,throat_mm,length_mm,least_diameter_mm,least_area_"
      "mm2,"
      "reference_diameter_mm,reference_area_mm2,diameter_percent,area_percent,cad_rads,graded,evaluable,"
      "checked,narrows,plaque_mm3,plaque_type,state,comment,high_risk,high_risk_features\r\n";
  for (const ReportStenosis& one : report.stenoses) {
    const analysis::Stenosis& s = one.stenosis;
    all += Line()
               .add(label(one))
               .free(one.vessel_name)
               .free(one.segment)
               .add(one.main_vessel)
               .add(s.from_mm, 3)
               .add(s.to_mm, 3)
               .add(s.throat_mm, 3)
               .add(s.length_mm(), 3)
               .add(s.least_diameter_mm, 4)
               .add(s.least_area_mm2, 4)
               .add(s.reference_diameter_mm, 4)
               .add(s.reference_area_mm2, 4)
               .add(s.diameter_percent, 2)
               .add(s.area_percent, 2)
               .add(one.category ? analysis::to_string(*one.category) : "")
               .add(yes_no(one.graded))
               .add(one.evaluable ? analysis::to_string(one.evaluable->grade) : "")
               .add(yes_no(one.checked))
               .add(yes_no(one.narrows))
               .add(one.plaque ? std::optional(one.plaque->volumes.plaque_mm3()) : std::nullopt, 3)
               .add(one.plaque ? to_string(analysis::plaque_type(one.plaque->volumes)) : "")
               .add(to_string(one.state))
               .free(one.comment)
               .add(yes_no(one.high_risk))
               .add(counted_features(one))
               .end();
  }
  return all;
}

std::string plaque_csv(const CaseReport& report) {
  std::string all =
      "vessel,stenosis,from_mm,to_mm,lumen_mm3,vessel_mm3,thin_wall_mm3,plaque_mm3,low_attenuation_mm3,"
      "fibrofatty_mm3,fibrous_mm3,calcified_mm3,burden_percent,outer_wall_seen_percent,remodelling_index\r\n";
  for (const ReportVessel& vessel : report.vessels) {
    if (!vessel.plaque) continue;
    Line line;
    add_plaque(line.free(vessel.name).add(""), *vessel.plaque);
    all += line.add("").end();
    for (const ReportStenosis& one : report.stenoses) {
      if (one.stenosis.vessel != vessel.id || !one.plaque) continue;
      Line of_stenosis;
      add_plaque(of_stenosis.free(vessel.name).add(label(one)), *one.plaque);
      all += of_stenosis.add(one.remodelling_index, 3).end();
    }
  }
  return all;
}

std::string measurements_csv(const CaseReport& report) {
  std::string all = "measurement,kind,name,vessel,quantity,value,unit,problem\r\n";
  for (const ReportMeasurement& m : report.measurements) {
    const auto begin = [&] {
      Line line;
      line.add(std::to_string(m.measurement.id)).add(analysis::to_string(m.measurement.kind));
      line.free(m.measurement.name).free(m.vessel_name);
      return line;
    };
    if (m.values.empty()) all += begin().add("").add("").add("").add(m.problem).end();
    for (const analysis::MeasuredValue& value : m.values)
      all += begin().add(value.name).add(value.value, 4).add(value.unit).add("").end();
  }
  return all;
}

}  // namespace ostia::session
