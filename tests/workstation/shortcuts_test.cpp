#include "commands/shortcuts.h"

#include <gtest/gtest.h>

#include <set>

namespace ostia::workstation {
namespace {

const std::vector<ShortcutScheme> schemes{ShortcutScheme::pacs, ShortcutScheme::research};

TEST(Shortcuts, NoTwoCommandsOfASchemeHaveTheSameKey) {
  for (const ShortcutScheme scheme : schemes) {
    const ShortcutKeys keys(scheme);
    for (const Shortcut& one : shortcuts())
      for (const QKeySequence& key : keys.keys(one.id)) {
        const auto other = keys.taken_by(key, one.id);
        EXPECT_FALSE(other) << one.id.toStdString() << " and " << other->toStdString();
      }
  }
}

TEST(Shortcuts, NoCommandHasAKeyThatViewsAnswerThemselves) {
  for (const ShortcutScheme scheme : schemes)
    for (const Shortcut& one : shortcuts())
      for (const QKeySequence& key : keys_of(one.id, scheme))
        EXPECT_FALSE(is_kept_by_views(key)) << one.id.toStdString();
}

TEST(Shortcuts, EveryKeyOfTheTableIsOneAndCanBeWritten) {
  std::set<QString> ids;
  for (const Shortcut& one : shortcuts()) {
    EXPECT_TRUE(ids.insert(one.id).second) << one.id.toStdString() << " stands there twice";
    for (const ShortcutScheme scheme : schemes)
      for (const QKeySequence& key : keys_of(one.id, scheme)) {
        EXPECT_EQ(key.count(), 1) << one.id.toStdString();
        EXPECT_NE(key[0] & ~static_cast<int>(Qt::KeyboardModifierMask), Qt::Key_unknown);
        EXPECT_EQ(QKeySequence(key.toString(QKeySequence::PortableText), QKeySequence::PortableText), key);
      }
  }
  EXPECT_EQ(keys_of("tool.brush", ShortcutScheme::pacs), QList<QKeySequence>{QKeySequence("B")});
  EXPECT_TRUE(keys_of("no.such", ShortcutScheme::pacs).isEmpty());
}

TEST(Shortcuts, ASecondKeyOfACommandIsReadToo) {
  const QList<QKeySequence> redo = keys_of("edit.redo", ShortcutScheme::pacs);
  EXPECT_EQ(redo, (QList<QKeySequence>{QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")}));
}

TEST(Shortcuts, AKeyOfAnotherCommandIsRefused) {
  ShortcutKeys keys(ShortcutScheme::pacs);
  EXPECT_FALSE(keys.change("tool.draw", QKeySequence("B")));
  EXPECT_EQ(*keys.taken_by(QKeySequence("B"), "tool.draw"), "tool.brush");
  EXPECT_EQ(keys.keys("tool.draw"), keys_of("tool.draw", ShortcutScheme::pacs));
  EXPECT_FALSE(keys.change("tool.draw", QKeySequence("Up")));
  EXPECT_TRUE(keys.change("tool.draw", QKeySequence("X")));
  EXPECT_TRUE(keys.change("tool.draw", QKeySequence("X"))) << "its own key";
  EXPECT_FALSE(keys.change("tool.brush", QKeySequence("X")));
}

TEST(Shortcuts, AKeyThatBeginsLikeAnotherIsRefused) {
  ShortcutKeys keys;
  EXPECT_FALSE(keys.change("file.sample", QKeySequence("B, X")));
}

TEST(Shortcuts, AKeyTakenAwayCanBeGivenToAnother) {
  ShortcutKeys keys;
  ASSERT_TRUE(keys.change("tool.brush", {}));
  EXPECT_TRUE(keys.keys("tool.brush").isEmpty());
  EXPECT_TRUE(keys.change("tool.draw", QKeySequence("B")));
  EXPECT_FALSE(keys.reset("tool.brush")) << "its key belongs to another one now";
  ASSERT_TRUE(keys.reset("tool.draw"));
  EXPECT_TRUE(keys.reset("tool.brush"));
  EXPECT_EQ(keys.keys("tool.brush"), keys_of("tool.brush", ShortcutScheme::pacs));
}

TEST(Shortcuts, SettingsBringBackWhatWasChanged) {
  ShortcutKeys keys(ShortcutScheme::research);
  ASSERT_TRUE(keys.change("tool.brush", {}));
  ASSERT_TRUE(keys.change("tool.draw", QKeySequence("B")));
  ASSERT_TRUE(keys.change("plugin.run", QKeySequence("Ctrl+Alt+R")));  // not in the table
  const auto settings = keys.settings(ShortcutKeys());
  EXPECT_EQ(settings.at("shortcuts"), "research");
  EXPECT_EQ(settings.at("shortcut.tool.brush"), "none");
  const ShortcutKeys again = ShortcutKeys::from(settings);
  EXPECT_EQ(again.scheme(), ShortcutScheme::research);
  for (const char* id : {"tool.brush", "tool.draw", "tool.area", "plugin.run"})
    EXPECT_EQ(again.keys(id), keys.keys(id)) << id;
  EXPECT_EQ(*again.taken_by(QKeySequence("Ctrl+Alt+R")), "plugin.run");
}

TEST(Shortcuts, WhatIsNoLongerChangedIsWrittenAsDefault) {
  ShortcutKeys before;
  ASSERT_TRUE(before.change("tool.draw", QKeySequence("X")));
  auto stored = before.settings(ShortcutKeys());
  ShortcutKeys after = before;
  ASSERT_TRUE(after.reset("tool.draw"));
  for (const auto& [name, value] : after.settings(before)) stored[name] = value;
  EXPECT_EQ(stored.at("shortcut.tool.draw"), "default");
  EXPECT_FALSE(ShortcutKeys::from(stored).is_changed("tool.draw"));
}

TEST(Shortcuts, DamagedOrClashingSettingsAreLeftOut) {
  const ShortcutKeys keys = ShortcutKeys::from({{"shortcuts", "nonsense"},
                                                {"shortcut.tool.draw", "B"},
                                                {"shortcut.tool.area", "Up"},
                                                {"shortcut.tool.angle", ""},
                                                {"theme", "dark"}});
  EXPECT_EQ(keys.scheme(), ShortcutScheme::pacs);
  for (const char* id : {"tool.draw", "tool.area", "tool.angle"})
    EXPECT_EQ(keys.keys(id), keys_of(id, ShortcutScheme::pacs)) << id;
}

TEST(Shortcuts, TwoCommandsGivenOneKeyByHandDoNotBothKeepIt) {
  const ShortcutKeys keys = ShortcutKeys::from({{"shortcut.tool.draw", "X"}, {"shortcut.tool.area", "X"}});
  EXPECT_NE(keys.is_changed("tool.draw"), keys.is_changed("tool.area"));
}

}  // namespace
}  // namespace ostia::workstation
