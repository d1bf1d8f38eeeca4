#include "pressure/pressure_uncertainty_files.h"

#include "ostia/core/csv.h"
#include "ostia/core/text.h"

namespace ostia::session {
namespace {

using UncertainJson = nlohmann::ordered_json;
using hemodynamics::Distribution;
using hemodynamics::InputGroup;
using hemodynamics::SobolIndices;

UncertainJson distribution_json(const Distribution& of, double unit, bool with_probability) {
  if (!of.known) return nullptr;
  UncertainJson out{{"median", of.median * unit},
                    {"low", of.low * unit},
                    {"high", of.high * unit},
                    {"mean", of.mean * unit},
                    {"sd", of.sd * unit}};
  if (with_probability) out["probability"] = of.probability;
  return out;
}

UncertainJson sobol_json(const PressureReport& report, const hemodynamics::UncertainReading& of) {
  if (!of.ratio.known || !report.options.uncertainty->indices) return nullptr;
  UncertainJson out = UncertainJson::object();
  for (std::size_t g = 0; g < hemodynamics::input_groups; ++g)
    out[std::string(hemodynamics::name_of(static_cast<InputGroup>(g)))] = {{"first", of.indices.first[g]},
                                                                           {"total", of.indices.total[g]}};
  return out;
}

/// What was used, as options.
hemodynamics::UncertaintyOptions used_options(const PressureReport& report) {
  hemodynamics::UncertaintyOptions options = *report.options.uncertainty;
  options.spreads = report.uncertainty->spreads;
  return options;
}

void add_sobol_rows(const std::string& kind, const std::string& name, const SobolIndices& of,
                    std::string& text) {
  for (std::size_t g = 0; g < hemodynamics::input_groups; ++g)
    text += core::csv_line({kind, name, std::string(hemodynamics::name_of(static_cast<InputGroup>(g))),
                            core::fixed_text(of.first[g], 3), core::fixed_text(of.total[g], 3)});
}

}  // namespace

nlohmann::ordered_json uncertainty_of_report(const PressureReport& report) {
  const auto& of = *report.uncertainty;
  UncertainJson lesions = UncertainJson::array(), outlets = UncertainJson::array();
  for (std::size_t i = 0; i < of.lesions.size(); ++i)
    lesions.push_back({{"name", report.tree.lesions[i].name},
                       {"ffr", distribution_json(of.lesions[i].ratio, 1.0, true)},
                       {"delta_ffr", distribution_json(of.lesion_falls[i], 1.0, false)},
                       {"sobol", sobol_json(report, of.lesions[i])}});
  for (std::size_t k = 0; k < of.outlets.size(); ++k)
    outlets.push_back({{"branch", of.outlets[k].place.branch},
                       {"ffr", distribution_json(of.outlets[k].ratio, 1.0, true)},
                       {"hyperaemic_ml_min", distribution_json(of.outlet_flow_ml_s[k], 60.0, false)},
                       {"sobol", sobol_json(report, of.outlets[k])}});
  return {{"settings", UncertainJson::parse(hemodynamics::uncertainty_json(used_options(report)))},
          {"trees", of.trees},
          {"failed", of.failed},
          {"lesions", std::move(lesions)},
          {"outlets", std::move(outlets)}};
}

std::string uncertain_conditions_json(const PressureReport& report) {
  UncertainJson all = UncertainJson::parse(hemodynamics::conditions_json(report.options.conditions));
  if (report.uncertainty)
    all["uncertainty"] = UncertainJson::parse(hemodynamics::uncertainty_json(used_options(report)));
  return all.dump(1) + "\n";
}

std::string sobol_csv(const PressureReport& report) {
  std::string text = core::csv_line({"of", "name", "inputs", "first", "total"});
  const auto& of = *report.uncertainty;
  for (std::size_t i = 0; i < of.lesions.size(); ++i)
    if (of.lesions[i].ratio.known)
      add_sobol_rows("lesion", report.tree.lesions[i].name, of.lesions[i].indices, text);
  for (const auto& outlet : of.outlets)
    if (outlet.ratio.known)
      add_sobol_rows("outlet", report.tree.network.branches[outlet.place.branch].name, outlet.indices, text);
  return text;
}

std::vector<std::string> uncertain_columns(const PressureReport& report) {
  if (!report.uncertainty) return {};
  return {"ffr_median", "ffr_low", "ffr_high", "ffr_probability"};
}

std::vector<std::string> uncertain_cells(const PressureReport& report, const Distribution& ratio) {
  if (!report.uncertainty) return {};
  if (!ratio.known) return {"", "", "", ""};
  return {core::fixed_text(ratio.median, 4), core::fixed_text(ratio.low, 4), core::fixed_text(ratio.high, 4),
          core::fixed_text(ratio.probability, 3)};
}

std::vector<std::string> joined_cells(std::vector<std::string> cells, const std::vector<std::string>& more) {
  cells.insert(cells.end(), more.begin(), more.end());
  return cells;
}

}  // namespace ostia::session
