#include "ostia/hemodynamics/conditions.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::hemodynamics {
namespace {

constexpr std::array<ConditionInput, 15> inputs = {{
    {"systolic_mmhg", "mmHg", "systolic pressure by cuff", "measured; 120 where it is not told", 100, 150, 60,
     260, &Conditions::systolic_mmhg},
    {"diastolic_mmhg", "mmHg", "diastolic pressure by cuff", "measured; 80 where it is not told", 60, 95, 30,
     150, &Conditions::diastolic_mmhg},
    {"mean_share", "", "share of the pulse pressure in the mean pressure",
     "Bos et al. 2007, J Hypertens 25:751", 0.33, 0.45, 0.2, 0.6, &Conditions::mean_share},
    {"venous_mmhg", "mmHg", "pressure behind the beds", "usual value", 2, 10, 0, 30,
     &Conditions::venous_mmhg},
    {"heart_rate_bpm", "1/min", "heart rate, for the pulse", "measured; 70 where it is not told", 50, 90, 25,
     220, &Conditions::heart_rate_bpm},
    {"density_kg_m3", "kg/m3", "density of blood", "usual value", 1050, 1070, 1000, 1100,
     &Conditions::density_kg_m3},
    {"viscosity_mpa_s", "mPa s", "viscosity of blood at high shear", "usual value at a haematocrit of 45 %",
     3.0, 4.5, 1.5, 10, &Conditions::viscosity_mpa_s},
    {"rest_flow_ml_min", "ml/min", "flow of the whole tree at rest", "told", 100, 400, 10, 1500, nullptr,
     &Conditions::rest_flow_ml_min},
    {"lv_mass_g", "g", "mass of the left ventricle", "told, of the image", 80, 220, 30, 700, nullptr,
     &Conditions::lv_mass_g},
    {"rest_flow_ml_min_g", "ml/min/g", "flow at rest of a gram of heart muscle",
     "Chareonthaitawee et al. 2001, Cardiovasc Res 50:151", 0.6, 1.2, 0.2, 3.0,
     &Conditions::rest_flow_ml_min_g},
    {"supplied_share", "", "share of that muscle which the tree supplies",
     "told; 1 with both coronary arteries", 0.3, 1.0, 0.05, 1.0, nullptr, &Conditions::supplied_share},
    {"calibre_factor", "m3/s at 1 m", "flow of a vessel of one metre",
     "van der Giessen et al. 2011, J Biomech 44:1089", 1.0, 1.9, 0.3, 6.0, &Conditions::calibre_factor},
    {"calibre_exponent", "", "exponent of the diameter in a vessel's flow",
     "van der Giessen et al. 2011, J Biomech 44:1089", 2.4, 2.7, 2.0, 3.2, &Conditions::calibre_exponent},
    {"split_exponent", "", "exponent of the diameter by which a flow is shared",
     "van der Giessen et al. 2011, J Biomech 44:1089", 2.15, 2.5, 1.0, 4.0, &Conditions::split_exponent},
    {"hyperaemic_resistance", "", "resistance of the beds under adenosine over that at rest",
     "Wilson et al. 1990, Circulation 82:1595", 0.18, 0.35, 0.1, 1.0, &Conditions::hyperaemic_resistance},
}};

std::optional<double> told_value(const Conditions& conditions, const ConditionInput& input) {
  return input.value ? std::optional(conditions.*input.value) : conditions.*input.optional;
}

std::string sentence(const ConditionInput& input, double value) {
  const std::string unit = input.unit.empty() ? "" : " " + std::string(input.unit);
  return std::string(input.key) + " is " + core::shortest_text(value) + unit + ": the " +
         std::string(input.meaning) + " lies between " + core::shortest_text(input.least) + " and " +
         core::shortest_text(input.most) + unit;
}

/// The value below which `share` of the stretch's sections lie.
double quantile_diameter(std::vector<double> diameters, double share) {
  if (diameters.empty()) return 0.0;
  std::sort(diameters.begin(), diameters.end());
  return diameters[static_cast<std::size_t>(share * static_cast<double>(diameters.size() - 1) + 0.5)];
}

}  // namespace

std::span<const ConditionInput> condition_inputs() {
  return inputs;
}

std::vector<std::string> unusual_inputs(const Conditions& conditions) {
  std::vector<std::string> all;
  for (const ConditionInput& input : condition_inputs())
    if (const auto value = told_value(conditions, input);
        value && !(*value >= input.least && *value <= input.most))
      all.push_back(sentence(input, *value));
  return all;
}

void validate(const Conditions& conditions, bool unusual) {
  for (const ConditionInput& input : condition_inputs()) {
    const auto value = told_value(conditions, input);
    if (!value) continue;
    const bool zero_is_fine = input.key == "venous_mmhg";
    if (!std::isfinite(*value) || *value < 0.0 || (*value == 0.0 && !zero_is_fine))
      throw InvalidInput(std::string(input.key) + " is " + core::shortest_text(*value) +
                         "; it is a number above 0");
  }
  if (!(conditions.diastolic_mmhg < conditions.systolic_mmhg))
    throw InvalidInput("the diastolic pressure, " + core::shortest_text(conditions.diastolic_mmhg) +
                       " mmHg, is not below the systolic one, " +
                       core::shortest_text(conditions.systolic_mmhg) + " mmHg");
  if (!(conditions.venous_mmhg < conditions.mean_aortic_mmhg()))
    throw InvalidInput("the venous pressure, " + core::shortest_text(conditions.venous_mmhg) +
                       " mmHg, is not below the mean aortic one, " +
                       core::fixed_text(conditions.mean_aortic_mmhg(), 1) + " mmHg");
  if (unusual) return;
  if (const auto all = unusual_inputs(conditions); !all.empty()) throw InvalidInput(all.front());
}

