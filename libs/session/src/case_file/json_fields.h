#pragma once
/// \file The fields of a command as JSON: one list for writing and for reading. Numbers come back to the last
/// bit, and a message names the field.

#include "ostia/analysis/evaluability.h"
#include "ostia/analysis/measurement.h"
#include "ostia/core/error.h"
#include "ostia/lumen/edit.h"
#include "ostia/session/annotation.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::session::json_fields {

using Json = nlohmann::ordered_json;
using geometry::Vec3;
using lumen::ReformationMode;

inline constexpr std::size_t most_points = 100000;

enum class Need { required, optional };

class Writer {
 public:
  Writer(Json& out, std::string what) : out_(&out), what_(std::move(what)) {}
  template <class Value>
  void operator()(const char* name, const Value& value, Need = Need::required) {
    name_ = name;
    (*out_)[name] = json(value);
  }
  template <class Value>
  void operator()(const char* name, const std::optional<Value>& value, Need = Need::optional) {
    if (value) (*this)(name, *value);
  }
  void put(const char* name, Json value) { (*out_)[name] = std::move(value); }

 private:
  Json json(std::int32_t value) const { return value; }
  Json json(bool value) const { return value; }
  Json json(double value) const {
    if (!std::isfinite(value))
      throw InvalidInput("the " + what_ + " cannot be written: \"" + name_ + "\" is not a finite number");
    return value;
  }
  Json json(const std::string& value) const { return value; }
  Json json(const Vec3& v) const { return Json::array({json(v.x()), json(v.y()), json(v.z())}); }
  Json json(const std::array<double, 3>& v) const {
    return Json::array({json(v[0]), json(v[1]), json(v[2])});
  }
  Json json(ReformationMode mode) const {
    return mode == ReformationMode::straightened ? "straightened" : "stretched";
  }
  Json json(analysis::MeasureKind kind) const { return analysis::to_string(kind); }
  Json json(const analysis::EvaluableStretch& one) const {
    return {{"from_mm", json(one.from_mm)},
            {"to_mm", json(one.to_mm)},
            {"grade", analysis::to_string(one.grade)}};
  }
  Json json(const LesionWord& one) const {
    return {{"from_mm", json(one.from_mm)},
            {"to_mm", json(one.to_mm)},
            {"state", to_string(one.state)},
            {"comment", one.comment}};
  }
  Json json(const WhatIf& one) const {
    return {{"vessel", json(one.vessel)},
            {"from_mm", json(one.from_mm)},
            {"to_mm", json(one.to_mm)},
            {"kind", to_string(one.kind)},
            {"percent", json(one.percent)}};
  }
  Json json(analysis::Ischaemia value) const { return analysis::to_string(value); }
  Json json(analysis::PlaqueBurden value) const { return analysis::to_string(value); }
  Json json(analysis::Dominance value) const { return analysis::to_string(value); }
  Json json(const SeenPlaque& seen) const {
    return {{"LAD", analysis::to_string(seen.lad)},
            {"LCX", analysis::to_string(seen.lcx)},
            {"RCA", analysis::to_string(seen.rca)}};
  }
  Json json(const FeatureWord& one) const {
    return {{"vessel", json(one.vessel)},
            {"from_mm", json(one.from_mm)},
            {"to_mm", json(one.to_mm)},
            {"feature", analysis::to_string(one.feature)},
            {"state", to_string(one.state)}};
  }
  Json json(const CalciumWord& one) const {
    return {{"centre", json(one.centre)}, {"place", analysis::to_string(one.place)}};
  }
  /// Numbers by name as a list, in the names' order.
  Json json(const std::map<std::string, double>& values) const {
    Json list = Json::array();
    for (const auto& [key, value] : values) list.push_back({{"key", key}, {"value", json(value)}});
    return list;
  }
  template <class Value>
  Json json(const std::vector<Value>& values) const {
    Json list = Json::array();
    for (const Value& value : values) list.push_back(json(value));
    return list;
  }
  Json* out_;
  std::string what_, name_;
};

