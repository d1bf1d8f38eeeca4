// docs/schemas/edit.schema.json against what is written and read: neither may know what the other does not.

#include "case_tools.h"
#include "schema_rules.h"

#include "ostia/core/error.h"
#include "ostia/session/edit_json.h"

#include <gtest/gtest.h>

#include <set>

namespace ostia::session {
namespace {

using testing::Json;
using testing::names_in;
using testing::Schema;

const Schema& edit_schema_schema() {
  static const Schema loaded("edit.schema.json");
  return loaded;
}

bool edit_schema_is_read(const Json& line) {
  try {
    edit_of_json(line.dump());
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

TEST(EditSchema, KnowsEveryEditAndEveryFieldThatIsWritten) {
  std::set<std::string> listed, written;
  for (const Json& one : edit_schema_schema()["oneOf"])
    listed.insert(edit_schema_schema().resolved(one)["properties"]["op"]["const"]);
  for (const lumen::Edit& edit : testing::one_of_each()) {
    const std::string op = lumen::op_name(edit);
    SCOPED_TRACE(op);
    written.insert(op);
    const Json line = Json::parse(to_json(edit));
    const Json& kind = edit_schema_schema().definition(op);
    EXPECT_TRUE(edit_schema_schema().is_valid(kind, line));
    EXPECT_EQ(names_in(kind["properties"]), names_in(line));
    for (const Json& other : edit_schema_schema()["oneOf"]) {
      EXPECT_EQ(edit_schema_schema().is_valid(other, line), &edit_schema_schema().resolved(other) == &kind);
    }
  }
  EXPECT_EQ(listed, written);
}

TEST(EditSchema, AsksForWhatTheReaderAsksFor) {
  for (const lumen::Edit& edit : testing::one_of_each()) {
    const Json whole = Json::parse(to_json(edit));
    const Json& kind = edit_schema_schema().definition(lumen::op_name(edit));
    for (const std::string& field : names_in(whole)) {
      SCOPED_TRACE(lumen::op_name(edit) + " " + field);
      Json without = whole;
      without.erase(field);
      EXPECT_EQ(edit_schema_schema().is_valid(kind, without), edit_schema_is_read(without));
      for (const Json& wrong :
           {Json(), Json("x"), Json(-1), Json(0.5), Json::array({1, 2}), Json::object()}) {
        Json broken = whole;
        broken[field] = wrong;
        // Ranges are the model's to judge: what is not valid may be read, but never the other way round.
        if (edit_schema_schema().is_valid(kind, broken)) {
          EXPECT_TRUE(edit_schema_is_read(broken)) << wrong;
        }
        if (wrong.is_null() || wrong.is_object()) {
          EXPECT_FALSE(edit_schema_is_read(broken)) << wrong;
        }
      }
    }
    Json more = whole;
    more["pixels"] = 1;
    EXPECT_FALSE(edit_schema_schema().is_valid(kind, more));
    EXPECT_FALSE(edit_schema_is_read(more));
  }
}

TEST(EditSchema, HasTheDefaultsOfTheProgram) {
  int defaults = 0;
  for (const lumen::Edit& edit : testing::one_of_each()) {
    const Json whole = Json::parse(to_json(edit));
    for (const auto& [field, rules] :
         edit_schema_schema().definition(lumen::op_name(edit))["properties"].items()) {
      if (!rules.contains("default")) continue;
      ++defaults;
      Json without = whole;
      without.erase(field);
      EXPECT_EQ(Json::parse(to_json(edit_of_json(without.dump())))[field], rules["default"])
          << lumen::op_name(edit) << " " << field;
    }
  }
  EXPECT_EQ(defaults, 7);
}

TEST(EditSchema, ItsRangesAreTheModels) {
  // Just outside a range an edit is refused by the value's name; a line that the schema takes gets further.
  const lumen::LumenModel model = testing::tube_model();
  const auto said = [&](const std::string& op, Json line) {
    line["v"] = 1;
    line["op"] = op;
    line["vessel"] = testing::tube_vessel;
    EXPECT_FALSE(edit_schema_schema().is_valid(edit_schema_schema().definition(op), line)) << line;
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
