// Plug-ins without Python: their edits as one step of the case, their parameters, folders without scripts.

#include "ostia/session/plugin.h"

#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/session/case_report.h"
#include "ostia/session/edit_json.h"
#include "ostia/session/replay.h"
#include "ostia/session/workbench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

PluginEdits three_edits() {
  return {"Widen the wall", "1.0", {ring(10.0, 1.8), renamed("LAD"), drag(20.0, 0.3)}};
}

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PluginStep, IsOneStepThatIsUndoneAndDoneAgainAsOne) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply(drag(15.0, 0.2));
  const std::string before = lumen::digest(*file.model());
  const lumen::EditOutcome outcome = file.apply_plugin(three_edits());
  const std::string after = lumen::digest(*file.model());
  EXPECT_EQ(lumen::digest(outcome.model), after);
  EXPECT_EQ(after, lumen::digest(replayed(
                       tube_model(), {drag(15.0, 0.2), ring(10.0, 1.8), renamed("LAD"), drag(20.0, 0.3)})))
      << "the same as the edits one by one";
  ASSERT_EQ(file.journal().size(), 3U);
  EXPECT_EQ(file.journal().back().op, "plugin");
  EXPECT_EQ(plugin_named_in(file.journal().back().parameters), "Widen the wall 1.0");
  ASSERT_TRUE(file.undo());
  EXPECT_EQ(lumen::digest(*file.model()), before);
  ASSERT_TRUE(file.redo());
  EXPECT_EQ(lumen::digest(*file.model()), after);
}

TEST(PluginStep, IsKeptAndReplayed) {
  const TempFolder folder;
  std::string after;
  {
    CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
    file.apply_plugin(three_edits());
    file.apply(drag(25.0, 0.1));
    after = lumen::digest(*file.model());
  }
  CaseFile file = CaseFile::open(folder / "a.ostia");
  EXPECT_EQ(file.edits().size(), 4U) << "those of the plug-in one by one";
  const ReplayReport report = replay(file);
  EXPECT_TRUE(report.same());
  EXPECT_EQ(report.digest, after);
  ASSERT_TRUE(file.go_to_step(1));
  EXPECT_EQ(lumen::digest(*file.model()), lumen::digest(tube_model()));
}

TEST(PluginStep, OfOneEditThatIsRefusedNoneIsMade) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  PluginEdits step = three_edits();
  step.edits.insert(step.edits.begin() + 2, lumen::VesselRename{99, "RCA"});
  const std::string why = refusal([&] { file.apply_plugin(step); });
  EXPECT_THAT(why, HasSubstr("edit 3 of 4 (vessel.rename)"));
  EXPECT_THAT(why, HasSubstr("99"));
  EXPECT_EQ(lumen::digest(*file.model()), lumen::digest(tube_model()));
  EXPECT_EQ(file.journal().size(), 1U);
}

TEST(PluginStep, WithoutEditsIsNone) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply_plugin({"Nothing", "", {}});
  EXPECT_EQ(file.journal().size(), 1U);
}

TEST(PluginStep, ADragAfterItIsAStepOfItsOwn) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply_plugin({"Drag", "", {drag(20.0, 0.2)}});
  file.apply_merged(drag(20.0, 0.4));
  EXPECT_EQ(file.journal().size(), 3U) << "it goes on from no edit of the plug-in";
}

TEST(PluginStep, TheWorkbenchSolvesItOnceAndTellsItsViews) {
  const TempFolder folder;
  CaseFile::create(folder / "a.ostia", tube_model());
  Workbench bench;
  bench.set_session(Session::open(folder / "a.ostia"));
  bench.vessel.set(tube_vessel);
  int told = 0, steps = 0;
  const auto changed = bench.model_changed.observe([&](const ModelEvent&) { ++told; });
  const auto stepped = bench.steps_changed.observe([&] { ++steps; });
  const double before = bench.section(tube_vessel, 10.0)->area_mm2;
  bench.edit_by_plugin({"Widen", "1", {ring(9.0, 1.8), ring(10.0, 1.8), ring(11.0, 1.8)}});
  EXPECT_EQ(told, 1);
  EXPECT_EQ(steps, 1);
  EXPECT_NEAR(bench.section(tube_vessel, 10.0)->area_mm2 / before, 1.44, 0.03);
  bench.undo();
  EXPECT_NEAR(bench.section(tube_vessel, 10.0)->area_mm2, before, 1e-9);
}

TEST(PluginStep, IsReadBackFromItsLine) {
  const PluginEdits step = three_edits();
  const PluginEdits again = plugin_edits_of_json(to_json(step));
  EXPECT_EQ(again.name, step.name);
  EXPECT_EQ(again.version, step.version);
  ASSERT_EQ(again.edits.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(to_json(again.edits[i]), to_json(step.edits[i]));
  EXPECT_THAT(refusal([] { plugin_edits_of_json(R"({"v":1,"op":"plugin","name":"a","version":"1"})"); }),
              HasSubstr("edits"));
  EXPECT_THAT(
      refusal([] {
        plugin_edits_of_json(R"({"v":1,"op":"plugin","name":"a","version":"1","edits":[{"v":1,"op":"x"}]})");
      }),
      HasSubstr("edit 1"));
  EXPECT_EQ(plugin_named_in(R"({"v":1,"op":"wall.drag"})"), "");
}

TEST(PluginValues, AreWhatWasTypedInTheParametersType) {
  const PluginParameter number{"by_mm", PluginType::number, 0.2, {}},
      whole{"n", PluginType::whole, std::int64_t{2}, {}};
  const PluginParameter flag{"on", PluginType::flag, true, {}},
      choice{"side", PluginType::choice, "left", {"left", "right"}};
  EXPECT_EQ(std::get<double>(plugin_value(number, "0.25")), 0.25);
  EXPECT_EQ(std::get<std::int64_t>(plugin_value(whole, "-3")), -3);
  EXPECT_FALSE(std::get<bool>(plugin_value(flag, "false")));
  EXPECT_EQ(std::get<std::string>(plugin_value(choice, "right")), "right");
  for (const auto& [parameter, typed] : {std::pair(number, "0.2x"),
                                         {number, "nan"},
                                         {number, ""},
                                         {whole, "2.5"},
                                         {flag, "yes"},
                                         {choice, "up"}})
    EXPECT_THAT(refusal([&, &parameter = parameter, &typed = typed] { plugin_value(parameter, typed); }),
                HasSubstr("parameter " + parameter.name + " takes"))
        << typed;
  EXPECT_EQ(plugin_value_text(0.2), "0.2");
  EXPECT_EQ(plugin_value_text(PluginValue(true)), "true");
}

TEST(PluginList, WithoutScriptsNeedsNoPython) {
  const TempFolder folder;
  std::ofstream(folder / "_shared.py") << "import nothing\n";
  std::ofstream(folder / "notes.txt") << "no script\n";
  const PluginList list = list_plugins({folder.path(), folder / "not there"});
  EXPECT_TRUE(list.plugins.empty());
  EXPECT_TRUE(list.refused.empty());
  EXPECT_THAT(refusal([&] { plugin_named(list, "widen"); }), HasSubstr("OSTIA_PLUGINS"));
}

}  // namespace
}  // namespace ostia::session
