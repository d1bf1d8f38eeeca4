#include "pressure/pressure_after_files.h"

#include "ostia/core/csv.h"
#include "ostia/core/text.h"

namespace ostia::session {
namespace {

using Json = nlohmann::ordered_json;
using core::fixed_text;
using hemodynamics::outlet_ratio;

std::string name_of_vessel(const PressureReport& report, std::int32_t vessel) {
  const auto found = report.tree.vessels.find(vessel);
  return found == report.tree.vessels.end() ? std::string() : found->second.name;
}

Json ratio_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

std::string ratio_csv(const std::optional<double>& value) {
  return value ? fixed_text(*value, 4) : std::string();
}

std::optional<double> unless_shut(const hemodynamics::LesionReading& reading, double value) {
  return reading.occluded ? std::nullopt : std::optional(value);
}

}  // namespace

Json what_if_json(const PressureReport& report) {
  const PressureAfter& after = *report.after;
  Json stretches = Json::array(), lesions = Json::array(), outlets = Json::array();
  for (const WhatIf& one : report.options.what_ifs)
    stretches.push_back({{"vessel", one.vessel},
                         {"name", name_of_vessel(report, one.vessel)},
                         {"from_mm", one.from_mm},
                         {"to_mm", one.to_mm},
                         {"kind", to_string(one.kind)},
                         {"percent", one.percent}});
  for (const auto& one : after.under_hyperaemia.lesions)
    lesions.push_back({{"name", one.lesion.name},
                       {"occluded", one.occluded},
                       {"ffr", ratio_json(unless_shut(one, one.behind))},
                       {"delta_ffr", ratio_json(unless_shut(one, one.delta()))},
                       {"significant", one.occluded || one.behind <= report.options.reading.threshold}});
  for (std::size_t k = 0; k < after.network.outlets().size(); ++k)
    outlets.push_back(
        {{"branch", after.network.outlets()[k]},
         {"ffr", ratio_json(outlet_ratio(after.network, after.under_hyperaemia, k))},
         {"rest_ml_min", after.rest.solution.flow_ml_s[after.network.outlets()[k]] * 60.0},
         {"hyperaemic_ml_min", after.hyperaemia.solution.flow_ml_s[after.network.outlets()[k]] * 60.0}});
  return {{"stretches", stretches}, {"lesions", lesions}, {"outlets", outlets}};
}

std::string what_if_stations_csv(const PressureReport& report) {
  std::string text = core::csv_line(
      {"branch", "vessel", "name", "s_mm", "area_mm2", "area_what_if_mm2", "ffr", "ffr_what_if"});
  const PressureAfter& after = *report.after;
  const auto& branches = report.tree.network.branches;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const bool shut = report.network->beyond_occlusion(b), shut_after = after.network.beyond_occlusion(b);
    for (std::size_t i = 0; i < branches[b].stations.size(); ++i)
      text += core::csv_line(
          {std::to_string(b), std::to_string(branches[b].vessel), branches[b].name,
           fixed_text(branches[b].stations[i].s_mm, 3), fixed_text(branches[b].stations[i].area_mm2, 4),
           fixed_text(after.network.network().branches[b].stations[i].area_mm2, 4),
           shut ? std::string() : fixed_text(report.under_hyperaemia.ratio(b, i), 5),
           shut_after ? std::string() : fixed_text(after.under_hyperaemia.ratio(b, i), 5)});
  }
  return text;
}

std::string what_if_readings_csv(const PressureReport& report) {
  std::string text = core::csv_line(
      {"what", "name", "ffr", "ffr_what_if", "hyperaemic_ml_min", "hyperaemic_what_if_ml_min"});
  const PressureAfter& after = *report.after;
  const auto flow = [&](const hemodynamics::FlowState& state, std::size_t branch) {
    return fixed_text(state.solution.flow_ml_s[branch] * 60.0, 3);
  };
  for (std::size_t i = 0; i < after.under_hyperaemia.lesions.size(); ++i) {
    const auto &one = report.under_hyperaemia.lesions[i], &other = after.under_hyperaemia.lesions[i];
    const std::size_t branch = one.lesion.throat.branch;
    text += core::csv_line({"lesion", one.lesion.name, ratio_csv(unless_shut(one, one.behind)),
                            ratio_csv(unless_shut(other, other.behind)), flow(report.hyperaemia, branch),
                            flow(after.hyperaemia, branch)});
  }
  for (std::size_t k = 0; k < after.network.outlets().size(); ++k) {
    const std::size_t branch = after.network.outlets()[k];
    text += core::csv_line({"outlet", report.tree.network.branches[branch].name,
                            ratio_csv(outlet_ratio(*report.network, report.under_hyperaemia, k)),
                            ratio_csv(outlet_ratio(after.network, after.under_hyperaemia, k)),
                            flow(report.hyperaemia, branch), flow(after.hyperaemia, branch)});
  }
  return text;
}

}  // namespace ostia::session
