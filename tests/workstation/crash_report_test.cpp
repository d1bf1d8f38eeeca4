// A program that crashes leaves a report that names nobody.

#include "commands/table.h"
#include "help/crash_reports.h"
#include "shell/crash_watch.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/core/version.h"
#include "ostia/session/machine_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QAction>
#include <QPlainTextEdit>
#include <QProcess>
#include <QPushButton>
#include <QTest>
#include <csignal>
#include <cstdlib>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TestWindow;
using testing::wait_until;

constexpr const char* patient = "DOE_JANE_4711";

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

/// The signal by which a child ends that does this.
template <class Act>
int ends_by(const Act& act) {
  const pid_t child = ::fork();
  if (child == 0) {
    act();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

struct CrashReport : ::testing::Test {
  testing::Folder folder;
  const fs::path state = folder / patient, reports = crash_folder(state);
  CrashReport() { fs::create_directories(state); }
  std::string report() {
    const auto left = crash_reports(reports);
    return left.size() == 1 ? core::read_file(left.front()) : std::to_string(left.size()) + " reports";
  }
};

TEST_F(CrashReport, SaysWhatWasDoneAndWhereAndNamesNobody) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) {
    fs::remove_all(reports);
    EXPECT_EQ(ends_by([&] {
                const CrashWatch watch(reports);
                for (int i = 0; i < 30; ++i) note_command("view.step" + std::to_string(i));
                note_command("edit.undo");
                ::raise(signal);
              }),
              signal);
    EXPECT_EQ(mode_of(reports), 0700U);
    ASSERT_EQ(crash_reports(reports).size(), 1U);
    EXPECT_EQ(mode_of(crash_reports(reports).front()), 0600U);
    const std::string text = report();
    EXPECT_THAT(text, HasSubstr("version: " + core::version()));
    EXPECT_THAT(text, HasSubstr("view.step29\n  edit.undo\n"));
    EXPECT_THAT(text, Not(HasSubstr("view.step6\n"))) << "the last 24 alone";
    EXPECT_THAT(text, HasSubstr(" +0x"));
    EXPECT_THAT(text, Not(HasSubstr(patient)));
    EXPECT_EQ(text.find('/'), std::string::npos) << text;
  }
}

__attribute__((noinline)) int endless(int depth) {
  volatile char room[4096];
  room[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : endless(depth + 1) + room[0];
}

TEST_F(CrashReport, IsWrittenWhenTheStackIsFullAndForANullPointer) {
  EXPECT_EQ(ends_by([&] {
              const CrashWatch watch(reports);
              volatile int sink = endless(1);
              (void)sink;
            }),
            SIGSEGV);
  EXPECT_THAT(report(), HasSubstr("SIGSEGV"));
  fs::remove_all(reports);
  EXPECT_EQ(ends_by([&] {
              const CrashWatch watch(reports);
              volatile int* nowhere = nullptr;
              *nowhere = 1;
            }),
            SIGSEGV);
  EXPECT_THAT(report(), HasSubstr("call stack"));
}

TEST_F(CrashReport, WhereNoneCanBeWrittenTheProgramEndsAllTheSame) {
  core::write_file(reports, "a file where the folder should be");
  EXPECT_EQ(ends_by([&] {
              const CrashWatch watch(reports);
              ::raise(SIGSEGV);
            }),
            SIGSEGV);
}

TEST_F(CrashReport, WithoutACrashThereIsNoFolder) {
  EXPECT_EQ(ends_by([&] { const CrashWatch watch(reports); }), 0);
  EXPECT_FALSE(fs::exists(reports));
  TestWindow test(state);
  testing::let_rest();
  EXPECT_TRUE(testing::open_boxes().empty());
  EXPECT_FALSE(test.window().findChild<QAction*>("help.crash_reports")->isEnabled());
}

TEST_F(CrashReport, IsOfferedOnceAndCanBeLookedAtAndDeleted) {
  ends_by([&] {
    const CrashWatch watch(reports);
    note_command("tool.drag");
    ::raise(SIGSEGV);
  });
  {
    TestWindow test(state);
    ASSERT_TRUE(wait_until([] { return !testing::open_boxes().empty(); }));
    QMessageBox* box = testing::open_boxes().front();
    EXPECT_EQ(box->objectName(), "crash_report");
    QTest::mouseClick(box->buttons().front(), Qt::LeftButton);
    ASSERT_TRUE(wait_until([&] { return test.window().findChild<CrashReportDialog*>() != nullptr; }));
    EXPECT_TRUE(test.window().findChild<QPlainTextEdit*>("crash_text")->toPlainText().contains("tool.drag"));
    test.window().findChild<CrashReportDialog*>()->reject();
  }
  TestWindow test(state);
  testing::let_rest();
  EXPECT_TRUE(testing::open_boxes().empty()) << "it was offered before";
  test.window().findChild<QAction*>("help.crash_reports")->trigger();
  ASSERT_TRUE(wait_until([&] { return test.window().findChild<QPushButton*>("crash_delete") != nullptr; }));
  QTest::mouseClick(test.window().findChild<QPushButton*>("crash_delete"), Qt::LeftButton);
  EXPECT_TRUE(crash_reports(reports).empty());
  test.window().commands().refresh();
  EXPECT_FALSE(test.window().findChild<QAction*>("help.crash_reports")->isEnabled());
}

TEST_F(CrashReport, TheFolderIsLookedIntoWhenItIsNeededAndNotWithEveryRefresh) {
  fs::create_directories(reports);
  core::write_file(reports / "crash-1-1.txt", "of an older session");
  TestWindow test(state);
  for (QMessageBox* box : testing::open_boxes()) box->close();
  const QAction& action = *test.window().findChild<QAction*>("help.crash_reports");
  ASSERT_TRUE(action.isEnabled());
  fs::remove_all(reports);
  test.window().commands().refresh();
  EXPECT_TRUE(action.isEnabled()) << "nobody has looked";
  CrashReports of_its_own(test.window().desk());
  EXPECT_FALSE(of_its_own.any());
}

TEST_F(CrashReport, OfTheProgramItselfHasNoPathAndNoName) {
  const fs::path case_file = folder / (std::string(patient) + ".ostia");
  session::CaseFile::create(case_file, testing::tube_model(), {});
  QProcess program;
  program.start(OSTIA_WORKSTATION, {"--no-tour", "--state-folder", QString::fromStdString(state.string()),
                                    QString::fromStdString(case_file.string())});
  ASSERT_TRUE(program.waitForStarted());
  ASSERT_TRUE(wait_until([&] { return !session::MachineState(state).recent_cases().empty(); }, 60000))
      << "the case was not opened";
  QTest::qWait(2000);
  ASSERT_EQ(::kill(static_cast<pid_t>(program.processId()), SIGSEGV), 0);
  ASSERT_TRUE(wait_until([&] { return program.state() == QProcess::NotRunning; }, 30000));
  EXPECT_EQ(program.exitStatus(), QProcess::CrashExit);
  const std::string text = report();
  EXPECT_THAT(text, HasSubstr("SIGSEGV"));
  EXPECT_THAT(text, Not(HasSubstr("DOE")));
  EXPECT_EQ(text.find('/'), std::string::npos) << text;
}

}  // namespace
}  // namespace ostia::workstation
