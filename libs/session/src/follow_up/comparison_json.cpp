#include "follow_up/comparison_parts.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/session/comparison.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::session {
namespace {

using analysis::ChangeMeasure;
using analysis::ChangeScope;
using analysis::Difference;
using CompareJson = nlohmann::ordered_json;

CompareJson compared_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? CompareJson(*value) : CompareJson(nullptr);
}

CompareJson difference_json(const Difference& one) {
  return {{"before", compared_number(one.before)},
          {"after", compared_number(one.after)},
          {"change", compared_number(one.change())},
          {"smallest_real", compared_number(one.smallest_real)},
          {"verdict", analysis::to_string(one.verdict())}};
}

CompareJson measures_json(const analysis::StretchChange& change) {
  CompareJson out = CompareJson::object();
  for (const ChangeMeasure measure : analysis::change_measures)
    if (const Difference& one = analysis::of(change, measure); one.before || one.after)
      out[analysis::key_of(measure)] = difference_json(one);
  return out;
}

CompareJson stretch_json(const std::optional<analysis::PlacedStretch>& stretch) {
  if (!stretch) return nullptr;
  return {{"vessel", stretch->vessel}, {"from_mm", stretch->from_mm}, {"to_mm", stretch->to_mm}};
}

CompareJson labels_json(const std::vector<std::size_t>& which, const ComparedCase& of) {
  CompareJson out = CompareJson::array();
  for (const std::size_t i : which) out.push_back(of.tree.lesions[i].label);
  return out;
}

CompareJson case_json_of(const ComparedCase& one) {
  return {{"model", one.model_digest},
          {"image", one.image ? CompareJson(one.image->sha256) : CompareJson(nullptr)},
          {"pseudonym", one.image ? CompareJson(one.image->pseudonym) : CompareJson(nullptr)},
          {"image_at_hand", one.has_image},
          {"tube_kv", compared_number(one.tube_kv)},
          {"lesions", one.tree.lesions.size()}};
}

CompareJson map_json(const Comparison& made) {
  CompareJson landmarks = CompareJson::array();
  for (std::size_t i = 0; i < made.fit.landmarks.size(); ++i)
    landmarks.push_back(
        {{"name", made.fit.landmarks[i].name}, {"residual_mm", made.fit.landmark_residuals_mm[i]}});
  CompareJson rotation = CompareJson::array();
  for (int r = 0; r < 3; ++r)
    rotation.push_back(
        {made.fit.motion.rotation(r, 0), made.fit.motion.rotation(r, 1), made.fit.motion.rotation(r, 2)});
  const geometry::Vec3& shift = made.fit.motion.shift;
  return {{"is", made.map_words},
          {"rigid", {{"rotation", rotation}, {"shift_mm", {shift.x(), shift.y(), shift.z()}}}},
          {"axes_mm", made.fit.axes_mm},
          {"mirrored_mm", made.fit.mirrored_mm},
          {"shared_share", made.change.match.shared_share},
          {"landmarks", landmarks}};
}

CompareJson placed_json(const std::vector<analysis::PlacedChange>& all) {
  CompareJson out = CompareJson::array();
  for (const analysis::PlacedChange& one : all)
    out.push_back({{"label", one.label},
                   {"covered_share", one.covered_share},
                   {"before", stretch_json(one.before_stretch)},
                   {"after", stretch_json(one.after_stretch)},
                   {"measures", measures_json(one.change)}});
  return out;
}

std::string cell_of(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? core::significant_text(*value, 6) : std::string();
}

}  // namespace

std::string repeatability_json(const analysis::Repeatability& table) {
  CompareJson out{{"from", table.from}};
  for (const ChangeScope scope : analysis::change_scopes) {
    CompareJson measures = CompareJson::object();
    for (const ChangeMeasure measure : analysis::change_measures)
      if (const auto& one = table.of(scope, measure); one.sd > 0.0 || one.share > 0.0)
        measures[analysis::key_of(measure)] = {{"sd", one.sd}, {"share", one.share}};
    out[analysis::key_of(scope)] = measures;
  }
  return out.dump();
}

