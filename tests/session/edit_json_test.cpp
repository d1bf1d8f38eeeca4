#include "ostia/session/edit_json.h"

#include "case_tools.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace ostia::session {
namespace {

using lumen::Edit;
using ::testing::HasSubstr;
using testing::one_of_each;

TEST(EditJson, EveryEditComesBackAsItWas) {
  std::size_t index = 0;
  for (const Edit& edit : one_of_each()) {
    SCOPED_TRACE(lumen::op_name(edit));
    EXPECT_EQ(edit.index(), index++) << "an edit is missing in the test";
    const std::string line = to_json(edit);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_EQ(to_json(edit_of_json(line)), line);
  }
  EXPECT_EQ(index, std::variant_size_v<Edit>);
}

TEST(EditJson, NumbersKeepEveryBit) {
  for (const double value : {0.1, -0.0, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 2.2250738585072014e-308}) {
    const auto back = std::get<lumen::AxisInsert>(edit_of_json(to_json(lumen::AxisInsert{1, {value, 0, 1}})));
    EXPECT_EQ(std::memcmp(&back.point[0], &value, sizeof value), 0) << value;
  }
}

TEST(EditJson, DefaultsMayBeLeftOut) {
  const auto edit = edit_of_json(R"({"v":1,"op":"wall.drag","vessel":2,"from":[0,1,2],"to":[0,2,2]})");
  EXPECT_EQ(std::get<lumen::WallDrag>(edit).reach_mm, lumen::WallDrag{}.reach_mm);
}

void edit_json_expect_refused(const std::string& line, const std::string& part) {
  try {
    edit_of_json(line);
    FAIL() << line;
  } catch (const InvalidInput& e) {
    EXPECT_THAT(std::string(e.what()), HasSubstr(part)) << line;
  }
}

TEST(EditJson, SaysWhatIsWrong) {
  edit_json_expect_refused("{", "not JSON");
  edit_json_expect_refused("[1]", "JSON object");
  edit_json_expect_refused(R"({"op":"axis.trim","vessel":1,"s_mm":1})", "\"v\" missing");
  edit_json_expect_refused(R"({"v":2,"op":"axis.trim","vessel":1,"s_mm":1})", "version 1");
  edit_json_expect_refused(R"({"v":1.0,"op":"axis.trim","vessel":1,"s_mm":1})", "\"v\"");
  edit_json_expect_refused(R"({"v":1,"op":"axis.cut","vessel":1})", "axis.trim");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":1})", "no \"s_mm\"");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":1,"s_mm":1,"s":2})", "unknown field \"s\"");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":1,"s_mm":1,"s_mm":2})", "\"s_mm\" twice");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":"1","s_mm":1})", "\"vessel\" is string");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":1.5,"s_mm":1})", "whole number");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":-1,"s_mm":1})", "ids are");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":4294967300,"s_mm":1})", "ids are");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":1,"s_mm":NaN})", "not JSON");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":1,"s_mm":1e999})", "");
  edit_json_expect_refused(R"({"v":1,"op":"axis.trim","vessel":1,"s_mm":null})", "\"s_mm\" is null");
  edit_json_expect_refused(R"({"v":1,"op":"axis.insert","vessel":1,"point":[1,2]})",
                           "\"point\" must be a point");
  edit_json_expect_refused(R"({"v":1,"op":"axis.extend","vessel":1,"points":[[1,2,3],[1,"a",3]]})",
                           "points[1][1]");
  edit_json_expect_refused(R"({"v":1,"op":"cpr.stroke","vessel":1,"points":[],"mode":"bent","theta_deg":0})",
                           "straightened");
}

TEST(EditJson, WhatIsNotFiniteIsNotWritten) {
  EXPECT_THROW(to_json(lumen::AxisTrim{1, std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
  EXPECT_THROW(to_json(lumen::VesselRename{1, "\xff"}), InvalidInput);
}

TEST(EditJson, FilesNameTheLine) {
  const testing::TempFolder folder;
  write_edits(folder / "edits.jsonl", one_of_each());
  const auto back = read_edits(folder / "edits.jsonl");
  ASSERT_EQ(back.size(), one_of_each().size());
  for (std::size_t i = 0; i < back.size(); ++i) EXPECT_EQ(to_json(back[i]), to_json(one_of_each()[i]));
  testing::write_bytes(folder / "bad.jsonl", to_json(lumen::BranchDelete{1}) + "\r\n\n{}\n");
  try {
    read_edits(folder / "bad.jsonl");
    FAIL();
  } catch (const InvalidInput& e) {
    EXPECT_THAT(std::string(e.what()), HasSubstr("bad.jsonl, line 3"));
  }
  EXPECT_THROW(read_edits(folder / "missing.jsonl"), IoError);
}

}  // namespace
}  // namespace ostia::session
