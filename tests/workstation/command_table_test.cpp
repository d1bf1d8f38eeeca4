// The table of commands: with a few of its own on a desk without the window, and the program's own.

#include "commands/kinds.h"
#include "commands/table.h"
#include "commands/texts.h"
#include "help/tour.h"
#include "shell/bind.h"
#include "shell/main_window.h"
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
#include <map>
#include <set>

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

// The program's own commands --------------------------------------------------------------------------------

/// Ids and keys are in the settings and manuals of those who use the program.
const std::vector<Shortcut> known{
    {"file.open", "Ctrl+O", "Ctrl+O"},
    {"file.open_folder", "Ctrl+Shift+O", "Ctrl+Shift+O"},
    {"file.sample", "", ""},
    {"file.save_as", "Ctrl+Shift+S", "Ctrl+Shift+S"},
    {"file.close", "Ctrl+W", "Ctrl+W"},
    {"file.report", "Ctrl+R", "Ctrl+R"},
    {"file.pin", "Ctrl+P", "Ctrl+P"},
    {"file.export_surface", "Ctrl+E", "Ctrl+E"},
    {"file.export_mesh", "Ctrl+M", "Ctrl+M"},
    {"file.flow_case", "Ctrl+Shift+M", "Ctrl+Shift+M"},
    {"file.open_mesh", "Ctrl+Alt+M", "Ctrl+Alt+M"},
    {"file.flow_results", "Ctrl+Shift+R", "Ctrl+Shift+R"},
    {"file.motion", "Ctrl+Shift+B", "Ctrl+Shift+B"},
    {"file.export_centerlines", "Ctrl+Shift+E", "Ctrl+Shift+E"},
    {"file.quit", "Ctrl+Q", "Ctrl+Q"},
    {"edit.undo", "Ctrl+Z", "Ctrl+Z"},
    {"edit.redo", "Ctrl+Shift+Z; Ctrl+Y", "Ctrl+Shift+Z; Ctrl+Y"},
    {"edit.preferences", "Ctrl+,", "Ctrl+,"},
    {"vessel.find", "Ctrl+Shift+F", "Ctrl+Shift+F"},
    {"vessel.split", "Ctrl+Shift+X", "Ctrl+Shift+X"},
    {"vessel.merge", "Ctrl+Shift+J", "Ctrl+Shift+J"},
    {"vessel.cut", "Ctrl+Shift+K", "Ctrl+Shift+K"},
    {"vessel.connect", "Ctrl+Shift+C", "Ctrl+Shift+C"},
    {"tool.browse", "Esc", "Q; Esc"},
    {"tool.drag", "E", "W"},
    {"tool.draw", "W", "D"},
    {"tool.brush", "B", "B"},
    {"tool.axis", "C", "C"},
    {"tool.add_vessel", "V", "A"},
    {"tool.distance", "D", "1"},
    {"tool.angle", "A", "2"},
    {"tool.area", "R", "3"},
    {"tool.diameter", "F", "4"},
    {"tool.stenosis", "S", "5"},
    {"tool.volume", "U", "6"},
    {"tool.ring_hu", "H", "7"},
    {"tool.smaller", ",", ","},
    {"tool.larger", ".", "."},
    {"view.turn_left", "[; Alt+Left", "[; Alt+Left"},
    {"view.turn_right", "]; Alt+Right", "]; Alt+Right"},
    {"view.proximal", "Ctrl+Up", "K; Ctrl+Up"},
    {"view.distal", "Ctrl+Down", "J; Ctrl+Down"},
    {"view.root", "Ctrl+Home", "Ctrl+Home"},
    {"view.end", "Ctrl+End", "Ctrl+End"},
    {"view.next_lesion", "L", "L"},
    {"view.previous_lesion", "Shift+L", "Shift+L"},
    {"view.next_vessel", "Ctrl+Right", "N; Ctrl+Right"},
    {"view.previous_vessel", "Ctrl+Left", "P; Ctrl+Left"},
    {"view.stretched", "T", "T"},
    {"view.mip", "M", "M"},
    {"view.mean", "Shift+M", "Shift+M"},
    {"view.thinner", "Ctrl+Alt+Down", "Ctrl+Alt+Down"},
    {"view.thicker", "Ctrl+Alt+Up", "Ctrl+Alt+Up"},
    {"view.contours", "Space", "Space"},
    {"view.outer_wall", "", ""},
    {"view.plaque", "Shift+P", "Shift+P"},
    {"view.play", "Ctrl+Space", "Ctrl+Space"},
    {"view.own_phase", "Ctrl+Shift+Space", "Ctrl+Shift+Space"},
    {"view.fit", "Ctrl+0", "F"},
    {"view.theme", "", ""},
    {"tree.select", "Ctrl+Alt+1", "Ctrl+Alt+1"},
    {"tree.straight", "Ctrl+Alt+2", "Ctrl+Alt+2"},
    {"tree.along", "Ctrl+Alt+3", "Ctrl+Alt+3"},
    {"tree.angle", "Ctrl+Alt+4", "Ctrl+Alt+4"},
    {"tree.region", "Ctrl+Alt+5", "Ctrl+Alt+5"},
    {"tree.grid", "Ctrl+Alt+6", "Ctrl+Alt+6"},
    {"tree.subtree", "Ctrl+Alt+7", "Ctrl+Alt+7"},
    {"tree.fit", "Ctrl+Alt+0", "Ctrl+Alt+0"},
    {"tree.copy", "Ctrl+Alt+C", "Ctrl+Alt+C"},
    {"tree.export", "Ctrl+Alt+E", "Ctrl+Alt+E"},
    {"tree.clear", "Ctrl+Alt+X", "Ctrl+Alt+X"},
    {"tree.close", "Ctrl+Alt+W", "Ctrl+Alt+W"},
    {"window.1", "F5", "F5"},
    {"window.2", "F6", "F6"},
    {"window.3", "F7", "F7"},
    {"window.4", "F8", "F8"},
    {"panel.next", "Ctrl+Tab", "Ctrl+Tab"},
    {"panel.previous", "Ctrl+Shift+Tab", "Ctrl+Shift+Tab"},
    {"panel.alone", "F11", "F11"},
    {"panel.vessels", "Alt+1", "Alt+1"},
    {"panel.cpr1", "Alt+2", "Alt+2"},
    {"panel.cpr2", "Alt+3", "Alt+3"},
    {"panel.section", "Alt+4", "Alt+4"},
    {"panel.slice", "Alt+5", "Alt+5"},
    {"panel.tree", "Alt+6", "Alt+6"},
    {"panel.profile", "Alt+7", "Alt+7"},
    {"panel.measurements", "Alt+8", "Alt+8"},
    {"panel.steps", "Alt+9", "Alt+9"},
    {"mouse.left", "Alt+Shift+Left", "Alt+Shift+Left"},
    {"mouse.right", "Alt+Shift+Right", "Alt+Shift+Right"},
    {"mouse.up", "Alt+Shift+Up", "Alt+Shift+Up"},
    {"mouse.down", "Alt+Shift+Down", "Alt+Shift+Down"},
    {"mouse.press", "Ins", "Ins"},
    {"help.manual", "Shift+F1", "Shift+F1"},
    {"help.shortcuts", "F1", "F1"},
    {"help.tour", "", ""},
    {"help.about", "", ""},
    {"help.find_command", "Ctrl+K", "Ctrl+K"},
};

