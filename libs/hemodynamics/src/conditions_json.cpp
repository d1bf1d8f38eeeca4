#include "ostia/core/error.h"
#include "ostia/hemodynamics/conditions.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace ostia::hemodynamics {
namespace {

using Json = nlohmann::ordered_json;

void set_value(Conditions& conditions, const ConditionInput& input, double value) {
  if (input.value)
    conditions.*input.value = value;
  else
    conditions.*input.optional = value;
}

}  // namespace

std::string conditions_json(const Conditions& conditions) {
  const Conditions usual;
  Json all = Json::object();
  for (const ConditionInput& input : condition_inputs()) {
    const std::optional<double> value = input.value ? conditions.*input.value : conditions.*input.optional;
    const std::optional<double> before = input.value ? usual.*input.value : usual.*input.optional;
    Json one{{"value", value ? Json(*value) : Json()},
             {"unit", input.unit},
             {"meaning", input.meaning},
             {"usual", {input.usual_low, input.usual_high}},
             {"allowed", {input.least, input.most}},
             {"source", input.source},
             {"told", value != before}};
    all[std::string(input.key)] = std::move(one);
  }
  return all.dump(1);
}

Conditions conditions_of_json(std::string_view text, const Conditions& given) {
  Json all;
  try {
    all = Json::parse(text);
  } catch (const nlohmann::json::exception&) {
    throw InvalidInput("the conditions are no JSON");
  }
  if (!all.is_object()) throw InvalidInput("the conditions are no JSON object of inputs by name");
  if (all.contains("conditions") && all["conditions"].is_object()) all = Json(all["conditions"]);
  Conditions conditions = given;
  const auto inputs_known = condition_inputs();
  for (const auto& [key, entry] : all.items()) {
    if (key == "uncertainty") continue;  // uncertainty_of_json
    const auto input = std::find_if(inputs_known.begin(), inputs_known.end(),
                                    [&key = key](const ConditionInput& one) { return one.key == key; });
    if (input == inputs_known.end())
      throw InvalidInput("the conditions have an input that is not known: " + key);
    const Json value = entry.is_object() && entry.contains("value") ? entry["value"] : entry;
    if (value.is_null() && !input->value) {
      conditions.*input->optional = std::nullopt;
      continue;
    }
    if (!value.is_number()) throw InvalidInput("the conditions' " + key + " is no number");
    set_value(conditions, *input, value.get<double>());
  }
  return conditions;
}

}  // namespace ostia::hemodynamics
