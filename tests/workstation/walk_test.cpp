// Walks as texts: each form there and back, and what is no step.

#include "qa/walk.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace ostia::workstation {
namespace {

using ::testing::HasSubstr;

TEST(Walk, EveryFormIsWrittenAsItIsRead) {
  const QStringList lines{
      "command view.root",
      "key lesions Ctrl+Down",
      "key cpr1 +",
      "type lesions/QLineEdit:0 \"Yes, \"tight\" (60 %) \"",
      "click vessels/QWidget:0 0.5,0.125",
      "double section 0.25,0.75 right+ctrl",
      "drag section wall wall+6,-2.5",
      "drag slice 0.1,0.2 cursor 0.3,0.4+1,0 middle+shift+alt",
      "wheel slice 0.5,0.5 -3 ctrl",
      "go 93.4,-0.6,-242.4",
      "file report",
      "look 07-report",
      "expect vessels >= 3",
      "expect blocked_ms <= 99.5",
      "expect edits = 0",
  };
  const auto steps = parse_walk("# a walk\n\n  " + lines.join("\r\n  ") + "\n", "all.walk");
  ASSERT_EQ(steps.size(), static_cast<std::size_t>(lines.size()));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(walk_line(steps[i]).toStdString(), lines[static_cast<int>(i)].toStdString());
    EXPECT_EQ(steps[i].line, static_cast<int>(i) + 3);
  }
  EXPECT_EQ(steps[7].button, Qt::MiddleButton);
  EXPECT_EQ(steps[7].held, Qt::ShiftModifier | Qt::AltModifier);
  EXPECT_EQ(steps[6].places[1].beside, QPointF(6.0, -2.5));
  EXPECT_EQ(steps[7].places[1].of, WalkPlace::Of::cursor);
  EXPECT_EQ(steps[3].text.toStdString(), "Yes, \"tight\" (60 %) ");
}

struct BadWalk : ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(BadWalk, IsRefusedWithItsLineAndTheFormThatWasExpected) {
  const auto [line, form] = GetParam();
  try {
    parse_walk(QStringLiteral("look start\n%1").arg(line), "bad.walk");
    FAIL() << line << " was taken";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("bad.walk, line 2"));
    EXPECT_THAT(error.what(), HasSubstr(form));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Lines, BadWalk,
    ::testing::Values(
        std::pair("jump cpr1", "a step begins with one of command, key"), std::pair("command", "command ID"),
        std::pair("command a b", "command ID"), std::pair("key cpr1", "key WIDGET KEY"),
        std::pair("key cpr1 Hyper+Nothing", "key WIDGET KEY"),
        std::pair("type cpr1 text", "type WIDGET \"TEXT\""),
        std::pair("type cpr1 \"", "type WIDGET \"TEXT\""), std::pair("click cpr1", "click WIDGET PLACE"),
        std::pair("click cpr1 0.5", "click WIDGET PLACE"), std::pair("click cpr1 0.5,nan", "click"),
        std::pair("click cpr1 0.5,0.5 0.6,0.6", "click WIDGET PLACE"),
        std::pair("drag cpr1 0.5,0.5", "drag WIDGET PLACE PLACE"),
        std::pair("drag cpr1 0.5,0.5 left", "drag WIDGET PLACE PLACE"),
        std::pair("wheel cpr1 0.5,0.5", "wheel WIDGET PLACE NOTCHES"),
        std::pair("wheel cpr1 0.5,0.5 up", "wheel WIDGET PLACE NOTCHES"), std::pair("go 1,2", "go X,Y,Z"),
        std::pair("look ../over", "look NAME"), std::pair("file .hidden", "file NAME"),
        std::pair("expect vessels > 3", "expect WHAT"), std::pair("expect vessels >=", "expect WHAT")));

TEST(Walk, OneWithoutAStepIsRefusedAndAFileIsNamed) {
  EXPECT_THROW(parse_walk("# nothing\n", "empty.walk"), InvalidInput);
  const auto file = std::filesystem::temp_directory_path() / "ostia-walk-test.walk";
  std::filesystem::remove(file);
  EXPECT_THROW(read_walk(file), IoError);
  core::write_file(file, "look a\nfly\n");
  try {
    read_walk(file);
    ADD_FAILURE() << "was taken";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("ostia-walk-test.walk, line 2"));
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace ostia::workstation
