#include "ostia/session/annotation_json.h"

#include "case_tools.h"
#include "schema_rules.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using analysis::MeasureKind;
using ::testing::HasSubstr;
using testing::Json;
using testing::names_in;

const testing::Schema& schema() {
  static const testing::Schema loaded("annotation.schema.json");
  return loaded;
}

std::vector<AnnotationCommand> one_annotation_of_each() {
  const MarkVessel plain{{0, true, false, std::nullopt, ""}};
  std::vector<AnnotationCommand> commands{MeasureDelete{2147483647},
                                          testing::marked("\"calcified\"\n\xC3\xA9"),
                                          plain,
                                          testing::told_inputs(),
                                          testing::opened(),
                                          testing::written(),
                                          testing::told_modifiers(),
                                          testing::told_features(),
                                          testing::signing("more"),
                                          testing::told_calcium()};
  for (const MeasureKind kind : testing::all_kinds) {
    commands.push_back(testing::added(kind));
    MeasureChange change{testing::measurement(kind)};
    change.measurement.id = 3;
    commands.push_back(change);
  }
  return commands;
}

TEST(AnnotationJson, EveryCommandComesBackAsItWas) {
  for (const AnnotationCommand& command : one_annotation_of_each()) {
    const std::string line = to_json(command);
    SCOPED_TRACE(line);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const AnnotationCommand back = annotation_of_json(line);
    EXPECT_EQ(back.index(), command.index());
    EXPECT_EQ(to_json(back), line);
    if (const auto* change = std::get_if<MeasureChange>(&command)) {
      EXPECT_TRUE(same(change->measurement, std::get<MeasureChange>(back).measurement));
    }
    if (const auto* inputs = std::get_if<SetPressureInputs>(&command)) {
      EXPECT_EQ(inputs->inputs, std::get<SetPressureInputs>(back).inputs);
    }
    if (const auto* stretches = std::get_if<SetWhatIfs>(&command)) {
      EXPECT_EQ(stretches->what_ifs, std::get<SetWhatIfs>(back).what_ifs);
    }
    if (const auto* modifiers = std::get_if<SetReportModifiers>(&command)) {
      EXPECT_EQ(modifiers->modifiers, std::get<SetReportModifiers>(back).modifiers);
    }
    if (const auto* features = std::get_if<SetPlaqueFeatures>(&command)) {
      EXPECT_EQ(features->features, std::get<SetPlaqueFeatures>(back).features);
    }
    if (const auto* signed_one = std::get_if<SignReport>(&command)) {
      EXPECT_EQ(signed_one->version, std::get<SignReport>(back).version);
    }
    if (const auto* mark = std::get_if<MarkVessel>(&command)) {
      EXPECT_TRUE(same(mark->mark, std::get<MarkVessel>(back).mark));
    }
  }
}

void expect_refused(const std::string& line, const std::string& part) {
  try {
    annotation_of_json(line);
    FAIL() << line;
  } catch (const InvalidInput& e) {
    EXPECT_THAT(std::string(e.what()), HasSubstr(part)) << line;
  }
}