const std::vector<ShortcutScheme> schemes{ShortcutScheme::pacs, ShortcutScheme::research};

struct OwnCommands : ::testing::Test {
  testing::Folder folder;
  MainWindow window{folder / "state"};
  const CommandTable& table = window.commands();
  static QStringList texts(const QList<QKeySequence>& keys) {
    QStringList made;
    for (const QKeySequence& one : keys) made << one.toString(QKeySequence::PortableText);
    return made;
  }
};

TEST_F(OwnCommands, HaveTheirIdsAndKeys) {
  for (const Shortcut& one : known) {
    ASSERT_TRUE(table.find(one.id)) << one.id.toStdString();
    EXPECT_EQ(texts(table.keys().in_scheme(ShortcutScheme::pacs).keys(one.id)).join("; "), one.pacs);
    EXPECT_EQ(texts(table.keys().in_scheme(ShortcutScheme::research).keys(one.id)).join("; "), one.research);
  }
}

TEST_F(OwnCommands, AreTheActionsOfTheWindowEachWithTextAndTip) {
  std::set<QString> there;
  for (const QAction* action : window.findChildren<QAction*>()) {
    if (!action->objectName().contains('.')) continue;
    EXPECT_TRUE(there.insert(action->objectName()).second) << action->objectName().toStdString();
    EXPECT_TRUE(table.find(action->objectName())) << action->objectName().toStdString();
    EXPECT_FALSE(action->text().isEmpty());
    EXPECT_FALSE(action->toolTip().isEmpty());
  }
  for (const Command& one : table.all()) EXPECT_TRUE(there.count(one.id)) << one.id.toStdString();
}

