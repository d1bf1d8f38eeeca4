// The program itself, driven by the X server's own events (xdotool), killed, and started again.

#include "real_program.h"
#include "tube_case.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/open_mark.h"

#include <gtest/gtest.h>

#include <QStandardPaths>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using session::Tool;
using testing::Program;
using testing::wait_until;

struct RealEvents : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state",
           log = folder / "frames.jsonl";
  RealEvents() {
    imaging::ImageVolume volume;
    volume.geometry.size = {64, 64, 110};
    volume.geometry.spacing = {0.4, 0.4, 0.4};
    volume.geometry.origin = {-12.6, -12.6, -2.0};
    volume.voxels.assign(static_cast<std::size_t>(volume.geometry.voxels()), 100);
    imaging::write_image(image, volume);
    session::CaseFile::create(case_file, testing::tube_model(), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
  }
  QStringList arguments(bool with_case) const {
    QStringList all{"--state-folder", QString::fromStdString(state.string()), "--frame-log",
                    QString::fromStdString(log.string()), "--no-tour"};
    if (with_case) all << QString::fromStdString(case_file.string());
    return all;
  }
  bool settled() const { return testing::settled(log); }
  std::size_t stored_edits() const {
    return session::CaseFile::open(case_file, session::OpenMode::read_only).edits().size();
  }
};

TEST_F(RealEvents, ADrawnStrokeIsInTheCaseAfterAKillAndTheProgramComesBackToIt) {
  if (QStandardPaths::findExecutable("xdotool").isEmpty()) GTEST_SKIP() << "xdotool is not installed";
  QPoint from, to;
  {
    // Where the same window has its wall and its button, asked of a window in this process.
    const fs::path copy = folder / "copy.ostia";
    session::CaseFile::open(case_file, session::OpenMode::read_only).copy_to(copy);
    testing::Folder other;
    session::MachineState(other / "state").remember_image(session::image_reference(image).sha256, image);
    MainWindow window(other / "state");
    window.move(0, 0);
    window.show();
    window.open(copy);
    ASSERT_TRUE(wait_until([&] { return window.bench().has_case() && !window.jobs().any(); }));
    testing::let_work(300);
    auto* cpr = window.findChild<PictureWidget*>("cpr1");
    const auto axis = window.bench().axis();
    const auto wall = cpr->view().project(axis->place(12.0, 0.0, 1.5));
    from = cpr->mapToGlobal(QPoint(static_cast<int>(wall->px.x()), static_cast<int>(wall->px.y())));
    to = from + QPoint(10, 0);
    window.close();
  }
  {
    Program program(arguments(true));
    ASSERT_TRUE(settled());
    // The tool by its key: the view has the focus after a click beside the vessel.
    testing::go(from + QPoint(60, 0), {"click", "1"});
    testing::keys({"e"});
    testing::pull(from, to);
    ASSERT_TRUE(settled());
    program.process.kill();  // SIGKILL: nothing can be tidied up
    program.process.waitForFinished();
  }
  EXPECT_EQ(stored_edits(), 1U);
  fs::remove(log);
  Program again(arguments(false));
  EXPECT_TRUE(settled());  // a CPR is painted, though no case was named
}

TEST_F(RealEvents, AVesselIsCutWithMouseAndKeysAndConnectedAgain) {
  if (QStandardPaths::findExecutable("xdotool").isEmpty()) GTEST_SKIP() << "xdotool is not installed";
  QPoint place;
  {
    const fs::path copy = folder / "copy.ostia";
    session::CaseFile::open(case_file, session::OpenMode::read_only).copy_to(copy);
    testing::Folder other;
    session::MachineState(other / "state").remember_image(session::image_reference(image).sha256, image);
    MainWindow window(other / "state");
    window.move(0, 0);
    window.show();
    window.open(copy);
    ASSERT_TRUE(wait_until([&] { return window.bench().has_case() && !window.jobs().any(); }));
    testing::let_work(300);
    auto* cpr = window.findChild<PictureWidget*>("cpr1");
    const auto axis = window.bench().axis();
    const auto px = cpr->view().project(axis->point(22.0))->px;
    place = cpr->mapToGlobal(QPoint(static_cast<int>(px.x()), static_cast<int>(px.y())));
    window.close();
  }
  Program program(arguments(true));
  ASSERT_TRUE(settled());
  testing::go(place, {"click", "1"});
  ASSERT_TRUE(settled());
  testing::keys({"ctrl+shift+k"});
  ASSERT_TRUE(settled());
  // The cursor stays at the end of what is left; the view has another scale now.
  testing::keys({"ctrl+Home"});
  for (int i = 0; i < 20; ++i) testing::keys({"ctrl+Down"});
  testing::keys({"ctrl+shift+c"});
  QTest::qWait(500);
  testing::keys({"Down", "Return"});
  ASSERT_TRUE(settled());
  program.process.kill();
  program.process.waitForFinished();
  const session::CaseFile kept = session::CaseFile::open(case_file, session::OpenMode::read_only);
  ASSERT_EQ(kept.edits().size(), 2U);
  EXPECT_EQ(lumen::op_name(kept.edits()[0]), "branch.cut");
  EXPECT_EQ(lumen::op_name(kept.edits()[1]), "branch.connect");
  EXPECT_NEAR(std::get<lumen::BranchCut>(kept.edits()[0]).s_mm, 22.0, 0.5);
  EXPECT_NEAR(std::get<lumen::BranchConnect>(kept.edits()[1]).at.z(), 10.0, 0.1);
  EXPECT_EQ(geometry::roots(kept.model()->tree).size(), 1U);
}

TEST_F(RealEvents, AProgramThatIsAskedToEndClosesItsCaseAndTheNextStartIsAFreshOne) {
  {
    Program program(arguments(true));
    ASSERT_TRUE(settled());
    program.process.terminate();  // SIGTERM: a logout, `kill`
    ASSERT_TRUE(program.process.waitForFinished());
    EXPECT_EQ(program.process.exitStatus(), QProcess::NormalExit);
    EXPECT_EQ(program.process.exitCode(), 0);
  }
  EXPECT_TRUE(session::OpenMark(state).take_left().empty());
}

}  // namespace
}  // namespace ostia::workstation