FlowModel flow_model_of(const Conditions& conditions, FlowModel model) {
  model.density_kg_m3 = conditions.density_kg_m3;
  model.viscosity_mpa_s = conditions.viscosity_mpa_s;
  return model;
}

double root_diameter_mm(const Branch& branch) {
  std::vector<double> diameters;
  for (const Station& station : branch.stations)
    if (station.s_mm - branch.stations.front().s_mm <= 15.0) diameters.push_back(station.diameter_mm());
  return quantile_diameter(std::move(diameters), 0.75);
}

double outlet_diameter_mm(const Branch& branch) {
  std::vector<double> diameters;
  for (const Station& station : branch.stations)
    if (branch.stations.back().s_mm - station.s_mm <= 5.0) diameters.push_back(station.diameter_mm());
  return quantile_diameter(std::move(diameters), 0.5);
}

std::string_view name_of(FlowSource source) {
  constexpr std::array<std::string_view, 3> names = {"told", "mass", "calibre"};
  return names[static_cast<std::size_t>(source)];
}

RestingFlow resting_flow(const Network& network, const Conditions& conditions) {
  const auto outlets = outlets_of(network);
  const auto roots = roots_of(network);
  std::vector<int> root_of(network.branches.size());
  for (std::size_t b = 0; b < root_of.size(); ++b)
    root_of[b] = network.branches[b].parent < 0
                     ? static_cast<int>(b)
                     : root_of[static_cast<std::size_t>(network.branches[b].parent)];
  RestingFlow flow;
  std::vector<double> weight;
  for (const std::size_t outlet : outlets) {
    const double d = outlet_diameter_mm(network.branches[outlet]);
    weight.push_back(d > 0.0 ? std::pow(d, conditions.split_exponent) : 0.0);
  }
  double sum = 0.0;
  for (const double w : weight) sum += w;
  if (!(sum > 0.0))
    throw InvalidInput("no outlet of the tree has a diameter; its share of the flow is not known");
  std::optional<double> share = conditions.supplied_share;
  if (!share && roots.size() > 1) share = 1.0;
  if (conditions.rest_flow_ml_min) {
    flow.source = FlowSource::told;
    flow.total_ml_s = *conditions.rest_flow_ml_min / 60.0;
  } else if (conditions.lv_mass_g && share) {
    flow.source = FlowSource::mass;
    flow.total_ml_s = *conditions.lv_mass_g * conditions.rest_flow_ml_min_g * *share / 60.0;
  }
  if (flow.total_ml_s > 0.0) {
    for (const double w : weight) flow.outlets_ml_s.push_back(flow.total_ml_s * w / sum);
    return flow;
  }
  if (conditions.lv_mass_g)
    flow.notes.push_back(
        "one coronary artery alone is there: its share of the ventricle's mass is not told, so the "
        "flow goes by its calibre");
  flow.outlets_ml_s.assign(outlets.size(), 0.0);
  for (const std::size_t root : roots) {
    double d = root_diameter_mm(network.branches[root]);
    const bool widest = !(d > 0.0);
    // A root too short to be measured is as wide as the widest of its branches.
    for (std::size_t b = 0; b < root_of.size() && widest; ++b)
      if (root_of[b] == static_cast<int>(root)) d = std::max(d, root_diameter_mm(network.branches[b]));
    const double carried = conditions.calibre_factor * std::pow(1e-3 * d, conditions.calibre_exponent) * 1e6;
    double own = 0.0;
    for (std::size_t k = 0; k < outlets.size(); ++k)
      if (root_of[outlets[k]] == static_cast<int>(root)) own += weight[k];
    if (!(own > 0.0)) continue;
    flow.total_ml_s += carried;
    for (std::size_t k = 0; k < outlets.size(); ++k)
      if (root_of[outlets[k]] == static_cast<int>(root)) flow.outlets_ml_s[k] = carried * weight[k] / own;
  }
  if (!(flow.total_ml_s > 0.0))
    throw InvalidInput("no root of the tree has a diameter; its flow is not known");
  return flow;
}

Microcirculation microcirculation(const RestingFlow& flow, const Conditions& conditions) {
  const double pressure = (conditions.mean_aortic_mmhg() - conditions.venous_mmhg) * pa_of_mmhg;
  constexpr double least_flow_ml_s = 1e-6;  // an outlet without a diameter takes next to nothing
  Microcirculation beds;
  for (const double q : flow.outlets_ml_s) {
    beds.rest_pa_s_ml.push_back(pressure / std::max(q, least_flow_ml_s));
    beds.hyperaemic_pa_s_ml.push_back(beds.rest_pa_s_ml.back() * conditions.hyperaemic_resistance);
  }
  return beds;
}

}  // namespace ostia::hemodynamics
