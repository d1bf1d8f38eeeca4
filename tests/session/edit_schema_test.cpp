// docs/schemas/edit.schema.json against what is written and read: neither may know what the other does not.

#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/session/edit_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace ostia::session {
namespace {

using Json = nlohmann::json;

const Json& schema() {
  static const Json loaded =
      Json::parse(core::read_file(std::filesystem::path(OSTIA_SCHEMAS) / "edit.schema.json"));
  return loaded;
}

const Json& resolved(const Json& part) {
  const auto reference = part.find("$ref");
  return reference == part.end() ? part
                                 : schema().at(Json::json_pointer(reference->get<std::string>().substr(1)));
}

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

bool rule_holds(const std::string& rule, const Json& wanted, const Json& value);

bool is_valid(const Json& part, const Json& value) {
  const Json& rules = resolved(part);
  if (rules.contains("type") && !has_type(value, rules["type"])) return false;
  return std::all_of(rules.items().begin(), rules.items().end(), [&](const auto& rule) {
    if (rule.key() == "additionalProperties")
      return std::all_of(value.items().begin(), value.items().end(),
                         [&](const auto& field) { return rules["properties"].contains(field.key()); });
    return rule_holds(rule.key(), rule.value(), value);
  });
}

/// The rules that the schema uses; one that it begins to use and this does not know is a failure.
bool rule_holds(const std::string& rule, const Json& wanted, const Json& value) {
  if (rule == "description" || rule == "default" || rule == "type") return true;
  if (rule == "const") return value == wanted;
  if (rule == "enum") return std::find(wanted.begin(), wanted.end(), value) != wanted.end();
  if (rule == "minimum") return value >= wanted;
  if (rule == "exclusiveMinimum") return value > wanted;
  if (rule == "maximum") return value <= wanted;
  if (rule == "minItems") return value.size() >= wanted.get<std::size_t>();
  if (rule == "maxItems") return value.size() <= wanted.get<std::size_t>();
  if (rule == "minLength") return value.get<std::string>().size() >= wanted.get<std::size_t>();
  if (rule == "items")
    return std::all_of(value.begin(), value.end(), [&](const Json& item) { return is_valid(wanted, item); });
  if (rule == "required")
    return std::all_of(wanted.begin(), wanted.end(), [&](const Json& name) { return value.contains(name); });
  if (rule == "properties")
    return std::all_of(value.items().begin(), value.items().end(), [&](const auto& field) {
      return !wanted.contains(field.key()) || is_valid(wanted[field.key()], field.value());
    });
  ADD_FAILURE() << "an unknown rule " << rule;
  return false;
}

bool is_read(const Json& line) {
  try {
    edit_of_json(line.dump());
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

std::set<std::string> names_in(const Json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

TEST(EditSchema, KnowsEveryEditAndEveryFieldThatIsWritten) {
  std::set<std::string> listed, written;
  for (const Json& one : schema()["oneOf"]) listed.insert(resolved(one)["properties"]["op"]["const"]);
  for (const lumen::Edit& edit : testing::one_of_each()) {
    const std::string op = lumen::op_name(edit);
    SCOPED_TRACE(op);
    written.insert(op);
    const Json line = Json::parse(to_json(edit));
    const Json& kind = schema()["$defs"][op];
    EXPECT_TRUE(is_valid(kind, line));
    EXPECT_EQ(names_in(kind["properties"]), names_in(line));
    for (const Json& other : schema()["oneOf"]) {
      EXPECT_EQ(is_valid(other, line), &resolved(other) == &kind);
    }
  }
  EXPECT_EQ(listed, written);
}

TEST(EditSchema, AsksForWhatTheReaderAsksFor) {
  for (const lumen::Edit& edit : testing::one_of_each()) {
    const Json whole = Json::parse(to_json(edit));
    const Json& kind = schema()["$defs"][lumen::op_name(edit)];
    for (const std::string& field : names_in(whole)) {
      SCOPED_TRACE(lumen::op_name(edit) + " " + field);
      Json without = whole;
      without.erase(field);
      EXPECT_EQ(is_valid(kind, without), is_read(without));
      for (const Json& wrong :
           {Json(), Json("x"), Json(-1), Json(0.5), Json::array({1, 2}), Json::object()}) {
        Json broken = whole;
        broken[field] = wrong;
        // Ranges are the model's to judge: what is not valid may be read, but never the other way round.
        if (is_valid(kind, broken)) {
          EXPECT_TRUE(is_read(broken)) << wrong;
        }
        if (wrong.is_null() || wrong.is_object()) {
          EXPECT_FALSE(is_read(broken)) << wrong;
        }
      }
    }
    Json more = whole;
    more["pixels"] = 1;
    EXPECT_FALSE(is_valid(kind, more));
    EXPECT_FALSE(is_read(more));
  }
}

TEST(EditSchema, HasTheDefaultsOfTheProgram) {
  int defaults = 0;
  for (const lumen::Edit& edit : testing::one_of_each()) {
    const Json whole = Json::parse(to_json(edit));
    for (const auto& [field, rules] : schema()["$defs"][lumen::op_name(edit)]["properties"].items()) {
      if (!rules.contains("default")) continue;
      ++defaults;
      Json without = whole;
      without.erase(field);
      EXPECT_EQ(Json::parse(to_json(edit_of_json(without.dump())))[field], rules["default"])
          << lumen::op_name(edit) << " " << field;
    }
  }
  EXPECT_EQ(defaults, 5);
}

TEST(EditSchema, ItsRangesAreTheModels) {
  // Just outside a range an edit is refused by the value's name; a line that the schema takes gets further.
  const lumen::LumenModel model = testing::tube_model();
  const auto said = [&](const std::string& op, Json line) {
    line["v"] = 1;
    line["op"] = op;
    line["vessel"] = testing::tube_vessel;
    EXPECT_FALSE(is_valid(schema()["$defs"][op], line)) << line;
    try {
      lumen::apply(model, edit_of_json(line.dump()));
    } catch (const InvalidInput& e) {
      return std::string(e.what());
    }
    return std::string("applied");
  };
  const Json place = {1.5, 0, 10}, points = {{1.5, 0, 10}, {1.5, 0, 12}, {1.5, 0.1, 14}};
  for (const double beta : {44.9, 90.1})
    EXPECT_NE(
        said("cpr.stroke", {{"points", points}, {"mode", "stretched"}, {"theta_deg", 0}, {"beta_deg", beta}})
            .find("beta is"),
        std::string::npos);
  for (const double eps : {0.0, 20.1})
    EXPECT_NE(said("section.contour", {{"points", points}, {"s_mm", 10}, {"closed", false}, {"eps_mm", eps}})
                  .find("eps is"),
              std::string::npos);
  for (const double reach : {0.0, 20.1})
    EXPECT_NE(said("wall.drag", {{"from", place}, {"to", place}, {"reach_mm", reach}}).find("reach is"),
              std::string::npos);
  for (const double radius : {0.0, 10.1})
    EXPECT_NE(said("wall.push", {{"path", Json::array({place})}, {"radius_mm", radius}}).find("radius is"),
              std::string::npos);
  for (const double reach : {0.0, 50.1})
    EXPECT_NE(said("axis.move", {{"from", place}, {"to", place}, {"reach_mm", reach}}).find("reach is"),
              std::string::npos);
}

}  // namespace
}  // namespace ostia::session
