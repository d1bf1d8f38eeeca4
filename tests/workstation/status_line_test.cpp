// What the line below the views does with texts that are longer than their room.

#include "shell/status_line.h"

#include "test_desk.h"
#include "window_hand.h"

#include <gmock/gmock.h>

namespace ostia::workstation {
namespace {

using ::testing::EndsWith;
using ::testing::StartsWith;
using testing::TestWindow;

constexpr const char* ellipsis = "\u2026";

struct StatusLineTest : ::testing::Test {
  testing::Folder folder;
  TestWindow test{folder / "state"};
  StatusLine& line() { return dynamic_cast<StatusLine&>(*test.window().statusBar()); }
  ElidedLabel& name() { return *test.window().findChild<ElidedLabel*>("shown_name"); }
  void say(const QString& message, const QString& file) {
    test.window().desk().messages.set_shown_name(file);
    test.window().desk().messages.say(message);
    QApplication::processEvents();
  }
  /// Of the line, where nothing but the message is: pixels that are not its ground.
  int last_painted_before(int end) {
    const QImage shown = line().grab().toImage();
    for (int x = end - 1; x >= 0; --x)
      for (int y = 3; y < shown.height() - 3; ++y)
        if (shown.pixel(x, y) != shown.pixel(end - 1, y)) return x;
    return -1;
  }
};

TEST_F(StatusLineTest, ALongMessageEndsInAnEllipsisBeforeTheNameAndIsWholeAsATip) {
  test.window().resize(1280, 900);
  const QString message = QString("a long word ").repeated(40).trimmed();
  say(message, "heart.nrrd");
  EXPECT_EQ(line().currentMessage(), message);
  EXPECT_EQ(line().toolTip(), message);
  const std::string shown = line().shown_message().toStdString();
  EXPECT_THAT(shown, EndsWith(ellipsis));
  EXPECT_THAT(message.toStdString(), StartsWith(shown.substr(0, shown.size() - 3)));
  ASSERT_TRUE(name().isVisible());
  const int painted = last_painted_before(name().x());
  EXPECT_GT(painted, name().x() / 2);
  EXPECT_LT(painted, name().x() - 3) << "the message runs into the name";
  EXPECT_EQ(name().shown_text(), "heart.nrrd");
  EXPECT_EQ(name().toolTip(), "");
}

TEST_F(StatusLineTest, AShortMessageIsWhole) {
  say("The wall was pushed.", "heart.nrrd");
  EXPECT_EQ(line().shown_message(), "The wall was pushed.");
  test.window().resize(700, 700);
  QApplication::processEvents();
  say(QString("word ").repeated(100), "heart.nrrd");
  EXPECT_NE(line().shown_message(), line().currentMessage());
}

TEST_F(StatusLineTest, ALongNameGivesWayInItsMiddle) {
  const QString file =
      "coronary-angiogram-of-the-first-visit-" + QString("reconstruction-").repeated(12) + "75.nrrd";
  say("Saved.", file);
  EXPECT_EQ(name().text(), file);
  EXPECT_EQ(name().toolTip(), file);
  const std::string shown = name().shown_text().toStdString();
  EXPECT_THAT(shown, StartsWith("coronary"));
  EXPECT_THAT(shown, EndsWith("75.nrrd"));
  EXPECT_LE(name().width(), 40 * name().fontMetrics().averageCharWidth());
  EXPECT_EQ(line().shown_message(), "Saved.");
  say("Saved.", "a.nrrd");
  EXPECT_EQ(name().toolTip(), "");
  EXPECT_EQ(name().shown_text(), "a.nrrd");
}

}  // namespace
}  // namespace ostia::workstation