TEST(AnnotationJson, SaysWhatIsWrong) {
  expect_refused("{", "an annotation is not JSON");
  expect_refused("7", "JSON object");
  expect_refused(R"({"op":"measure.delete","id":1})", "\"v\" missing");
  expect_refused(R"({"v":2,"op":"measure.delete","id":1})", "version 1");
  expect_refused(R"({"v":1,"op":"measure.erase","id":1})", "measure.delete");
  expect_refused(R"({"v":1,"op":"vessel.rename","vessel":1,"name":"x"})", "vessel.mark");
  expect_refused(R"({"v":1,"op":"measure.delete"})", "no \"id\"");
  expect_refused(R"({"v":1,"op":"measure.delete","id":1,"id":1})", "\"id\" twice");
  expect_refused(R"({"v":1,"op":"measure.delete","id":-1})", "ids are");
  expect_refused(R"({"v":1,"op":"measure.delete","id":1,"kind":"area"})", "unknown field \"kind\"");
  expect_refused(R"({"v":1,"op":"measure.change","id":1,"kind":"length"})", "distance");
  expect_refused(R"({"v":1,"op":"measure.change","kind":"area"})", "no \"id\"");
  expect_refused(R"({"v":1,"op":"measure.add","kind":"area","points":[[0,0,0],[1,2]]})", "points[1]");
  expect_refused(R"({"v":1,"op":"pressure.inputs","inputs":{"systolic_mmhg":120}})", "a list");
  expect_refused(R"({"v":1,"op":"pressure.inputs","inputs":[{"key":"a","value":1},{"key":"a","value":2}]})",
                 "\"a\" twice");
  expect_refused(R"({"v":1,"op":"pressure.inputs","inputs":[{"key":"a","value":"x"}]})", "a number");
  expect_refused(R"({"v":1,"op":"pressure.what_if","stretches":[{"vessel":1,"from_mm":0,"to_mm":1}]})",
                 "\"percent\"");
  expect_refused(
      R"({"v":1,"op":"pressure.what_if","stretches":[{"vessel":1,"from_mm":0,"to_mm":1,"kind":"wide","percent":1}]})",
      "open or narrow");
  expect_refused(R"({"v":1,"op":"vessel.mark","vessel":1,"visible":1,"checked":true})", "true or false");
  expect_refused(R"({"v":1,"op":"vessel.mark","vessel":1,"visible":true,"checked":true,"color":[1,0]})",
                 "color");
  expect_refused(R"({"v":1,"op":"report.modifiers","ischaemia":"maybe"})", "borderline");
  expect_refused(R"({"v":1,"op":"report.modifiers","seen":{"LAD":"mild"}})", "LCX");
  expect_refused(R"({"v":1,"op":"report.features","features":[{"vessel":1}]})", "a word on plaque");
  expect_refused(R"({"v":1,"op":"report.sign","date":"2026-03-01","signer":"A"})", "digest");
  expect_refused(R"({"v":1,"op":"vessel.mark","vessel":1,"visible":true,"checked":true,"color":null})",
                 "color");
}

TEST(AnnotationSchema, KnowsEveryCommandAndEveryFieldThatIsWritten) {
  std::set<std::string> listed, written;
  for (const Json& one : schema()["oneOf"])
    listed.insert(schema().resolved(one)["properties"]["op"]["const"]);
  for (const AnnotationCommand& command : one_annotation_of_each()) {
    const std::string op = op_name(command);
    const Json line = Json::parse(to_json(command));
    SCOPED_TRACE(line.dump());
    written.insert(op);
    const Json& kind = schema().definition(op);
    EXPECT_TRUE(schema().is_valid(kind, line));
    const bool colored = op != "vessel.mark" || line.contains("color");
    if (colored) {
      EXPECT_EQ(names_in(kind["properties"]), names_in(line));
    }
    for (const Json& other : schema()["oneOf"])
      EXPECT_EQ(schema().is_valid(other, line), &schema().resolved(other) == &kind);
  }
  EXPECT_EQ(listed, written);
}

bool is_read(const Json& line) {
  try {
    annotation_of_json(line.dump());
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

TEST(AnnotationSchema, AsksForWhatTheReaderAsksFor) {
  for (const AnnotationCommand& command : one_annotation_of_each()) {
    const Json whole = Json::parse(to_json(command));
    const Json& kind = schema().definition(op_name(command));
    for (const std::string& field : names_in(whole)) {
      SCOPED_TRACE(op_name(command) + " " + field);
      Json without = whole;
      without.erase(field);
      EXPECT_EQ(schema().is_valid(kind, without), is_read(without));
      for (const Json& wrong :
           {Json(), Json("x"), Json(-1), Json(0.5), Json::array({1, 2}), Json::object()}) {
        Json broken = whole;
        broken[field] = wrong;
        if (schema().is_valid(kind, broken)) {
          EXPECT_TRUE(is_read(broken)) << wrong;
        }
        if (wrong.is_null() || wrong.is_object()) {
          EXPECT_FALSE(is_read(broken)) << wrong;
        }
      }
    }
    Json more = whole;
    more["drag"] = 1;
    EXPECT_FALSE(schema().is_valid(kind, more));
    EXPECT_FALSE(is_read(more));
  }
}

TEST(AnnotationSchema, HasTheDefaultsOfTheProgram) {
  int defaults = 0;
  for (const AnnotationCommand& command : one_annotation_of_each()) {
    const Json whole = Json::parse(to_json(command));
    for (const auto& [field, rules] : schema().definition(op_name(command))["properties"].items()) {
      if (!schema().resolved(rules).contains("default")) continue;
      ++defaults;
      Json without = whole;
      without.erase(field);
      EXPECT_EQ(Json::parse(to_json(annotation_of_json(without.dump())))[field],
                schema().resolved(rules)["default"])
          << field;
    }
  }
  // Of each measurement seven, of a mark one, of modifiers five, of a signature one.
  EXPECT_EQ(defaults, 9 * 7 + 9 * 7 + 2 + 5 + 1);
}

}  // namespace
}  // namespace ostia::session
