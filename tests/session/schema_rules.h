#pragma once
/// \file The rules of a JSON schema that ours use.

#include "ostia/core/files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

namespace ostia::session::testing {

using Json = nlohmann::json;

class Schema {
 public:
  explicit Schema(const std::string& name)
      : whole_(Json::parse(core::read_file(std::filesystem::path(OSTIA_SCHEMAS) / name))) {}
  const Json& operator[](const std::string& key) const { return whole_.at(key); }
  const Json& definition(const std::string& name) const { return whole_.at("$defs").at(name); }

  const Json& resolved(const Json& part) const {
    const auto reference = part.find("$ref");
    return reference == part.end() ? part
                                   : whole_.at(Json::json_pointer(reference->get<std::string>().substr(1)));
  }

  bool is_valid(const Json& part, const Json& value) const {
    const Json& rules = resolved(part);
    if (rules.contains("type") && !has_type(value, rules["type"])) return false;
    return std::all_of(rules.items().begin(), rules.items().end(), [&](const auto& rule) {
      if (rule.key() == "additionalProperties")
        return std::all_of(value.items().begin(), value.items().end(), [&](const auto& field) {
          if (rules.contains("properties") && rules["properties"].contains(field.key())) return true;
          return rule.value().is_object() && is_valid(rule.value(), field.value());
        });
      return rule_holds(rule.key(), rule.value(), value);
    });
  }

 private:
  static bool has_type(const Json& value, const Json& types) {
    if (types.is_array())
      return std::any_of(types.begin(), types.end(), [&](const Json& one) { return has_type(value, one); });
    const auto type = types.get<std::string>();
    if (type == "null") return value.is_null();
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    return type == "number" && value.is_number();
  }

  /// The rules that the schema uses; one that it begins to use and this does not know is a failure.
  bool rule_holds(const std::string& rule, const Json& wanted, const Json& value) const {
    if (rule == "description" || rule == "default" || rule == "type") return true;
    if (rule == "const") return value == wanted;
    if (rule == "enum") return std::find(wanted.begin(), wanted.end(), value) != wanted.end();
    if (rule == "minimum") return !value.is_number() || value >= wanted;
    if (rule == "exclusiveMinimum") return !value.is_number() || value > wanted;
    if (rule == "maximum") return !value.is_number() || value <= wanted;
    if (rule == "minItems") return value.size() >= wanted.get<std::size_t>();
    if (rule == "maxItems") return value.size() <= wanted.get<std::size_t>();
    if (rule == "minLength") return value.get<std::string>().size() >= wanted.get<std::size_t>();
    if (rule == "items")
      return std::all_of(value.begin(), value.end(),
                         [&](const Json& item) { return is_valid(wanted, item); });
    if (rule == "required")
      return std::all_of(wanted.begin(), wanted.end(),
                         [&](const Json& name) { return value.contains(name); });
    if (rule == "properties")
      return std::all_of(value.items().begin(), value.items().end(), [&](const auto& field) {
        return !wanted.contains(field.key()) || is_valid(wanted[field.key()], field.value());
      });
    ADD_FAILURE() << "an unknown rule " << rule;
    return false;
  }
  Json whole_;
};

inline std::set<std::string> names_in(const Json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

}  // namespace ostia::session::testing
