#include "pressure/pressure_after_files.h"
#include "pressure/pressure_uncertainty_files.h"

#include "ostia/session/pressure_report.h"

#include <nlohmann/json.hpp>

namespace ostia::session {
namespace {

using Json = nlohmann::ordered_json;
using hemodynamics::Branch;
using hemodynamics::pa_of_mmhg;
using hemodynamics::TreePlace;

constexpr double ml_min = 60.0;

Json place_json(const PressureReport& report, const TreePlace& place) {
  const Branch& branch = report.tree.network.branches[place.branch];
  return {{"branch", place.branch}, {"vessel", branch.vessel}, {"s_mm", place.s_mm}};
}

Json branches_json(const PressureReport& report) {
  Json all = Json::array();
  const auto& network = *report.network;
  for (std::size_t b = 0; b < network.size(); ++b) {
    const Branch& branch = network.network().branches[b];
    const bool beyond = network.beyond_occlusion(b);
    const auto pressure = [&](double pa) { return beyond ? Json() : Json(pa / pa_of_mmhg); };
    all.push_back({{"index", b},
                   {"segment", branch.segment},
                   {"vessel", branch.vessel},
                   {"name", branch.name},
                   {"parent", branch.parent},
                   {"from_mm", branch.stations.empty() ? Json() : Json(branch.stations.front().s_mm)},
                   {"to_mm", branch.stations.empty() ? Json() : Json(branch.stations.back().s_mm)},
                   {"occluded", beyond},
                   {"rest_ml_min", report.rest.solution.flow_ml_s[b] * ml_min},
                   {"hyperaemic_ml_min", report.hyperaemia.solution.flow_ml_s[b] * ml_min},
                   {"from_mmhg", pressure(report.hyperaemia.solution.from_pa[b])},
                   {"to_mmhg", pressure(report.hyperaemia.solution.to_pa[b])}});
  }
  return all;
}

Json lesions_json(const PressureReport& report) {
  Json all = Json::array();
  const auto& hyperaemic = report.under_hyperaemia.lesions;
  for (std::size_t i = 0; i < hyperaemic.size(); ++i) {
    const auto& one = hyperaemic[i];
    const auto& rest = report.at_rest.lesions[i];
    const auto unless_occluded = [&](double value) { return one.occluded ? Json() : Json(value); };
    Json lesion{{"name", one.lesion.name},
                {"vessel_name", report.tree.network.branches[one.lesion.throat.branch].name},
                {"from", place_json(report, one.lesion.from)},
                {"throat", place_json(report, one.lesion.throat)},
                {"to", place_json(report, one.lesion.to)},
                {"read_at", place_json(report, one.read_at)},
                {"behind_mm", one.distance_mm},
                {"occluded", one.occluded},
                {"before", unless_occluded(one.before)},
                {"ffr", unless_occluded(one.behind)},
                {"delta_ffr", unless_occluded(one.delta())},
                {"resting_pd_pa", unless_occluded(rest.behind)},
                {"significant", one.occluded || one.behind <= report.options.reading.threshold}};
    if (report.pulse)
      lesion["pulse"] = {{"resting_pd_pa", unless_occluded(report.pulse->places[i].mean_ratio)},
                         {"wave_free_ratio", unless_occluded(report.pulse->places[i].wave_free_ratio)}};
    all.push_back(std::move(lesion));
  }
  return all;
}

Json outlets_json(const PressureReport& report) {
  Json all = Json::array();
  const auto& network = *report.network;
  const auto& outlets = network.outlets();
  for (std::size_t k = 0; k < outlets.size(); ++k) {
    const Branch& branch = network.network().branches[outlets[k]];
    const auto& pullback = report.under_hyperaemia.pullbacks[k];
    const bool beyond = network.beyond_occlusion(outlets[k]);
    const auto ratio = hemodynamics::outlet_ratio(network, report.under_hyperaemia, k);
    const double rest = report.rest.solution.flow_ml_s[outlets[k]];
    const double hyperaemic = report.hyperaemia.solution.flow_ml_s[outlets[k]];
    all.push_back({{"branch", outlets[k]},
                   {"vessel", branch.vessel},
                   {"name", branch.name},
                   {"diameter_mm", hemodynamics::outlet_diameter_mm(branch)},
                   {"asked_ml_min", report.resting.outlets_ml_s[k] * ml_min},
                   {"rest_ml_min", rest * ml_min},
                   {"hyperaemic_ml_min", hyperaemic * ml_min},
                   {"flow_reserve", rest > 0.0 ? Json(hyperaemic / rest) : Json()},
                   {"ffr", ratio ? Json(*ratio) : Json()},
                   {"ppg_index", beyond ? Json() : Json(pullback.ppg_index)},
                   {"greatest_fall_20mm", beyond ? Json() : Json(pullback.greatest_fall_20mm)},
                   {"occluded", beyond}});
  }
  return all;
}

Json marks_json(const PressureReport& report) {
  Json all = Json::array();
  for (const auto& mark : report.under_hyperaemia.marks)
    all.push_back({{"kind", hemodynamics::name_of(mark.kind)},
                   {"place", place_json(report, mark.place)},
                   {"text", mark.text}});
  return all;
}

}  // namespace

std::string pressure_json(const PressureReport& report) {
  Json root{{"v", 1},
            {"kind", "ffr"},
            {"research_use", hemodynamics::research_use},
            {"aortic_mmhg", report.under_hyperaemia.aortic_pa / pa_of_mmhg},
            {"flow",
             {{"source", hemodynamics::name_of(report.resting.source)},
              {"asked_ml_min", report.resting.total_ml_s * ml_min},
              {"notes", report.resting.notes}}},
            {"threshold", report.options.reading.threshold},
            {"branches", branches_json(report)},
            {"lesions", lesions_json(report)},
            {"outlets", outlets_json(report)},
            {"marks", marks_json(report)}};
  if (report.pulse)
    root["pulse"] = {{"heart_rate_bpm", report.options.conditions.heart_rate_bpm},
                     {"beats", report.pulse->beats},
                     {"change_pa", report.pulse->change_pa}};
  if (report.after) root["what_if"] = what_if_json(report);
  if (report.uncertainty) root["uncertainty"] = uncertainty_of_report(report);
  root["conditions"] = Json::parse(hemodynamics::conditions_json(report.options.conditions));
  root["warnings"] = report.warnings;
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ostia::session
