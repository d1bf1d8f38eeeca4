// Which differences are allowed: the default rules and the file of rules.

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/evaluation/suite.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <initializer_list>

namespace ostia::evaluation {
namespace {

using nlohmann::json;

constexpr std::uint64_t most_tolerance_bytes = 16ULL << 20;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& member,
                         const std::string& what) {
  throw InvalidInput(path.string() + ": " + member + ": " + what +
                     "; see docs/schemas/tolerance.schema.json");
}

/// A reader of one JSON object that knows which members there may be.
class Members {
 public:
  Members(const std::filesystem::path& path, std::string where, const json& object,
          std::initializer_list<const char*> known)
      : path_(path), where_(std::move(where)), object_(object) {
    if (!object.is_object()) refuse(path_, where_, "must be an object");
    for (const auto& item : object.items()) {
      bool found = false;
      for (const char* name : known) found = found || item.key() == name;
      if (!found) refuse(path_, where_ + "." + item.key(), "is not known");
    }
  }
  void text(const char* name, std::string& to) const {
    if (!object_.contains(name)) return;
    const json& value = object_[name];
    if (!value.is_string() || value.get<std::string>().empty())
      refuse(path_, where_ + "." + name, "must be a text that is not empty");
    to = value.get<std::string>();
  }
  void number(const char* name, double& to, double most = INFINITY) const {
    if (!object_.contains(name)) return;
    const json& value = object_[name];
    if (!value.is_number()) refuse(path_, where_ + "." + name, "must be a number");
    const double number = value.get<double>();
    if (!std::isfinite(number) || number < 0.0 || number > most)
      refuse(path_, where_ + "." + name,
             "must not be negative" + std::string(most < INFINITY ? " or above 1" : "") + ", is " +
                 value.dump());
    to = number;
  }
  void texts(const char* name, std::vector<std::string>& to) const {
    if (!object_.contains(name)) return;
    const json& value = object_[name];
    if (!value.is_array()) refuse(path_, where_ + "." + name, "must be a list of texts");
    for (const json& one : value) {
      if (!one.is_string()) refuse(path_, where_ + "." + name, "must be a list of texts");
      to.push_back(one.get<std::string>());
    }
  }

