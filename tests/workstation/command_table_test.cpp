// The table of commands, with a few of its own on a desk without the window.

#include "commands/kinds.h"
#include "commands/table.h"
#include "shell/bind.h"
#include "shell/menus.h"
#include "test_desk.h"
#include "tube_case.h"

#include "ostia/core/error.h"
#include "ostia/session/case_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QActionGroup>
#include <QMenu>
#include <QMenuBar>
#include <QTest>

namespace ostia::workstation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct CommandTableTest : ::testing::Test {
  testing::Folder folder;
  testing::TestDesk test{folder / "state"};
  CommandTable table{test.desk()};
  int runs = 0;
  Command counting(const QString& id, const QString& keys = {}) {
    return {.id = id, .text = "&Count " + id, .tip = "Counts.", .keys = {keys}, .run = [this] { ++runs; }};
  }
  void open_case() {
    session::CaseFile::create(folder / "tube.ostia", testing::tube_model(), {});
    test.bench().set_session(session::Session::open(folder / "tube.ostia"));
  }
};

TEST_F(CommandTableTest, OneRowGivesTheActionItsNameTextTipAndKeys) {
  table.add(counting("file.count", "Ctrl+7"));
  table.dress();
  QAction& action = table.action("file.count");
  EXPECT_EQ(action.objectName(), "file.count");
  EXPECT_EQ(action.text(), "&Count file.count");
  EXPECT_EQ(action.shortcut(), QKeySequence("Ctrl+7"));
  EXPECT_EQ(action.statusTip(), "Counts.");
  EXPECT_EQ(action.toolTip(), "Count file.count  [Ctrl+7]\nCounts.");
  action.trigger();
  EXPECT_EQ(runs, 1);
}

TEST_F(CommandTableTest, AKeyRunsACommandThatIsInNoMenu) {
  table.add(counting("file.count", "Ctrl+7"));
  table.dress();
  test.show();
  QTest::keyClick(test.window().windowHandle(), Qt::Key_7, Qt::ControlModifier);
  EXPECT_EQ(runs, 1);
}

TEST_F(CommandTableTest, TwoCommandsOfOneNameAreRefused) {
  table.add(counting("file.count"));
  EXPECT_THROW(table.add(counting("file.count")), std::logic_error);
  EXPECT_THROW(table.action("file.other"), std::logic_error);
  EXPECT_EQ(table.find("file.other"), nullptr);
}

TEST_F(CommandTableTest, WhatACommandThrowsIsSaid) {
  table.add({.id = "file.fail", .text = "Fail", .run = [] { throw InvalidInput("this cannot be done"); }});
  table.action("file.fail").trigger();
  EXPECT_THAT(test.said(), HasSubstr("this cannot be done"));
}

TEST_F(CommandTableTest, EachCommandKnowsWhenItCanBeUsedAndWhyNot) {
  table.add(needs_case(counting("file.count"), test.desk()));
  table.dress();
  const Command& command = *table.find("file.count");
  EXPECT_FALSE(command.action->isEnabled());
  EXPECT_EQ(CommandTable::why_not(command), "No case is open.");
  EXPECT_EQ(command.action->statusTip(), "No case is open.");
  open_case();
  EXPECT_TRUE(command.action->isEnabled());
  EXPECT_EQ(CommandTable::why_not(command), "");
  EXPECT_EQ(command.action->statusTip(), "Counts.");
  test.bench().close_case();
  EXPECT_FALSE(command.action->isEnabled());
}

TEST_F(CommandTableTest, AMarkAndItsPropertyAreTheSame) {
  session::Property<bool> shown{true};
  table.add(
      {.id = "view.shown", .text = "Shown", .bind = [&](QAction& action) { bind_checked(&action, shown); }});
  using reformat::Slab;
  table.add({.id = "view.mip", .text = "Maximum", .bind = [&](QAction& action) {
               bind_switch(&action, test.bench().slab, Slab::none, Slab::maximum);
             }});
  QAction &mark = table.action("view.shown"), &mip = table.action("view.mip");
  EXPECT_TRUE(mark.isChecked());
  mark.trigger();
  EXPECT_FALSE(shown.get());
  shown.set(true);
  EXPECT_TRUE(mark.isChecked());
  EXPECT_FALSE(mip.isChecked());
  mip.trigger();
  EXPECT_EQ(test.bench().slab.get(), Slab::maximum);
  test.bench().slab.set(Slab::mean);
  EXPECT_FALSE(mip.isChecked());
}

TEST_F(CommandTableTest, OfTheToolsOneIsChosenAndSaysWhatItDoes) {
  QActionGroup group(&table);
  for (const auto& [id, tool] :
       {std::pair("tool.browse", session::Tool::browse), {"tool.brush", session::Tool::brush}})
    table.add(tool_command(counting(id), tool, test.desk(), group));
  EXPECT_TRUE(table.action("tool.browse").isChecked());
  table.action("tool.brush").trigger();
  EXPECT_EQ(test.bench().tool.get(), session::Tool::brush);
  EXPECT_EQ(test.said(), "Counts.");
  EXPECT_FALSE(table.action("tool.browse").isChecked());
  test.bench().tool.set(session::Tool::browse);
  EXPECT_TRUE(table.action("tool.browse").isChecked());
}

TEST_F(CommandTableTest, OtherKeysHoldAtOnceAndAreKept) {
  table.add(counting("file.count", "Ctrl+7"));
  table.add(counting("file.other"));
  table.dress();
  ShortcutKeys keys = table.keys();
  ASSERT_TRUE(keys.change("file.count", QKeySequence("Ctrl+8")));
  EXPECT_FALSE(keys.change("file.other", QKeySequence("Ctrl+8")));
  table.set_keys(keys);
  EXPECT_EQ(table.action("file.count").shortcut(), QKeySequence("Ctrl+8"));
  EXPECT_THAT(table.action("file.count").toolTip().toStdString(), HasSubstr("[Ctrl+8]"));
  testing::TestDesk again(folder / "state");
  CommandTable later(again.desk());
  later.add(counting("file.count", "Ctrl+7"));
  later.dress();
  EXPECT_EQ(later.action("file.count").shortcut(), QKeySequence("Ctrl+8"));
}

TEST_F(CommandTableTest, TheOrderIsThatOfTheMenus) {
  for (const char* id : {"a.1", "a.2", "a.3"}) table.add(counting(id));
  table.arrange({"a.3", "a.1"});
  QStringList ids;
  for (const Command& one : table.all()) ids << one.id;
  EXPECT_THAT(ids, ElementsAre("a.3", "a.1", "a.2"));
}

TEST_F(CommandTableTest, TheMenusThatLeadToACommandAreKnown) {
  table.add(counting("file.count"));
  QMenuBar bar;
  EXPECT_TRUE(menus_of(table.action("file.count")).isEmpty());
  bar.addMenu("&File")->addMenu("E&xport\u2026")->addAction(&table.action("file.count"));
  EXPECT_THAT(menus_of(table.action("file.count")), ElementsAre("File", "Export"));
}

TEST_F(CommandTableTest, MenusWithoutTheirCommandsAreRefused) {
  table.add(counting("file.count"));
  QMenuBar bar;
  EXPECT_THROW(build_menus(bar, table), std::logic_error);
}

}  // namespace
}  // namespace ostia::workstation
