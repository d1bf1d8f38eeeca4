// The window on a disk without room: a limit of the size of files stands for it, which writing meets in the
// same way. Once within this process, where texts can be read, and once on the program itself with real
// events.

#include "measuring/reporting.h"
#include "real_program.h"
#include "tube_case.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/view/curved_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <QAction>
#include <QPushButton>
#include <QStandardPaths>
#include <QTest>
#include <cmath>
#include <csignal>
#include <set>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using session::Tool;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message;
using testing::open_boxes;
using testing::Program;
using testing::sweep;
using testing::TestWindow;
using testing::tube_radius_mm;
using testing::wait_until;
using testing::xdo;

constexpr rlim_t room_bytes = 4096;  // less than any commit, picture or surface

void limit_files(pid_t process, bool limited) {
  rlimit limit{};
  ASSERT_EQ(::prlimit(process, RLIMIT_FSIZE, nullptr, &limit), 0);
  limit.rlim_cur = limited ? room_bytes : limit.rlim_max;
  ASSERT_EQ(::prlimit(process, RLIMIT_FSIZE, &limit, nullptr), 0);
}

/// While it lives no file of this process grows.
class FullDisk {
 public:
  FullDisk() : before_(std::signal(SIGXFSZ, SIG_IGN)) { limit_files(0, true); }
  ~FullDisk() {
    limit_files(0, false);
    std::signal(SIGXFSZ, before_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*before_)(int);
};

struct DiskFull : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  DiskFull() {
    imaging::write_image(image, testing::tube_image());
    session::CaseFile::create(case_file, testing::tube_model(), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
  }
  static QPoint wall_on(PictureWidget& picture, double s_mm) {
    auto& cpr = static_cast<view::CurvedView&>(picture.view());
    const auto px =
        cpr.project(cpr.bench().axis()->place(s_mm, cpr.theta_deg() * M_PI / 180.0, tube_radius_mm))->px;
    return {static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y()))};
  }
  static void pull(TestWindow& test, double s_mm) {
    test.bench().tool.set(Tool::drag);
    const QPoint wall = wall_on(test.picture("cpr1"), s_mm);
    sweep(test.picture("cpr1"), {wall, wall + QPoint(3, 0), wall + QPoint(6, 0), wall + QPoint(9, 0)});
  }
  /// The dialog's own folder, beside the case, and its button.
  static void export_wall(TestWindow& test) {
    test.window().findChild<QAction*>("file.export_surface")->trigger();
    QPushButton* go = nullptr;
    ASSERT_TRUE(wait_until([&] {
      auto* dialog = test.window().findChild<QDialog*>("surface_dialog");
      go = dialog && dialog->isVisible() ? dialog->findChild<QPushButton*>("go") : nullptr;
      return go && go->isEnabled();
    }));
    QTest::mouseClick(go, Qt::LeftButton);
    QApplication::processEvents();
  }
  std::size_t stored_edits() const {
    return session::CaseFile::open(case_file, session::OpenMode::read_only).edits().size();
  }
  /// Files and folders beside the case, hidden ones too.
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(case_file.parent_path()))
      all.insert(entry.path().filename().string());
    return all;
  }
};

TEST_F(DiskFull, AnEditSaysOnceThatThereIsNoRoomAndTheWindowShowsWhatIsStored) {
  {
    TestWindow test(state);
    test.open(case_file);
    pull(test, 10.0);
    const std::string before = lumen::digest(*test.bench().model());
    {
      const FullDisk full;
      pull(test, 20.0);
      const std::string said = message();
      EXPECT_THAT(said, HasSubstr("tube.ostia"));
      EXPECT_THAT(said, HasSubstr("the case is what it was before. Make room and try again"));
      EXPECT_EQ(lumen::digest(*test.bench().model()), before);
      EXPECT_EQ(lumen::digest(*test.bench().session().file().model()), before);
      EXPECT_EQ(test.bench().session().file().edits().size(), 1U);
      test.window().findChild<QAction*>("edit.undo")->trigger();
      EXPECT_THAT(message(), HasSubstr("Make room and try again"));
      EXPECT_EQ(lumen::digest(*test.bench().model()), before);
      test.bench().tool.set(Tool::distance);
      sweep(test.picture("slice"), {QPoint(60, 60), QPoint(100, 80), QPoint(140, 120)});
      EXPECT_THAT(message(), HasSubstr("Make room and try again"));
      EXPECT_TRUE(test.bench().session().file().annotations()->measurements.empty());
    }
    pull(test, 20.0);
    EXPECT_TRUE(open_boxes().empty());
    EXPECT_EQ(test.bench().session().file().edits().size(), 2U);
    EXPECT_NE(lumen::digest(*test.bench().model()), before);
    test.window().close();
  }
  EXPECT_EQ(stored_edits(), 2U);
}

