#include "uncertain_inputs.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace ostia::hemodynamics {
namespace {

struct KeyGroup {
  std::string_view key;
  InputGroup group;
};
constexpr std::array<KeyGroup, 15> key_groups = {{
    {"systolic_mmhg", InputGroup::pressure},
    {"diastolic_mmhg", InputGroup::pressure},
    {"mean_share", InputGroup::pressure},
    {"venous_mmhg", InputGroup::pressure},
    {rest_flow_key, InputGroup::flow},
    {"rest_flow_ml_min", InputGroup::flow},
    {"lv_mass_g", InputGroup::flow},
    {"rest_flow_ml_min_g", InputGroup::flow},
    {"supplied_share", InputGroup::flow},
    {"calibre_factor", InputGroup::flow},
    {"calibre_exponent", InputGroup::flow},
    {"hyperaemic_resistance", InputGroup::hyperaemia},
    {"split_exponent", InputGroup::split},
    {"viscosity_mpa_s", InputGroup::blood},
    {"density_kg_m3", InputGroup::blood},
}};

const ConditionInput* condition_input(std::string_view key) {
  for (const ConditionInput& input : condition_inputs())
    if (input.key == key) return &input;
  return nullptr;
}

double moved_number(double told, const InputSpread& spread, double normal) {
  return spread.law == SpreadLaw::normal ? told + spread.sd * normal : told * std::exp(spread.sd * normal);
}

void require_spread(bool fine, const std::string& what, double value, const char* range) {
  if (!fine)
    throw InvalidInput("uncertainty: " + what + " is " + core::shortest_text(value) + "; choose " + range);
}

void validate_wall(const WallSpread& wall) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  require_spread(within(wall.radius_sd_mm, 0.0, 1.0), "the spread of a wall", wall.radius_sd_mm, "0 to 1 mm");
  require_spread(within(wall.most_relative, 0.01, 1.0), "the most of a radius that a wall spreads by",
                 wall.most_relative, "0.01 to 1");
  require_spread(within(wall.correlation_mm, 0.5, 100.0), "the length that a wall's error keeps to",
                 wall.correlation_mm, "0.5 to 100 mm");
  require_spread(within(wall.common_share, 0.0, 1.0), "the share that all walls have in common",
                 wall.common_share, "0 to 1");
  for (const auto& branch : wall.station_sd_mm)
    for (const double sd : branch)
      require_spread(within(sd, 0.0, 1.0), "the spread of a wall's section", sd, "0 to 1 mm");
}

}  // namespace

std::string_view name_of(InputGroup group) {
  constexpr std::array<std::string_view, input_groups> names = {"wall",       "pressure", "flow",
                                                                "hyperaemia", "split",    "blood"};
  return names[static_cast<std::size_t>(group)];
}

std::string_view name_of(SpreadLaw law) {
  return law == SpreadLaw::normal ? "normal" : "lognormal";
}

std::optional<InputGroup> group_of(std::string_view key) {
  for (const KeyGroup& one : key_groups)
    if (one.key == key) return one.group;
  return std::nullopt;
}

std::vector<InputSpread> spreads_of(FlowSource source) {
  using enum SpreadLaw;
  InputSpread flow{rest_flow_key, InputGroup::flow, lognormal, 0.35,
                   "scatter of flow about calibre, van der Giessen et al. 2011; a choice"};
  if (source == FlowSource::mass) {
    flow.sd = 0.23;
    flow.source = "between people, 0.98 +- 0.23 ml/min/g, Chareonthaitawee et al. 2001";
  } else if (source == FlowSource::told) {
    flow.sd = 0.10;
    flow.source = "a measured flow repeated; a choice";
  }
  return {
      {"systolic_mmhg", InputGroup::pressure, normal, 8.0, "what ISO 81060-2 allows a cuff"},
      {"diastolic_mmhg", InputGroup::pressure, normal, 8.0, "what ISO 81060-2 allows a cuff"},
      {"mean_share", InputGroup::pressure, normal, 0.03, "Bos et al. 2007, usual range as 95 %"},
      {"venous_mmhg", InputGroup::pressure, lognormal, 0.4, "usual range as 95 %"},
      flow,
      {"hyperaemic_resistance", InputGroup::hyperaemia, lognormal, 0.17,
       "Wilson et al. 1990, usual range as 95 %"},
      {"split_exponent", InputGroup::split, normal, 0.2,
       "2.15 to 2.38 of human arteries (Front Physiol 2022, 871912), 3 of Murray"},
      {"viscosity_mpa_s", InputGroup::blood, lognormal, 0.10,
       "haematocrit of 45 +- 4 %; usual range as 95 %"},
      {"density_kg_m3", InputGroup::blood, normal, 5.0, "usual range as 95 %"},
  };
}

std::vector<InputSpread> spreads_of(FlowSource source, const std::vector<InputSpread>& told) {
  std::vector<InputSpread> all = spreads_of(source);
  for (const InputSpread& one : told) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const InputSpread& usual) { return usual.key == one.key; });
    if (found == all.end())
      all.push_back(one);
    else
      *found = one;
  }
  return all;
}

void validate(const UncertaintyOptions& options) {
  require_spread(options.samples >= 16 && options.samples <= 10000 && options.samples % 2 == 0,
                 "the number of trees", options.samples, "an even number from 16 to 10000");
  for (const InputSpread& spread : options.spreads) {
    const std::string key(spread.key);
    if (group_of(spread.key) != spread.group)
      throw InvalidInput("uncertainty: " + key + " is no input that FFR depends on, or of another group");
    const double most = spread.law == SpreadLaw::lognormal ? 2.0 : 1000.0;
    require_spread(spread.sd >= 0.0 && spread.sd <= most, "the spread of " + key, spread.sd,
                   spread.law == SpreadLaw::lognormal ? "0 to 2" : "0 to 1000");
  }
  validate_wall(options.wall);
}

DrawnInputs drawn_inputs(const Conditions& told, std::span<const InputSpread> spreads,
                         std::span<const double> normal) {
  constexpr double least_flow_factor = 0.01;  // a wide normal spread asks for flow that runs back
  DrawnInputs drawn{told, 1.0};
  for (std::size_t k = 0; k < spreads.size(); ++k) {
    if (spreads[k].key == rest_flow_key) {
      drawn.flow_factor = std::max(least_flow_factor, moved_number(1.0, spreads[k], normal[k]));
      continue;
    }
    const ConditionInput* input = condition_input(spreads[k].key);
    if (!input) continue;
    const std::optional<double> value =
        input->value ? std::optional(told.*input->value) : told.*input->optional;
    if (!value) continue;
    const double kept = std::clamp(moved_number(*value, spreads[k], normal[k]),
                                   std::min(*value, input->least), std::max(*value, input->most));
    if (input->value)
      drawn.conditions.*input->value = kept;
    else
      drawn.conditions.*input->optional = kept;
  }
  constexpr double least_pulse_mmhg = 5.0;
  Conditions& c = drawn.conditions;
  const double pulse = std::min(least_pulse_mmhg, told.systolic_mmhg - told.diastolic_mmhg);
  c.diastolic_mmhg = std::min(c.diastolic_mmhg, c.systolic_mmhg - pulse);
  c.venous_mmhg = std::min(c.venous_mmhg, 0.9 * c.mean_aortic_mmhg());
  return drawn;
}

}  // namespace ostia::hemodynamics