std::string comparison_json(const Comparison& made) {
  CompareJson vessels = CompareJson::array(), lesions = CompareJson::array();
  for (const analysis::VesselMatch& one : made.change.match.vessels)
    vessels.push_back({{"before", one.before},
                       {"before_name", compared_vessel_name(made.before, one.before)},
                       {"after", one.after},
                       {"after_name", compared_vessel_name(made.after, one.after)},
                       {"by_name", one.by_name},
                       {"distance_mm", one.distance_mm},
                       {"shared_mm", one.shared_mm}});
  for (const analysis::LesionChange& one : made.change.lesions)
    lesions.push_back({{"fate", analysis::to_string(one.fate)},
                       {"vessel", one.vessel_name},
                       {"segment", one.segment},
                       {"before", labels_json(one.before, made.before)},
                       {"after", labels_json(one.after, made.after)},
                       {"before_stretch", stretch_json(one.before_stretch)},
                       {"after_stretch", stretch_json(one.after_stretch)},
                       {"measures", measures_json(one.change)}});
  const CompareJson out{{"v", 1},
                        {"kind", "comparison"},
                        {"before", case_json_of(made.before)},
                        {"after", case_json_of(made.after)},
                        {"map", map_json(made)},
                        {"one_patient", made.another_patient.empty()},
                        {"vessels_matched", vessels},
                        {"lesions", lesions},
                        {"segments", placed_json(made.change.segments)},
                        {"vessels", placed_json(made.change.vessels)},
                        {"patient", measures_json(made.change.patient)},
                        {"unmatched", made.change.unmatched},
                        {"repeatability", CompareJson::parse(repeatability_json(made.repeatability))},
                        {"warnings", made.warnings}};
  return out.dump(2) + "\n";
}

std::vector<std::string> difference_cells(const Difference& one) {
  return {cell_of(one.before), cell_of(one.after), cell_of(one.change()), cell_of(one.smallest_real),
          analysis::to_string(one.verdict())};
}

std::string comparison_csv(const Comparison& made) {
  std::string out = core::csv_line(
      {"scope", "label", "fate", "measure", "before", "after", "change", "smallest_real", "verdict"});
  const auto add = [&](ChangeScope scope, const std::string& label, const std::string& fate,
                       const analysis::StretchChange& change) {
    for (const ChangeMeasure measure : analysis::change_measures) {
      const Difference& one = analysis::of(change, measure);
      if (!one.before && !one.after) continue;
      std::vector<std::string> cells{analysis::key_of(scope), label, fate, analysis::key_of(measure)};
      const std::vector<std::string> values = difference_cells(one);
      cells.insert(cells.end(), values.begin(), values.end());
      out += core::csv_line(cells);
    }
  };
  for (const analysis::LesionChange& one : made.change.lesions)
    add(ChangeScope::lesion, compared_label(made, one), analysis::to_string(one.fate), one.change);
  for (const analysis::PlacedChange& one : made.change.segments)
    add(ChangeScope::segment, one.label, "", one.change);
  for (const analysis::PlacedChange& one : made.change.vessels)
    add(ChangeScope::vessel, one.label, "", one.change);
  add(ChangeScope::patient, "patient", "", made.change.patient);
  return out;
}

analysis::Repeatability repeatability_of_json(const std::string& text, const std::string& file) {
  const auto refuse = [&](const std::string& what) -> analysis::Repeatability {
    throw InvalidInput(file + ": " + what +
                       "; give the cohort.json that ostia compare --pairs has made of unchanged patients");
  };
  const CompareJson json = CompareJson::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("repeatability") || !json["repeatability"].is_object())
    return refuse("no object \"repeatability\"");
  const CompareJson& all = json["repeatability"];
  analysis::Repeatability table;
  table.from = all.contains("from") && all["from"].is_string() ? all["from"].get<std::string>()
                                                               : std::string("a file");
  for (const ChangeScope scope : analysis::change_scopes) {
    const std::string name = analysis::key_of(scope);
    if (!all.contains(name)) continue;
    if (!all[name].is_object()) return refuse("repeatability." + name + " is no object");
    for (const ChangeMeasure measure : analysis::change_measures) {
      const std::string key = analysis::key_of(measure);
      if (!all[name].contains(key)) continue;
      const CompareJson& one = all[name][key];
      const auto number = [&](const char* member) {
        return one.is_object() && one.contains(member) && one[member].is_number() ? one[member].get<double>()
                                                                                  : std::nan("");
      };
      const analysis::DifferenceSpread spread{number("sd"), number("share")};
      if (!(spread.sd >= 0.0 && spread.share >= 0.0))
        return refuse("repeatability." + name + "." + key + " has no \"sd\" and \"share\" from 0 on");
      table.of(scope, measure) = spread;
    }
  }
  return table;
}

}  // namespace ostia::session