TEST_F(OwnCommands, NoTwoOfASchemeHaveTheSameKey) {
  for (const ShortcutScheme scheme : schemes) {
    const ShortcutKeys keys = table.keys().in_scheme(scheme);
    for (const Command& one : table.all())
      for (const QKeySequence& key : keys.keys(one.id)) {
        const auto other = keys.taken_by(key, one.id);
        EXPECT_FALSE(other) << one.id.toStdString() << " and " << other->toStdString();
      }
  }
}

TEST_F(OwnCommands, NoTwoOfTheWindowAnswerToOneKey) {
  std::map<QString, QString> owner;
  for (const Command& one : table.all())
    for (const QKeySequence& key : one.action->shortcuts()) {
      const auto [at, fresh] = owner.emplace(key.toString(), one.id);
      EXPECT_TRUE(fresh) << key.toString().toStdString() << ": " << at->second.toStdString() << ", "
                         << one.id.toStdString();
    }
}

TEST_F(OwnCommands, NoneHasAKeyThatViewsAnswerThemselves) {
  for (const ShortcutScheme scheme : schemes)
    for (const Command& one : table.all())
      for (const QKeySequence& key : table.keys().in_scheme(scheme).keys(one.id))
        EXPECT_FALSE(is_kept_by_views(key)) << one.id.toStdString();
}

TEST_F(OwnCommands, EveryKeyIsOneAndCanBeWritten) {
  for (const ShortcutScheme scheme : schemes)
    for (const Command& one : table.all())
      for (const QKeySequence& key : table.keys().in_scheme(scheme).keys(one.id)) {
        EXPECT_EQ(key.count(), 1) << one.id.toStdString();
        EXPECT_NE(key[0] & ~static_cast<int>(Qt::KeyboardModifierMask), Qt::Key_unknown);
        EXPECT_EQ(QKeySequence(key.toString(QKeySequence::PortableText), QKeySequence::PortableText), key);
      }
}

TEST_F(OwnCommands, EachBelongsToAPartOfTheInterface) {
  for (const Command& one : table.all())
    EXPECT_NE(command_group(one.id), one.id.section('.', 0, 0)) << one.id.toStdString();
}

TEST_F(OwnCommands, EachIsInAMenu) {
  for (const Command& one : table.all())
    EXPECT_FALSE(menus_of(*one.action).isEmpty()) << one.id.toStdString();
}

TEST_F(OwnCommands, WhatCannotBeUsedSaysWhy) {
  for (const Command& one : table.all())
    if (!one.action->isEnabled()) {
      EXPECT_FALSE(CommandTable::why_not(one).isEmpty()) << one.id.toStdString();
    }
}

TEST_F(OwnCommands, TheTourKnowsTheKeysOfAllItSpeaksOf) {
  for (const TourStep& step : tour_steps(table.keys()))
    EXPECT_FALSE(step.text.contains("no key")) << step.text.toStdString();
}

}  // namespace
}  // namespace ostia::workstation
