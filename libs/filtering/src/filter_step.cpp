#include "calls.h"
#include "nearest_word.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ostia::filtering {
namespace {

const ParameterFacts& parameter_of(const FilterFacts& filter, std::string_view name) {
  std::vector<std::string> names;
  for (const ParameterFacts& one : filter.parameters) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  const std::string start = filter.name + " has no parameter \"" + std::string(name) + "\"";
  if (names.empty()) throw InvalidInput(start + ", nor any other");
  throw InvalidInput(start + "; the nearest is \"" + detail::nearest_word(name, names) + "\"");
}

std::string bounds_of(const ParameterFacts& parameter) {
  if (parameter.words.empty())
    return (parameter.whole ? "a whole number from " : "a number from ") +
           core::shortest_text(parameter.least) + " to " + core::shortest_text(parameter.most) +
           (parameter.unit.empty() ? "" : " (" + parameter.unit + ")");
  std::string all;
  for (const std::string& word : parameter.words) all += (all.empty() ? "" : ", ") + word;
  return "one of " + all;
}

[[noreturn]] void refuse_value(const FilterFacts& filter, const ParameterFacts& parameter,
                               const std::string& value) {
  std::string text =
      filter.name + ": " + parameter.name + " must be " + bounds_of(parameter) + ", not " + value;
  if (!parameter.words.empty()) text += "; the nearest is " + detail::nearest_word(value, parameter.words);
  throw InvalidInput(text);
}

bool within(const ParameterFacts& parameter, double value) {
  return std::isfinite(value) && value >= parameter.least && value <= parameter.most &&
         (!parameter.whole || value == std::round(value));
}

double read_value(const FilterFacts& filter, const ParameterFacts& parameter, std::string_view text) {
  if (!parameter.words.empty()) {
    const auto found = std::find(parameter.words.begin(), parameter.words.end(), text);
    if (found == parameter.words.end()) refuse_value(filter, parameter, "\"" + std::string(text) + "\"");
    return static_cast<double>(found - parameter.words.begin());
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !within(parameter, value))
    refuse_value(filter, parameter, "\"" + std::string(text) + "\"");
  return value;
}

std::string text_of(const ParameterFacts& parameter, double value) {
  if (parameter.words.empty()) return core::shortest_text(value);
  return parameter.words[static_cast<std::size_t>(value)];
}

/// Bounds that stand in an order.
void check_order(const FilterFacts& filter, const FilterStep& step, const char* lower, const char* upper) {
  const auto has = [&](const char* name) {
    return std::any_of(filter.parameters.begin(), filter.parameters.end(),
                       [&](const ParameterFacts& one) { return one.name == name; });
  };
  const auto value = [&](const char* name) {
    const auto found = step.given.find(name);
    return found != step.given.end() ? found->second : parameter_of(filter, name).value;
  };
  if (has(lower) && has(upper) && value(lower) > value(upper))
    throw InvalidInput(filter.name + ": " + lower + " (" + core::shortest_text(value(lower)) + ") is above " +
                       upper + " (" + core::shortest_text(value(upper)) + ")");
}

}  // namespace

FilterStep step_of_text(std::string_view text) {
  const std::size_t colon = text.find(':');
  FilterStep step;
  step.name = text.substr(0, colon);
  const FilterFacts& filter = filter_named(step.name);
  std::string_view rest = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string_view one = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
    const std::size_t equals = one.find('=');
    const ParameterFacts& parameter = parameter_of(filter, one.substr(0, equals));
    if (equals == std::string_view::npos)
      throw InvalidInput(filter.name + ": " + parameter.name + " has no value; write " + parameter.name +
                         "=" + text_of(parameter, parameter.value));
    if (!step.given.emplace(parameter.name, read_value(filter, parameter, one.substr(equals + 1))).second)
      throw InvalidInput(filter.name + ": " + parameter.name + " is given twice");
  }
  validate(step);
  return step;
}

std::string text_of(const FilterStep& step) {
  validate(step);
  std::string text = step.name;
  for (const ParameterFacts& one : filter_named(step.name).parameters)
    text += (text == step.name ? ":" : ",") + one.name + "=" + text_of(one, value_of(step, one.name));
  return text;
}

double value_of(const FilterStep& step, std::string_view parameter) {
  const ParameterFacts& facts = parameter_of(filter_named(step.name), parameter);
  const auto found = step.given.find(facts.name);
  return found == step.given.end() ? facts.value : found->second;
}

void validate(const FilterStep& step) {
  const FilterFacts& filter = filter_named(step.name);
  for (const auto& [name, value] : step.given) {
    const ParameterFacts& parameter = parameter_of(filter, name);
    if (!within(parameter, value)) refuse_value(filter, parameter, core::shortest_text(value));
  }
  check_order(filter, step, "lower", "upper");
  check_order(filter, step, "sigma_least_mm", "sigma_most_mm");
}

std::string detail::Call::word(std::string_view parameter) const {
  return parameter_of(filter_named(step.name), parameter).words[static_cast<std::size_t>(number(parameter))];
}

}  // namespace ostia::filtering
