#include "uncertain_inputs.h"

#include "ostia/core/error.h"
#include "ostia/hemodynamics/uncertainty.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::hemodynamics {
namespace {

using SpreadJson = nlohmann::ordered_json;

SpreadJson wall_json(const WallSpread& wall) {
  std::vector<double> all;
  for (const auto& branch : wall.station_sd_mm) all.insert(all.end(), branch.begin(), branch.end());
  SpreadJson out{{"law", "lognormal"},
                 {"radius_sd_mm", wall.radius_sd_mm},
                 {"most_relative", wall.most_relative},
                 {"correlation_mm", wall.correlation_mm},
                 {"common_share", wall.common_share},
                 {"source", wall.source}};
  if (!all.empty()) {
    std::sort(all.begin(), all.end());
    out["of_image"] = {{"stations", all.size()},
                       {"least_mm", all.front()},
                       {"median_mm", all[all.size() / 2]},
                       {"most_mm", all.back()}};
  }
  return out;
}

double told_number(const SpreadJson& value, const std::string& key) {
  if (!value.is_number()) throw InvalidInput("uncertainty: " + key + " is no number");
  return value.get<double>();
}

int told_count(const SpreadJson& value, const std::string& key) {
  const double number = told_number(value, key);
  if (!(std::abs(number) <= 1e6) || number != std::floor(number))
    throw InvalidInput("uncertainty: " + key + " is no whole number, or beyond all bounds");
  return static_cast<int>(number);
}

void take_wall(const SpreadJson& told, WallSpread& wall) {
  if (!told.is_object()) throw InvalidInput("uncertainty: wall is no object");
  for (const auto& [key, value] : told.items()) {
    if (key == "radius_sd_mm")
      wall.radius_sd_mm = told_number(value, key);
    else if (key == "most_relative")
      wall.most_relative = told_number(value, key);
    else if (key == "correlation_mm")
      wall.correlation_mm = told_number(value, key);
    else if (key == "common_share")
      wall.common_share = told_number(value, key);
    else if (key == "source" && value.is_string()) {
      // Spreads by an image are not in the file: what is left is the other one.
      if (!told.contains("of_image")) wall.source = value.get<std::string>();
    } else if (key != "law" && key != "of_image")
      throw InvalidInput("uncertainty: the wall has nothing that is called " + key);
  }
}

/// Keys are views of what lives as long as the program.
std::string_view kept_key(const std::string& key) {
  for (const ConditionInput& input : condition_inputs())
    if (input.key == key) return input.key;
  return rest_flow_key;
}

void take_input(const std::string& key, const SpreadJson& told, std::vector<InputSpread>& spreads) {
  const auto group = group_of(key);
  if (!group) throw InvalidInput("uncertainty: there is no input " + key + " that FFR depends on");
  InputSpread spread{kept_key(key), *group, SpreadLaw::normal, 0.0, "told"};
  for (const InputSpread& usual : spreads_of(FlowSource::told))
    if (usual.key == key) spread.law = usual.law;
  if (told.is_object()) {
    if (!told.contains("sd")) throw InvalidInput("uncertainty: " + key + " has no sd");
    spread.sd = told_number(told["sd"], key + ".sd");
    const std::string law = told.value("law", std::string(name_of(spread.law)));
    if (law != "normal" && law != "lognormal")
      throw InvalidInput("uncertainty: the law of " + key + " is normal or lognormal, not " + law);
    spread.law = law == "normal" ? SpreadLaw::normal : SpreadLaw::lognormal;
    spread.source = told.value("source", spread.source);
  } else {
    spread.sd = told_number(told, key);
  }
  std::erase_if(spreads, [&](const InputSpread& one) { return one.key == key; });
  spreads.push_back(std::move(spread));
}

void take_member(const std::string& key, const SpreadJson& value, UncertaintyOptions& options) {
  if (key == "samples")
    options.samples = told_count(value, key);
  else if (key == "seed" && value.is_number_unsigned())
    options.seed = value.get<std::uint64_t>();
  else if (key == "indices" && value.is_boolean())
    options.indices = value.get<bool>();
  else if (key == "wall")
    take_wall(value, options.wall);
  else if (key == "inputs" && value.is_object())
    for (const auto& [name, spread] : value.items()) take_input(name, spread, options.spreads);
  else
    throw InvalidInput("the uncertainty of the conditions has nothing that is called " + key +
                       ", or it is of another kind");
}

}  // namespace

std::string uncertainty_json(const UncertaintyOptions& options) {
  SpreadJson inputs = SpreadJson::object();
  for (const InputSpread& one : options.spreads)
    inputs[std::string(one.key)] = {
        {"law", name_of(one.law)}, {"sd", one.sd}, {"group", name_of(one.group)}, {"source", one.source}};
  return SpreadJson{{"samples", options.samples},
                    {"seed", options.seed},
                    {"indices", options.indices},
                    {"inputs", std::move(inputs)},
                    {"wall", wall_json(options.wall)}}
      .dump(1);
}

UncertaintyOptions uncertainty_of_json(std::string_view text, const UncertaintyOptions& given) {
  SpreadJson all;
  try {
    all = SpreadJson::parse(text);
  } catch (const nlohmann::json::exception&) {
    throw InvalidInput("the uncertainty of the conditions is no JSON");
  }
  if (!all.is_object()) throw InvalidInput("the uncertainty of the conditions is no JSON object");
  if (all.contains("uncertainty"))
    all = SpreadJson(all["uncertainty"]);
  else if (!all.contains("inputs") && !all.contains("wall"))
    return given;
  if (!all.is_object()) throw InvalidInput("the uncertainty of the conditions is no JSON object");
  UncertaintyOptions options = given;
  try {
    for (const auto& [key, value] : all.items()) take_member(key, value, options);
  } catch (const nlohmann::json::exception&) {
    throw InvalidInput(
        "the uncertainty of the conditions has a member of another kind than it is written with");
  }
  validate(options);
  return options;
}

}  // namespace ostia::hemodynamics
