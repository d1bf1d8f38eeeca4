// The commands of the program's own window: their names and keys, and that the table has all of them.

#include "commands/table.h"
#include "commands/texts.h"
#include "help/tour.h"
#include "window_hand.h"

#include <gtest/gtest.h>

#include <QAction>
#include <map>
#include <set>

namespace ostia::workstation {
namespace {

/// Ids and keys are in the settings and manuals of those who use the program.
const std::vector<Shortcut> known{
    {"file.open", "Ctrl+O", "Ctrl+O"},
    {"file.open_folder", "Ctrl+Shift+O", "Ctrl+Shift+O"},
    {"file.series", "", ""},
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
    {"plugins.look", "", ""},
    {"plugins.folder", "", ""},
    {"vessel.find", "Ctrl+Shift+F", "Ctrl+Shift+F"},
    {"vessel.split", "Ctrl+Shift+X", "Ctrl+Shift+X"},
    {"vessel.merge", "Ctrl+Shift+J", "Ctrl+Shift+J"},
    {"vessel.cut", "Ctrl+Shift+K", "Ctrl+Shift+K"},
    {"vessel.connect", "Ctrl+Shift+C", "Ctrl+Shift+C"},
    {"vessel.evaluable", "Ctrl+1", "Ctrl+1"},
    {"vessel.limited", "Ctrl+2", "Ctrl+2"},
    {"vessel.not_evaluable", "Ctrl+3", "Ctrl+3"},
    {"vessel.judged_by_program", "Ctrl+4", "Ctrl+4"},
    {"lesion.accept", "Y", "Y"},
    {"lesion.reject", "X", "X"},
    {"lesion.open", "Shift+X", "Shift+X"},
    {"lesion.comment", "Shift+K", "Shift+K"},
    {"lesion.copy", "", ""},
    {"tool.browse", "Esc", "Q; Esc"},
    {"tool.drag", "E", "W"},
    {"tool.draw", "W", "D"},
    {"tool.brush", "B", "B"},
    {"tool.axis", "C", "C"},
    {"tool.add_vessel", "V", "A"},
    {"tool.add_artery", "Shift+V", "Shift+A"},
    {"tool.distance", "D", "1"},
    {"tool.angle", "A", "2"},
    {"tool.area", "R", "3"},
    {"tool.diameter", "F", "4"},
    {"tool.stenosis", "S", "5"},
    {"tool.volume", "U", "6"},
    {"tool.ring_hu", "H", "7"},
    {"tool.arrow", "G", "8"},
    {"tool.note", "N", "9"},
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
    {"view.next_doubt", "O", "O"},
    {"view.previous_doubt", "Shift+O", "Shift+O"},
    {"view.next_vessel", "Ctrl+Right", "N; Ctrl+Right"},
    {"view.previous_vessel", "Ctrl+Left", "P; Ctrl+Left"},
    {"view.stretched", "T", "T"},
    {"view.mip", "M", "M"},
    {"view.mean", "Shift+M", "Shift+M"},
    {"view.minip", "", ""},
    {"view.thinner", "Ctrl+Shift+Down", "Ctrl+Shift+Down"},
    {"view.thicker", "Ctrl+Shift+Up", "Ctrl+Shift+Up"},
    {"view.contours", "Space", "Space"},
    {"view.outer_wall", "", ""},
    {"view.plaque", "Shift+P", "Shift+P"},
    {"view.evaluability", "", ""},
    {"view.identity", "", ""},
    {"view.play", "Ctrl+Space", "Ctrl+Space"},
    {"view.own_phase", "Ctrl+Shift+Space", "Ctrl+Shift+Space"},
    {"view.fit", "Ctrl+0", "F"},
    {"view.theme", "", ""},
    {"view.planes", "", ""},
    {"view.layout_reading", "", ""},
    {"view.layout_planes", "", ""},
    {"view.layout_flat", "", ""},
    {"view.layout_save", "", ""},
    {"view.layout_forget", "", ""},
    {"view.layout_first", "", ""},
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
    {"window.save", "", ""},
    {"window.forget", "", ""},
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
    {"panel.lesions", "Alt+0", "Alt+0"},
    {"mouse.left", "Alt+Shift+Left", "Alt+Shift+Left"},
    {"mouse.right", "Alt+Shift+Right", "Alt+Shift+Right"},
    {"mouse.up", "Alt+Shift+Up", "Alt+Shift+Up"},
    {"mouse.down", "Alt+Shift+Down", "Alt+Shift+Down"},
    {"mouse.press", "Ins", "Ins"},
    {"help.manual", "Shift+F1", "Shift+F1"},
    {"help.shortcuts", "F1", "F1"},
    {"help.tour", "", ""},
    {"help.messages", "Ctrl+Shift+L", "Ctrl+Shift+L"},
    {"help.crash_reports", "", ""},
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

TEST_F(OwnCommands, NoneHasAKeyThatWindowManagersTake) {
  for (const ShortcutScheme scheme : schemes)
    for (const Command& one : table.all())
      for (const QKeySequence& key : table.keys().in_scheme(scheme).keys(one.id))
        EXPECT_FALSE(is_kept_by_window_managers(key))
            << one.id.toStdString() << ": " << key.toString().toStdString();
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
