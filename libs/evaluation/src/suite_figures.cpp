// JSON files: every number under its key.

#include "suite_files.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace ostia::evaluation {
namespace {

using nlohmann::json;

constexpr std::uint64_t most_bytes = 256ULL << 20;

json parse(const std::filesystem::path& path, const std::string& name, const char* run) {
  const std::string text = core::read_file(path, most_bytes);
  if (text.empty()) throw InvalidInput(name + " of the " + run + " run is empty");
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    throw InvalidInput(name + " of the " + run + " run is no JSON: " + error.what());
  }
}

/// What an object in a list is called by, from the members that name things; empty when nothing does.
std::string own_name(const json& object) {
  static constexpr const char* naming[] = {"case",     "vessel", "name", "section", "boundary",
                                           "observer", "health", "kind", "key"};
  std::string name;
  if (!object.is_object()) return name;
  for (const char* member : naming) {
    if (!object.contains(member)) continue;
    const json& value = object[member];
    if (!value.is_string() && !value.is_number_integer()) continue;
    name += (name.empty() ? "" : ",") + (value.is_string() ? value.get<std::string>() : value.dump());
  }
  return name;
}

/// Names of a list's items: their own where these are all there and differ, else their index.
std::vector<std::string> item_names(const json& list) {
  std::vector<std::string> names;
  std::set<std::string> different;
  for (const json& item : list) {
    names.push_back(own_name(item));
    if (!names.back().empty()) different.insert(names.back());
  }
  if (different.size() < names.size())
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = std::to_string(i);
  return names;
}

struct Leaf {
  bool number = false;
  double value = 0.0;
  std::string text;
};
using Leaves = std::map<std::string, Leaf>;

bool ignored(const std::string& key, const Tolerances& tolerances) {
  return std::any_of(tolerances.ignored_keys.begin(), tolerances.ignored_keys.end(),
                     [&](const std::string& pattern) { return fits(pattern, key); });
}

void flatten(const json& value, const std::string& key, const Tolerances& tolerances, Leaves& leaves) {
  if (!key.empty() && ignored(key, tolerances)) return;
  if (value.is_object()) {
    for (const auto& item : value.items())
      flatten(item.value(), key.empty() ? item.key() : key + "." + item.key(), tolerances, leaves);
  } else if (value.is_array()) {
    const std::vector<std::string> names = item_names(value);
    for (std::size_t i = 0; i < names.size(); ++i)
      flatten(value[i], key + "[" + names[i] + "]", tolerances, leaves);
  } else if (value.is_number()) {
    leaves[key] = {true, value.get<double>(), value.dump()};
  } else if (value.is_boolean()) {
    leaves[key] = {true, value.get<bool>() ? 1.0 : 0.0, value.dump()};
  } else {
    leaves[key] = {false, 0.0, value.is_string() ? value.get<std::string>() : value.dump()};
  }
}

FigurePair pair_of(const std::string& file, const std::string& key, double golden, double result,
                   const Tolerances& tolerances) {
  for (const FigureRule& rule : tolerances.figures) {
    if (!fits(rule.file, file) || !fits(rule.key, key)) continue;
    return {key, golden, result, std::max(rule.absolute, rule.relative * std::abs(golden)), rule.direction};
  }
  return {key, golden, result, 0.0, Direction::two_sided};
}

std::string shortened(const std::string& text) {
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

}  // namespace

void judge(const FigurePair& figure, ComparedFile& file, std::vector<Finding>& findings) {
  file.figures.push_back(figure);
  const double difference = figure.result - figure.golden;
  // Values that differ by no more than what decimal output rounds off are equal.
  const double rounding = 1e-9 * std::max(std::abs(figure.golden), std::abs(figure.result));
  if (std::abs(difference) <= figure.allowed + rounding) return;
  const bool better = (figure.direction == Direction::higher_is_better && difference > 0.0) ||
                      (figure.direction == Direction::lower_is_better && difference < 0.0);
  char text[160];
  std::snprintf(text, sizeof text, "%.6g where it was %.6g: %s by %.3g, allowed are %.3g", figure.result,
                figure.golden,
                figure.direction == Direction::two_sided ? "off" : (better ? "better" : "worse"),
                std::abs(difference), figure.allowed);
  findings.push_back({better ? FindingKind::improvement : FindingKind::regression, file.file, figure.key,
                      figure.golden, figure.result, figure.allowed, text});
  if (!better) file.differs = true;
}

void judge_distance(const std::string& key, double value, double allowed, ComparedFile& file,
                    std::vector<Finding>& findings) {
  judge({key, 0.0, value, allowed, Direction::lower_is_better}, file, findings);
}

void compare_figures(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                     std::vector<Finding>& findings) {
  Leaves golden, result;
  flatten(parse(pair.golden, pair.name, "golden"), "", tolerances, golden);
  flatten(parse(pair.result, pair.name, "new"), "", tolerances, result);
  for (const auto& [key, was] : golden) {
    const auto found = result.find(key);
    if (found == result.end()) {
      findings.push_back({FindingKind::missing, pair.name, key, std::nullopt, std::nullopt, 0.0,
                          "the result does not have this figure; it was " + shortened(was.text)});
      file.differs = true;
      continue;
    }
    const Leaf& is = found->second;
    if (was.number && is.number) {
      judge(pair_of(pair.name, key, was.value, is.value, tolerances), file, findings);
    } else if (was.number) {
      findings.push_back({FindingKind::regression, pair.name, key, was.value, std::nullopt, 0.0,
                          "was " + was.text + " and is no number now: " + shortened(is.text)});
      file.differs = true;
    } else if (was.text != is.text) {
      findings.push_back({FindingKind::change, pair.name, key, std::nullopt, std::nullopt, 0.0,
                          "was " + shortened(was.text) + ", is " + shortened(is.text)});
    }
  }
  for (const auto& [key, is] : result) {
    if (golden.contains(key)) continue;
    findings.push_back({FindingKind::extra, pair.name, key, std::nullopt, std::nullopt, 0.0,
                        "the golden run does not have it; it is " + shortened(is.text)});
  }
}

}  // namespace ostia::evaluation
