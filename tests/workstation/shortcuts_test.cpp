#include "sample_shortcuts.h"

#include <gtest/gtest.h>

namespace ostia::workstation {
namespace {

ShortcutKeys sample_keys(ShortcutScheme scheme = ShortcutScheme::pacs) {
  return ShortcutKeys(testing::sample_shortcuts(), scheme);
}

TEST(Shortcuts, EachSchemeHasItsOwnKeys) {
  EXPECT_EQ(sample_keys().keys("tool.draw"), QList<QKeySequence>{QKeySequence("W")});
  EXPECT_EQ(sample_keys(ShortcutScheme::research).keys("tool.draw"), QList<QKeySequence>{QKeySequence("D")});
  EXPECT_EQ(sample_keys().in_scheme(ShortcutScheme::research).keys("tool.draw"),
            QList<QKeySequence>{QKeySequence("D")});
  EXPECT_TRUE(sample_keys().keys("no.such").isEmpty());
  EXPECT_TRUE(ShortcutKeys().keys("tool.draw").isEmpty());
}

TEST(Shortcuts, ASecondKeyOfACommandIsReadToo) {
  const QList<QKeySequence> redo = sample_keys().keys("edit.redo");
  EXPECT_EQ(redo, (QList<QKeySequence>{QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")}));
}

TEST(Shortcuts, AKeyOfAnotherCommandIsRefused) {
  ShortcutKeys keys = sample_keys();
  EXPECT_FALSE(keys.change("tool.draw", QKeySequence("B")));
  EXPECT_EQ(*keys.taken_by(QKeySequence("B"), "tool.draw"), "tool.brush");
  EXPECT_EQ(keys.keys("tool.draw"), sample_keys().keys("tool.draw"));
  EXPECT_FALSE(keys.change("tool.draw", QKeySequence("Up")));
  EXPECT_TRUE(keys.change("tool.draw", QKeySequence("X")));
  EXPECT_TRUE(keys.change("tool.draw", QKeySequence("X"))) << "its own key";
  EXPECT_FALSE(keys.change("tool.brush", QKeySequence("X")));
}

TEST(Shortcuts, KeysOfWindowManagersAreKnown) {
  for (const char* taken :
       {"Alt+F4", "Alt+F10", "Ctrl+F2", "Ctrl+Alt+Up", "Ctrl+Alt+Shift+Left", "Meta+E", "Alt+Tab",
        "Alt+Space", "Ctrl+Esc", "Ctrl+Alt+Del", "Ctrl+Alt+L", "Ctrl+Alt+F1", "Print"})
    EXPECT_TRUE(is_kept_by_window_managers(QKeySequence(taken))) << taken;
  for (const char* free : {"F1", "F11", "Shift+F1", "Alt+1", "Ctrl+Up", "Ctrl+Shift+Up", "Esc", "Ctrl+Tab",
                           "Alt+Shift+Left", "Ctrl+Alt+M", "Space", "L", "Ctrl+L"})
    EXPECT_FALSE(is_kept_by_window_managers(QKeySequence(free))) << free;
}

TEST(Shortcuts, AKeyThatBeginsLikeAnotherIsRefused) {
  ShortcutKeys keys = sample_keys();
  EXPECT_FALSE(keys.change("file.sample", QKeySequence("B, X")));
}

TEST(Shortcuts, AKeyTakenAwayCanBeGivenToAnother) {
  ShortcutKeys keys = sample_keys();
  ASSERT_TRUE(keys.change("tool.brush", {}));
  EXPECT_TRUE(keys.keys("tool.brush").isEmpty());
  EXPECT_TRUE(keys.change("tool.draw", QKeySequence("B")));
  EXPECT_FALSE(keys.reset("tool.brush")) << "its key belongs to another one now";
  ASSERT_TRUE(keys.reset("tool.draw"));
  EXPECT_TRUE(keys.reset("tool.brush"));
  EXPECT_EQ(keys.keys("tool.brush"), sample_keys().keys("tool.brush"));
}

TEST(Shortcuts, SettingsBringBackWhatWasChanged) {
  ShortcutKeys keys = sample_keys(ShortcutScheme::research);
  ASSERT_TRUE(keys.change("tool.brush", {}));
  ASSERT_TRUE(keys.change("tool.draw", QKeySequence("B")));
  ASSERT_TRUE(keys.change("plugin.run", QKeySequence("Ctrl+Alt+R")));  // not in the table
  const auto settings = keys.settings(sample_keys());
  EXPECT_EQ(settings.at("shortcuts"), "research");
  EXPECT_EQ(settings.at("shortcut.tool.brush"), "none");
  const ShortcutKeys again = ShortcutKeys::from(settings, testing::sample_shortcuts());
  EXPECT_EQ(again.scheme(), ShortcutScheme::research);
  for (const char* id : {"tool.brush", "tool.draw", "tool.area", "plugin.run"})
    EXPECT_EQ(again.keys(id), keys.keys(id)) << id;
  EXPECT_EQ(*again.taken_by(QKeySequence("Ctrl+Alt+R")), "plugin.run");
}

TEST(Shortcuts, WhatIsNoLongerChangedIsWrittenAsDefault) {
  ShortcutKeys before = sample_keys();
  ASSERT_TRUE(before.change("tool.draw", QKeySequence("X")));
  auto stored = before.settings(sample_keys());
  ShortcutKeys after = before;
  ASSERT_TRUE(after.reset("tool.draw"));
  for (const auto& [name, value] : after.settings(before)) stored[name] = value;
  EXPECT_EQ(stored.at("shortcut.tool.draw"), "default");
  EXPECT_FALSE(ShortcutKeys::from(stored, testing::sample_shortcuts()).is_changed("tool.draw"));
}

TEST(Shortcuts, DamagedOrClashingSettingsAreLeftOut) {
  const ShortcutKeys keys = ShortcutKeys::from({{"shortcuts", "nonsense"},
                                                {"shortcut.tool.draw", "B"},
                                                {"shortcut.tool.area", "Up"},
                                                {"shortcut.tool.angle", ""},
                                                {"theme", "dark"}},
                                               testing::sample_shortcuts());
  EXPECT_EQ(keys.scheme(), ShortcutScheme::pacs);
  for (const char* id : {"tool.draw", "tool.area", "tool.angle"})
    EXPECT_EQ(keys.keys(id), sample_keys().keys(id)) << id;
}

TEST(Shortcuts, TwoCommandsGivenOneKeyByHandDoNotBothKeepIt) {
  const ShortcutKeys keys = ShortcutKeys::from({{"shortcut.tool.draw", "X"}, {"shortcut.tool.area", "X"}},
                                               testing::sample_shortcuts());
  EXPECT_NE(keys.is_changed("tool.draw"), keys.is_changed("tool.area"));
}

}  // namespace
}  // namespace ostia::workstation