 private:
  const std::filesystem::path& path_;
  std::string where_;
  const json& object_;
};

Direction direction_of(const std::filesystem::path& path, const std::string& where, const std::string& text) {
  if (text == "higher_is_better") return Direction::higher_is_better;
  if (text == "lower_is_better") return Direction::lower_is_better;
  if (text == "two_sided") return Direction::two_sided;
  refuse(path, where + ".direction", "must be higher_is_better, lower_is_better or two_sided");
}

template <class Rule, class Read>
std::vector<Rule> rules_of(const std::filesystem::path& path, const json& all, const char* name,
                           const Read& read) {
  std::vector<Rule> rules;
  if (!all.contains(name)) return rules;
  if (!all[name].is_array()) refuse(path, name, "must be a list of rules");
  for (std::size_t i = 0; i < all[name].size(); ++i)
    rules.push_back(read(std::string(name) + "[" + std::to_string(i) + "]", all[name][i]));
  return rules;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void add_scores(Tolerances& t) {
  const auto add = [&](const std::string& key, Direction direction, double absolute, double relative) {
    t.figures.push_back({"*", key, direction, absolute, relative});
  };
  for (const std::string name : {"dice", "ov", "of", "ot", "sensitivity", "ppv", "kappa", "weighted_kappa"}) {
    add(name, Direction::higher_is_better, 0.005, 0.0);
    add("*." + name, Direction::higher_is_better, 0.005, 0.0);
    add("*_" + name, Direction::higher_is_better, 0.005, 0.0);
  }
  for (const char* name : {"msd_mm", "rms_sd_mm", "max_sd_mm", "hd95_mm", "hausdorff_mm", "ai_mm"})
    add(std::string("*") + name, Direction::lower_is_better, 0.01, 0.05);
  add("*min_angle_deg", Direction::higher_is_better, 1.0, 0.0);
  add("*min_dihedral_deg", Direction::higher_is_better, 1.0, 0.0);
  add("*min_scaled_jacobian", Direction::higher_is_better, 0.02, 0.0);
  for (const char* name : {"inverted", "self_intersections", "open_edges", "non_manifold_edges",
                           "non_manifold_vertices", "degenerate_triangles"})
    add(std::string("*") + name, Direction::lower_is_better, 0.0, 0.0);
  add("*passed", Direction::higher_is_better, 0.0, 0.0);
  for (const char* name : {"points", "triangles", "tetrahedra"})
    add(std::string("*") + name, Direction::two_sided, 0.0, 0.1);
  add("*_mm", Direction::two_sided, 0.01, 0.01);
  add("*_hu", Direction::two_sided, 1.0, 0.01);
  add("*", Direction::two_sided, 1e-6, 0.01);
}

}  // namespace

bool fits(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

Tolerances default_tolerances() {
  Tolerances t;
  add_scores(t);
  t.ignored_keys = {"*seconds",   "*peak_mb", "*version",  "*versions*", "*sha256*",
                    "*hash*",     "program*", "inputs*",   "outputs*",   "finished*",
                    "*pseudonym", "stages*",  "*valence*", "libraries*", "parameters*"};
  return t;
}

void validate(const Tolerances& tolerances) {
  const auto check = [](double value, const char* name, double most = INFINITY) {
    if (!std::isfinite(value) || value < 0.0 || value > most)
      throw InvalidInput(std::string("a tolerance's ") + name + " must be a number from 0 on, is " +
                         std::to_string(value));
  };
  for (const FigureRule& rule : tolerances.figures) {
    check(rule.absolute, "absolute");
    check(rule.relative, "relative");
  }
  for (const auto* rules : {&tolerances.surfaces, &tolerances.lines, &tolerances.contours}) {
    for (const ShapeRule& rule : *rules) {
      check(rule.mean_mm, "mean_mm");
      check(rule.max_mm, "max_mm");
      check(rule.radius_mm, "radius_mm");
    }
  }
  for (const ImageRule& rule : tolerances.images) {
    check(rule.dice, "dice", 1.0);
    check(rule.mean_hu, "mean_hu");
    check(rule.max_hu, "max_hu");
  }
}

Tolerances read_tolerances(const std::filesystem::path& path) {
  json all;
  try {
    all = json::parse(core::read_file(path, most_tolerance_bytes));
  } catch (const json::exception& error) {
    throw InvalidInput(path.string() + ": is no JSON: " + error.what());
  }
  Tolerances t;
  const Members members(path, "tolerance", all,
                        {"v", "description", "figures", "surfaces", "lines", "contours", "images", "ignore"});
  if (!all.contains("v") || all["v"] != 1) refuse(path, "v", "must be 1");
  t.figures = rules_of<FigureRule>(path, all, "figures", [&](const std::string& where, const json& one) {
    const Members m(path, where, one, {"file", "key", "direction", "absolute", "relative"});
    FigureRule rule;
    std::string direction = "two_sided";
    m.text("file", rule.file);
    m.text("key", rule.key);
    m.text("direction", direction);
    rule.direction = direction_of(path, where, direction);
    m.number("absolute", rule.absolute);
    m.number("relative", rule.relative);
    return rule;
  });
  const auto shape = [&](const std::string& where, const json& one) {
    const Members m(path, where, one, {"file", "mean_mm", "max_mm", "radius_mm"});
    ShapeRule rule;
    m.text("file", rule.file);
    m.number("mean_mm", rule.mean_mm);
    m.number("max_mm", rule.max_mm);
    m.number("radius_mm", rule.radius_mm);
    return rule;
  };
  t.surfaces = rules_of<ShapeRule>(path, all, "surfaces", shape);
  t.lines = rules_of<ShapeRule>(path, all, "lines", shape);
  t.contours = rules_of<ShapeRule>(path, all, "contours", shape);
  t.images = rules_of<ImageRule>(path, all, "images", [&](const std::string& where, const json& one) {
    const Members m(path, where, one, {"file", "dice", "mean_hu", "max_hu"});
    ImageRule rule;
    m.text("file", rule.file);
    m.number("dice", rule.dice, 1.0);
    m.number("mean_hu", rule.mean_hu);
    m.number("max_hu", rule.max_hu);
    return rule;
  });
  if (all.contains("ignore")) {
    const Members m(path, "ignore", all["ignore"], {"files", "keys"});
    m.texts("files", t.ignored_files);
    m.texts("keys", t.ignored_keys);
  }
  const Tolerances defaults = default_tolerances();
  append(t.figures, defaults.figures);
  append(t.ignored_keys, defaults.ignored_keys);
  return t;
}

}  // namespace ostia::evaluation
