#include "commands/texts.h"
#include "help/tour.h"
#include "sample_shortcuts.h"

#include <gtest/gtest.h>

#include <set>

namespace ostia::workstation {
namespace {

TEST(CommandTexts, MenuTextsLoseMnemonicsAndDots) {
  EXPECT_EQ(plain_text("&Open\u2026"), "Open");
  EXPECT_EQ(plain_text("Cut && &paste"), "Cut & paste");
}

TEST(CommandTexts, NoGestureStandsTwice) {
  std::set<std::pair<QString, QString>> seen;
  for (const MouseGesture& one : mouse_gestures()) {
    EXPECT_FALSE(one.does.isEmpty());
    EXPECT_TRUE(seen.insert({one.where, one.gesture}).second) << one.gesture.toStdString();
  }
}

TEST(Tour, HasTheKeysThatAreInUse) {
  ShortcutKeys keys(testing::sample_shortcuts());
  ASSERT_TRUE(keys.change("tool.brush", QKeySequence("X")));
  ASSERT_TRUE(keys.change("help.shortcuts", {}));
  QString all;
  for (const TourStep& step : tour_steps(keys)) all += step.text;
  EXPECT_TRUE(all.contains("brush (X)"));
  EXPECT_TRUE(all.contains("no key"));
  EXPECT_FALSE(all.contains('%')) << "a key is missing in a text";
}

TEST(Tour, HasEightToTenSteps) {
  const auto count = tour_steps(ShortcutKeys()).size();
  EXPECT_GE(count, 8u);
  EXPECT_LE(count, 10u);
}

}  // namespace
}  // namespace ostia::workstation