TEST_F(DiskFull, TheWindowClosesAndTheCaseOpensAgain) {
  {
    TestWindow test(state);
    test.open(case_file);
    pull(test, 10.0);
    const FullDisk full;
    test.window().close();
    EXPECT_FALSE(test.window().isVisible());
    EXPECT_FALSE(test.bench().has_case());
  }
  EXPECT_EQ(stored_edits(), 1U);
}

TEST_F(DiskFull, NothingHalfWrittenIsLeftOfReportExportAndCopy) {
  TestWindow test(state);
  test.open(case_file);
  const std::set<std::string> before = names();
  const std::string model = lumen::digest(*test.bench().model());
  const auto done = [&] { return wait_until([&] { return !test.window().jobs().any(); }, 60000); };
  {
    const FullDisk full;
    test.window().findChild<QAction*>("file.report")->trigger();
    ASSERT_TRUE(done());
    EXPECT_THAT(message(), AllOf(HasSubstr("tube-report"), HasSubstr("make room")));
    EXPECT_EQ(names(), before);
    export_wall(test);
    ASSERT_TRUE(done());
    EXPECT_THAT(message(), AllOf(HasSubstr("tube-surface"), HasSubstr("make room")));
    EXPECT_EQ(names(), before);
    for (const auto& [command, name] :
         {std::pair("file.export_centerlines", "lines.vtp"), {"file.save_as", "copy.ostia"}}) {
      testing::answer_file_dialog(folder / name);
      test.window().findChild<QAction*>(command)->trigger();
      ASSERT_TRUE(done());
      EXPECT_THAT(message(), AllOf(HasSubstr(name), HasSubstr("make room"))) << command;
      EXPECT_EQ(names(), before) << command;
    }
  }
  EXPECT_TRUE(test.bench().has_case());
  EXPECT_EQ(lumen::digest(*test.bench().model()), model);
  export_wall(test);
  ASSERT_TRUE(done());
  EXPECT_TRUE(open_boxes().empty());
  EXPECT_TRUE(fs::exists(folder / "tube-surface" / "manifest.json"));
}

// ---- the program itself ---------------------------------------------------------------------------------

struct DiskFullProgram : DiskFull {
  fs::path log = folder / "frames.jsonl";
  bool settled() const { return testing::settled(log); }
  /// Where the same window has its wall, asked of a window in this process.
  QPoint place_of_wall(double s_mm) const {
    const fs::path copy = folder / "copy.ostia";
    fs::remove(copy);
    session::CaseFile::open(case_file, session::OpenMode::read_only).copy_to(copy);
    testing::Folder other;
    session::MachineState(other / "state").remember_image(session::image_reference(image).sha256, image);
    MainWindow window(other / "state");
    window.move(0, 0);
    window.show();
    window.open(copy);
    wait_until([&] { return window.bench().has_case() && !window.jobs().any(); });
    testing::let_work(300);
    auto* cpr = window.findChild<PictureWidget*>("cpr1");
    const QPoint at = cpr->mapToGlobal(wall_on(*cpr, s_mm));
    window.close();
    return at;
  }
  static void pull_at(const QPoint& from) {
    testing::go(from + QPoint(60, 0), {"click", "1"});
    testing::keys({"e"});
    testing::pull(from, from + QPoint(8, 0));
  }
};

TEST_F(DiskFullProgram, GoesOnAfterAPullThatCouldNotBeStored) {
  if (QStandardPaths::findExecutable("xdotool").isEmpty()) GTEST_SKIP() << "xdotool is not installed";
  const QPoint wall = place_of_wall(12.0);
  {
    Program program({"--state-folder", QString::fromStdString(state.string()), "--frame-log",
                     QString::fromStdString(log.string()), "--no-tour",
                     QString::fromStdString(case_file.string())});
    ASSERT_TRUE(settled());
    const QStringList at_first = program.windows("Ostia");
    limit_files(static_cast<pid_t>(program.process.processId()), true);
    pull_at(wall);
    QStringList with_message;
    EXPECT_TRUE(wait_until(
        [&] {
          with_message = program.windows("Ostia");
          return with_message.size() == at_first.size() + 1;
        },
        10000))
        << with_message.join(' ').toStdString();
    EXPECT_TRUE(program.runs());
    limit_files(static_cast<pid_t>(program.process.processId()), false);
    for (const QString& one : at_first) with_message.removeAll(one);
    ASSERT_EQ(with_message.size(), 1);
    xdo({"mousemove", "--window", with_message.front(), "30", "20"});
    xdo({"key", "Return"});
    EXPECT_TRUE(wait_until([&] { return program.windows("Ostia").size() == at_first.size(); }, 10000));
    pull_at(wall);
    ASSERT_TRUE(settled());
    EXPECT_TRUE(program.runs());
  }
  EXPECT_EQ(stored_edits(), 1U);
}

}  // namespace
}  // namespace ostia::workstation
