#include "report/case_report_text.h"

#include "ostia/core/quantity_text.h"
#include "ostia/session/annotation_json.h"
#include "ostia/session/edit_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace ostia::session::report_text {
namespace {

using ReportJson = nlohmann::json;

struct OpWords {
  const char *op, *words;
};
constexpr std::array<OpWords, 30> kWords{{
    {"case.begin", "case begun"},
    {"cpr.stroke", "wall drawn on a curved reformation"},
    {"section.contour", "contour drawn on a cross-section"},
    {"wall.drag", "wall dragged"},
    {"wall.push", "wall pushed with the brush"},
    {"axis.move", "centerline moved"},
    {"axis.insert", "centerline point added"},
    {"axis.delete", "centerline point deleted"},
    {"axis.extend", "vessel extended"},
    {"axis.trim", "vessel trimmed"},
    {"branch.add", "vessel added"},
    {"branch.delete", "vessel deleted"},
    {"branch.attach", "vessel attached elsewhere"},
    {"branch.split", "vessel split"},
    {"branch.merge", "vessel joined with its parent"},
    {"branch.cut", "vessel cut in two trees"},
    {"branch.connect", "vessel connected by a new piece"},
    {"vessel.rename", "vessel renamed"},
    {"vessel.add", "vessel with an ostium of its own added"},
    {"measure.add", "measurement added"},
    {"measure.change", "measurement changed"},
    {"measure.delete", "measurement deleted"},
    {"vessel.mark", "vessel's mark set"},
    {"plugin", "edited by a plug-in"},
    {"pressure.inputs", "inputs of the computed pressures set"},
    {"pressure.what_if", "stretches with another calibre, for the computed pressures, set"},
    {"report.impression", "impression of the report written"},
    {"report.modifiers", "modifiers of CAD-RADS set"},
    {"report.features", "word on features of plaque given"},
    {"report.sign", "report signed"},
}};

std::string text_at(const ReportJson& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool flag_at(const ReportJson& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_boolean() && found->get<bool>();
}

/// What tells this step from others of its kind.
std::string detail_of(const std::string& op, const ReportJson& given) {
  if (op == "vessel.mark") return flag_at(given, "checked") ? ": checked" : ": not checked";
  if (op == "plugin") return ": " + plugin_named_in(given.dump());
  if (op == "vessel.rename" || op == "branch.add" || op == "vessel.add") return ": " + text_at(given, "name");
  if (op.rfind("measure.", 0) == 0) {
    std::string detail = kind_words(text_at(given, "kind"));
    const std::string name = text_at(given, "name");
    if (!name.empty()) detail += " \"" + name + "\"";
    return detail.empty() ? detail : ": " + detail;
  }
  const auto at = given.find("s_mm");
  return at != given.end() && at->is_number() ? " at " + core::length_text(at->get<double>()) + " mm"
                                              : std::string();
}

/// The vessel that a step names; a measurement of points has none.
std::optional<std::int32_t> vessel_of(const std::string& op, const ReportJson& given) {
  const auto found = given.find(op == "branch.add" ? "parent" : "vessel");
  if (found == given.end() || !found->is_number_integer()) return std::nullopt;
  if (op == "measure.add" || op == "measure.change") {
    const AnnotationCommand command = annotation_of_json(given.dump());
    const auto* added = std::get_if<MeasureAdd>(&command);
    const auto* changed = std::get_if<MeasureChange>(&command);
    if (added && !needs_vessel(added->measurement)) return std::nullopt;
    if (changed && !needs_vessel(changed->measurement)) return std::nullopt;
  }
  return found->get<std::int32_t>();
}

}  // namespace

std::string percent(double value) {
  return core::stenosis_text(value);
}

std::string label(const ReportStenosis& stenosis) {
  return "S" + std::to_string(stenosis.number);
}

std::string kind_words(const std::string& kind) {
  for (const analysis::MeasureKind one : analysis::measure_kinds)
    if (kind == analysis::traits_of(one).name) return std::string(analysis::traits_of(one).label);
  return kind;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string grade(const analysis::EvaluableStretch& stretch) {
  return analysis::to_string(stretch.grade) + (stretch.by_person ? " (reader)" : "");
}

std::string reasons(const analysis::EvaluableStretch& stretch) {
  std::string text;
  for (const analysis::EvaluabilityReason reason : stretch.reasons)
    text += (text.empty() ? "" : ", ") + analysis::to_string(reason);
  return text;
}

std::string vessel_name(const lumen::LumenModel& model, std::int32_t id) {
  for (const geometry::Vessel& vessel : model.tree.vessels)
    if (vessel.id == id) return vessel.name;
  return "vessel " + std::to_string(id) + " (deleted)";
}

ReportStep step_of(const JournalEntry& entry, const lumen::LumenModel& model) {
  ReportStep step{entry.number, entry.op, entry.op, {}, entry.notes};
  const auto known =
      std::find_if(kWords.begin(), kWords.end(), [&](const OpWords& one) { return entry.op == one.op; });
  if (known != kWords.end()) step.words = known->words;
  const ReportJson given = ReportJson::parse(entry.parameters, nullptr, false);
  if (!given.is_object()) return step;
  step.words += detail_of(entry.op, given);
  if (const auto vessel = vessel_of(entry.op, given)) step.vessel = vessel_name(model, *vessel);
  return step;
}

}  // namespace ostia::session::report_text

namespace ostia::session {

std::optional<std::int32_t> vessel_of_step(const JournalEntry& step) {
  const auto given = report_text::ReportJson::parse(step.parameters, nullptr, false);
  return given.is_object() ? report_text::vessel_of(step.op, given) : std::nullopt;
}

}  // namespace ostia::session
