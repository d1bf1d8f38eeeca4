// The program where no OpenGL, or no display, is to be had: said, never a crash.

#include "real_program.h"
#include "shell/language.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QClipboard>
#include <QGuiApplication>
#include <QRect>
#include <QScreen>
#include <QStandardPaths>
#include <QTest>

namespace ostia::workstation {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Program;
using testing::wait_until;
using testing::xdo;

constexpr int exit_without_opengl = 5;
constexpr int patience_ms = 30000;
constexpr const char* too_old = "The display's OpenGL is older than 3.2.";

QProcessEnvironment old_opengl() {
  QProcessEnvironment all = QProcessEnvironment::systemEnvironment();
  all.insert("LIBGL_ALWAYS_SOFTWARE", "1");  // Mesa's renderer says of itself what it is told to
  all.insert("MESA_GL_VERSION_OVERRIDE", "2.1");
  all.insert("LC_ALL", "C.UTF-8");
  return all;
}

QProcessEnvironment no_display() {
  QProcessEnvironment all = QProcessEnvironment::systemEnvironment();
  for (const char* one : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) all.remove(one);
  return all;
}

struct Ended {
  bool in_time = false, crashed = false;
  int code = -1;
  std::string out, errors;
};

Ended run(const QStringList& arguments, const QProcessEnvironment& environment) {
  const testing::Folder folder;
  QStringList all{"--state-folder", QString::fromStdString((folder / "state").string())};
  Program program(all + arguments, environment, QProcess::SeparateChannels);
  Ended ended;
  ended.in_time = program.process.waitForFinished(patience_ms);
  ended.crashed = program.process.exitStatus() == QProcess::CrashExit;
  ended.code = program.process.exitCode();
  ended.out = program.process.readAllStandardOutput().toStdString();
  ended.errors = program.process.readAllStandardError().toStdString();
  return ended;
}

void expect_refused(const Ended& ended) {
  EXPECT_TRUE(ended.in_time);
  EXPECT_FALSE(ended.crashed) << ended.errors;
  EXPECT_EQ(ended.code, exit_without_opengl);
  EXPECT_THAT(ended.errors, AllOf(HasSubstr("OpenGL 3.2"), HasSubstr("libgl1-mesa-dri"),
                                  HasSubstr("program ostia needs no display")));
}

/// Of a window on the screen.
QRect place_of(const QString& window) {
  QMap<QString, int> of;
  for (const QString& line : xdo({"getwindowgeometry", "--shell", window}).split('\n'))
    of[line.section('=', 0, 0)] = line.section('=', 1).toInt();
  return QRect(of["X"], of["Y"], of["WIDTH"], of["HEIGHT"]);
}

TEST(NoOpenGl, ABoxOnTheScreenSaysWhyAndTheWayOut) {
  if (QStandardPaths::findExecutable("xdotool").isEmpty()) GTEST_SKIP() << "xdotool is not installed";
  const testing::Folder folder;
  Program program({"--state-folder", QString::fromStdString((folder / "state").string())}, old_opengl(),
                  QProcess::SeparateChannels);
  QStringList boxes;
  ASSERT_TRUE(wait_until(
      [&] {
        boxes = program.windows("The workstation cannot start");
        return !boxes.isEmpty();
      },
      patience_ms));
  ASSERT_EQ(boxes.size(), 1);
  QTest::qWait(500);
  const QRect place = place_of(boxes.front());
  EXPECT_TRUE(QGuiApplication::primaryScreen()->geometry().contains(place))
      << place.width() << " x " << place.height();
  // Its texts are copied as a person would who asks for help: a click into one, Ctrl+A, Ctrl+C.
  const auto text_at = [&](const QPoint& at) {
    QGuiApplication::clipboard()->clear();
    testing::go(at, {"click", "1"});
    testing::keys({"ctrl+a", "ctrl+c"});
    QString text;
    wait_until(
        [&] {
          text = QGuiApplication::clipboard()->text();
          return !text.isEmpty();
        },
        5000);
    return text.toStdString();
  };
  EXPECT_EQ(text_at(place.topLeft() + QPoint(place.width() / 3, 20)), too_old);
  EXPECT_THAT(text_at(place.center()), HasSubstr("LIBGL_ALWAYS_SOFTWARE=1"));
  xdo({"mousemove", "--window", boxes.front(), "30", "20", "key", "Return"});
  ASSERT_TRUE(wait_until([&] { return !program.runs(); }, patience_ms)) << "Return does not close the box";
  EXPECT_EQ(program.process.exitStatus(), QProcess::NormalExit);
  EXPECT_EQ(program.process.exitCode(), exit_without_opengl);
  EXPECT_THAT(program.process.readAllStandardError().toStdString(),
              AllOf(HasSubstr(too_old), HasSubstr("LIBGL_ALWAYS_SOFTWARE=1")));
}

TEST(NoOpenGl, TheBoxSpeaksTheLanguageOfTheWindow) {
  if (QStandardPaths::findExecutable("xdotool").isEmpty()) GTEST_SKIP() << "xdotool is not installed";
  const testing::Folder folder;
  session::MachineState(folder / "state").set_setting(language_setting, "de");
  Program program({"--state-folder", QString::fromStdString((folder / "state").string())}, old_opengl(),
                  QProcess::SeparateChannels);
  EXPECT_TRUE(wait_until([&] { return !program.windows("kann nicht starten").isEmpty(); }, patience_ms));
}

TEST(NoOpenGl, WithoutADisplayItIsSaidOnStderrAlone) {
  const Ended ended = run({}, no_display());
  expect_refused(ended);
  EXPECT_THAT(ended.errors, HasSubstr("no X display"));
}

TEST(NoOpenGl, APlatformWithoutAScreenNeverWaitsForSomebodyWhoClosesABox) {
  QProcessEnvironment offscreen = no_display();
  offscreen.insert("QT_QPA_PLATFORM", "offscreen");
  expect_refused(run({}, offscreen));
  QProcessEnvironment with_display = old_opengl();
  with_display.insert("QT_QPA_PLATFORM", "offscreen");
  const Ended ended = run({}, with_display);
  expect_refused(ended);
  EXPECT_THAT(ended.errors, HasSubstr(too_old));
}

TEST(NoOpenGl, VersionAndHelpNeedNoDisplay) {
  for (const QStringList& arguments : {QStringList{"--version"}, {"--no-tour", "--version"}, {"-v"}}) {
    const Ended ended = run(arguments, no_display());
    EXPECT_EQ(ended.code, 0) << ended.errors;
    EXPECT_EQ(ended.out.find("ostia-workstation "), 0U) << ended.out;
  }
  for (const char* help : {"--help", "-h"}) {
    const Ended ended = run({help}, no_display());
    EXPECT_EQ(ended.code, 0) << ended.errors;
    EXPECT_THAT(ended.out, AllOf(HasSubstr("ostia-workstation"), HasSubstr("--sample"),
                                 HasSubstr("The coronary modelling workstation.")));
  }
}

}  // namespace
}  // namespace ostia::workstation