class Reader {
 public:
  Reader(const Json& in, std::string what) : in_(&in), what_(std::move(what)) {}
  template <class Value>
  void operator()(const char* name, Value& value, Need need = Need::required) {
    known_.insert(name);
    const auto found = in_->find(name);
    if (found == in_->end()) {
      if (need == Need::required) fail(std::string("it has no \"") + name + "\"");
      return;
    }
    read(*found, name, value);
  }
  template <class Value>
  void operator()(const char* name, std::optional<Value>& value, Need = Need::optional) {
    known_.insert(name);
    if (in_->contains(name)) (*this)(name, value.emplace());
  }
  void require_no_others() const {
    for (const auto& [key, value] : in_->items()) {
      if (key == "v" || key == "op" || known_.contains(key)) continue;
      std::string choices;
      for (const std::string& name : known_) choices += (choices.empty() ? "" : ", ") + name;
      fail("it has an unknown field \"" + key + "\"; it may have " + choices);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InvalidInput("the " + what_ + ": " + what); }
  [[noreturn]] void fail(const std::string& name, const Json& value, const std::string& wanted) const {
    fail("\"" + name + "\" is " + std::string(value.type_name()) + "; it must be " + wanted);
  }
  void read(const Json& in, const std::string& name, std::int32_t& out) const {
    if (!in.is_number_integer()) fail(name, in, "a whole number");
    const bool fits = in.is_number_unsigned()
                          ? in.get<std::uint64_t>() <= std::numeric_limits<std::int32_t>::max()
                          : in.get<std::int64_t>() >= 0;
    if (!fits) fail("\"" + name + "\" is " + in.dump() + "; ids are 0 to 2147483647");
    out = in.get<std::int32_t>();
  }
  void read(const Json& in, const std::string& name, double& out) const {
    if (!in.is_number()) fail(name, in, "a number");
    out = in.get<double>();
    if (!std::isfinite(out)) fail("\"" + name + "\" is not a finite number");
  }
  void read(const Json& in, const std::string& name, bool& out) const {
    if (!in.is_boolean()) fail(name, in, "true or false");
    out = in.get<bool>();
  }
  void read(const Json& in, const std::string& name, std::string& out) const {
    if (!in.is_string()) fail(name, in, "a text");
    out = in.get<std::string>();
  }
  void read(const Json& in, const std::string& name, ReformationMode& out) const {
    const std::string mode = in.is_string() ? in.get<std::string>() : "";
    if (mode != "straightened" && mode != "stretched")
      fail("\"" + name + "\" must be \"straightened\" or \"stretched\"");
    out = mode == "straightened" ? ReformationMode::straightened : ReformationMode::stretched;
  }
  void read(const Json& in, const std::string& name, analysis::MeasureKind& out) const {
    if (!in.is_string()) fail(name, in, "a text");
    try {
      out = analysis::measure_kind(in.get<std::string>());
    } catch (const InvalidInput& e) {
      fail("\"" + name + "\": " + e.what());
    }
  }
  void read(const Json& in, const std::string& name, analysis::EvaluableStretch& out) const {
    if (!in.is_object() || in.size() != 3 || !in.contains("from_mm") || !in.contains("to_mm") ||
        !in.contains("grade"))
      fail("\"" + name + "\" must be a stretch {\"from_mm\", \"to_mm\", \"grade\"}");
    std::string grade;
    read(in["from_mm"], name + ".from_mm", out.from_mm);
    read(in["to_mm"], name + ".to_mm", out.to_mm);
    read(in["grade"], name + ".grade", grade);
    try {
      out.grade = analysis::evaluability(grade);
    } catch (const InvalidInput& e) {
      fail("\"" + name + ".grade\": " + e.what());
    }
    out.by_person = true;
  }
  void read(const Json& in, const std::string& name, LesionWord& out) const {
    const bool has_comment = in.is_object() && in.contains("comment");
    if (!in.is_object() || in.size() != (has_comment ? 4U : 3U) || !in.contains("from_mm") ||
        !in.contains("to_mm") || !in.contains("state"))
      fail("\"" + name + "\" must be a lesion {\"from_mm\", \"to_mm\", \"state\", \"comment\"}");
    std::string state;
    read(in["from_mm"], name + ".from_mm", out.from_mm);
    read(in["to_mm"], name + ".to_mm", out.to_mm);
    read(in["state"], name + ".state", state);
    if (has_comment) read(in["comment"], name + ".comment", out.comment);
    try {
      out.state = lesion_state(state);
    } catch (const InvalidInput& e) {
      fail("\"" + name + ".state\": " + e.what());
    }
  }
  void read(const Json& in, const std::string& name, WhatIf& out) const {
    if (!in.is_object() || in.size() != 5 || !in.contains("vessel") || !in.contains("from_mm") ||
        !in.contains("to_mm") || !in.contains("kind") || !in.contains("percent"))
      fail("\"" + name + "\" must be a stretch {\"vessel\", \"from_mm\", \"to_mm\", \"kind\", \"percent\"}");
    std::string kind;
    read(in["vessel"], name + ".vessel", out.vessel);
    read(in["from_mm"], name + ".from_mm", out.from_mm);
    read(in["to_mm"], name + ".to_mm", out.to_mm);
    read(in["kind"], name + ".kind", kind);
    read(in["percent"], name + ".percent", out.percent);
    try {
      out.kind = what_if_kind(kind);
    } catch (const InvalidInput& e) {
      fail("\"" + name + ".kind\": " + e.what());
    }
  }
  /// A word of an enumeration, by what reads it.
  template <class Value, class Parse>
  void read_word(const Json& in, const std::string& name, Value& out, const Parse& parse) const {
    std::string text;
    read(in, name, text);
    try {
      out = parse(text);
    } catch (const InvalidInput& e) {
      fail("\"" + name + "\": " + e.what());
    }
  }
  void read(const Json& in, const std::string& name, analysis::Ischaemia& out) const {
    read_word(in, name, out, [](const std::string& text) { return analysis::ischaemia(text); });
  }
  void read(const Json& in, const std::string& name, analysis::PlaqueBurden& out) const {
    read_word(in, name, out, [](const std::string& text) { return analysis::plaque_burden(text); });
  }
  void read(const Json& in, const std::string& name, analysis::Dominance& out) const {
    read_word(in, name, out, [](const std::string& text) { return analysis::dominance(text); });
  }
  void read(const Json& in, const std::string& name, SeenPlaque& out) const {
    if (!in.is_object() || in.size() != 3 || !in.contains("LAD") || !in.contains("LCX") ||
        !in.contains("RCA"))
      fail("\"" + name + "\" must be amounts of plaque {\"LAD\", \"LCX\", \"RCA\"}");
    const auto amount = [](const std::string& text) { return analysis::plaque_amount(text); };
    read_word(in["LAD"], name + ".LAD", out.lad, amount);
    read_word(in["LCX"], name + ".LCX", out.lcx, amount);
    read_word(in["RCA"], name + ".RCA", out.rca, amount);
  }
  void read(const Json& in, const std::string& name, FeatureWord& out) const {
    if (!in.is_object() || in.size() != 5 || !in.contains("vessel") || !in.contains("from_mm") ||
        !in.contains("to_mm") || !in.contains("feature") || !in.contains("state"))
      fail("\"" + name +
           "\" must be a word on plaque {\"vessel\", \"from_mm\", \"to_mm\", \"feature\", \"state\"}");
    read(in["vessel"], name + ".vessel", out.vessel);
    read(in["from_mm"], name + ".from_mm", out.from_mm);
    read(in["to_mm"], name + ".to_mm", out.to_mm);
    read_word(in["feature"], name + ".feature", out.feature,
              [](const std::string& text) { return analysis::plaque_feature(text); });
    read_word(in["state"], name + ".state", out.state,
              [](const std::string& text) { return lesion_state(text); });
  }
  void read(const Json& in, const std::string& name, CalciumWord& out) const {
    if (!in.is_object() || in.size() != 2 || !in.contains("centre") || !in.contains("place"))
      fail("\"" + name + "\" must be a word on a lesion {\"centre\", \"place\"}");
    read(in["centre"], name + ".centre", out.centre);
    read_word(in["place"], name + ".place", out.place,
              [](const std::string& text) { return analysis::calcium_place(text); });
  }
  void read(const Json& in, const std::string& name, std::map<std::string, double>& out) const {
    if (!in.is_array()) fail(name, in, "a list");
    out.clear();
    for (const Json& one : in) {
      if (!one.is_object() || one.size() != 2 || !one.contains("key") || !one.contains("value"))
        fail("\"" + name + "\" must be a list of inputs {\"key\", \"value\"}");
      std::string key;
      read(one["key"], name + ".key", key);
      if (out.contains(key)) fail("\"" + name + "\" has \"" + key + "\" twice");
      read(one["value"], name + "." + key, out[key]);
    }
  }
  void read(const Json& in, const std::string& name, std::array<double, 3>& out) const {
    if (!in.is_array() || in.size() != 3) fail("\"" + name + "\" must be a color [red, green, blue]");
    for (std::size_t k = 0; k < 3; ++k) read(in[k], name + "[" + std::to_string(k) + "]", out[k]);
  }
  void read(const Json& in, const std::string& name, Vec3& out) const {
    if (!in.is_array() || in.size() != 3) fail("\"" + name + "\" must be a point [x, y, z] in mm");
    for (std::size_t k = 0; k < 3; ++k)
      read(in[k], name + "[" + std::to_string(k) + "]", out[static_cast<Eigen::Index>(k)]);
  }
  template <class Value>
  void read(const Json& in, const std::string& name, std::vector<Value>& out) const {
    if (!in.is_array()) fail(name, in, "a list");
    if (in.size() > most_points)
      fail("\"" + name + "\" has " + std::to_string(in.size()) + " entries; the limit is " +
           std::to_string(most_points));
    out.clear();
    for (std::size_t i = 0; i < in.size(); ++i) {
      out.emplace_back();
      if constexpr (std::is_same_v<Value, Vec3>) out.back().setZero();
      read(in[i], name + "[" + std::to_string(i) + "]", out.back());
    }
  }
  const Json* in_;
  std::string what_;
  std::set<std::string> known_;
};

/// The line of an edit or an annotation (`what`) as an object with "v" 1 and a text "op"; refuses keys that
/// are there twice.
inline Json object_of(const std::string& what, std::string_view line) {
  std::set<std::string> seen;
  std::string repeated;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::key && depth == 1 && !seen.insert(parsed.get<std::string>()).second)
      repeated = parsed.get<std::string>();
    return true;
  };
  Json object;
  try {
    object = Json::parse(line.begin(), line.end(), watch);
  } catch (const Json::exception& e) {
    throw InvalidInput("an " + what + " is not JSON (" + e.what() + "); write one object a line");
  }
  if (!object.is_object()) throw InvalidInput("an " + what + " must be a JSON object {\"v\":1,\"op\":...}");
  if (!repeated.empty()) throw InvalidInput("an " + what + " has \"" + repeated + "\" twice");
  const auto version = object.find("v");
  if (version == object.end() || !version->is_number_integer() || *version != 1)
    throw InvalidInput("an " + what + " has \"v\" " +
                       (version == object.end() ? "missing" : version->dump()) +
                       "; this program reads version 1");
  const auto op = object.find("op");
  if (op == object.end() || !op->is_string()) throw InvalidInput("an " + what + " has no text \"op\"");
  return object;
}

/// {"v":1,"op":...} and what `fill` writes, without an end of line.
template <class Fill>
std::string line_of(const std::string& what, const std::string& op, const Fill& fill) {
  Json out{{"v", 1}, {"op", op}};
  Writer writer(out, what + " " + op);
  fill(writer);
  try {
    return out.dump();
  } catch (const Json::exception&) {
    throw InvalidInput("the " + what + " " + op + " cannot be written: its text is not UTF-8");
  }
}

}  // namespace ostia::session::json_fields
