// A button that goes up unseen, because a dialog took its release, ends what the hand was doing.

#include "tube_case.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/view/curved_view.h"

#include <gtest/gtest.h>

#include <QDialog>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::send;
using testing::TestWindow;
using testing::wait_until;

struct LostButton : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  LostButton() {
    imaging::write_image(image, testing::tube_image());
    session::CaseFile::create(case_file, testing::tube_model(), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
  }
  /// The wall is pulled on a CPR and the button is still down. Returns where the hand is.
  static QPoint begin_pull(TestWindow& test, PictureWidget& cpr) {
    test.bench().tool.set(session::Tool::drag);
    auto& view = dynamic_cast<view::CurvedView&>(cpr.view());
    const auto shown = view.project(
        test.bench().axis()->place(20.0, view.theta_deg() * M_PI / 180.0, testing::tube_radius_mm));
    const double density = cpr.devicePixelRatioF();
    const QPoint wall(static_cast<int>(shown->px.x() / density), static_cast<int>(shown->px.y() / density));
    send(cpr, QEvent::MouseButtonPress, wall, Qt::LeftButton, Qt::LeftButton);
    send(cpr, QEvent::MouseMove, wall + QPoint(6, 0), Qt::NoButton, Qt::LeftButton);
    send(cpr, QEvent::MouseMove, wall + QPoint(10, 0), Qt::NoButton, Qt::LeftButton);
    return wall + QPoint(10, 0);
  }
  static std::size_t edits(TestWindow& test) { return test.bench().session().file().edits().size(); }
};

TEST_F(LostButton, AMoveWithoutAButtonPullsNoMore) {
  TestWindow test(state);
  test.open(case_file);
  PictureWidget& cpr = test.picture("cpr1");
  const QPoint at = begin_pull(test, cpr);
  ASSERT_EQ(edits(test), 1U);
  const std::string pulled = lumen::digest(*test.bench().model());
  send(cpr, QEvent::MouseMove, at + QPoint(25, 0), Qt::NoButton, Qt::NoButton);
  EXPECT_EQ(lumen::digest(*test.bench().model()), pulled);
  EXPECT_FALSE(cpr.pointer().holding());
  EXPECT_EQ(edits(test), 1U);
}

TEST_F(LostButton, ADialogOverTheWindowEndsAPull) {
  TestWindow test(state);
  test.open(case_file);
  PictureWidget& cpr = test.picture("cpr1");
  begin_pull(test, cpr);
  ASSERT_TRUE(cpr.pointer().holding());
  QDialog dialog(&test.window());
  dialog.setModal(true);
  dialog.show();
  EXPECT_TRUE(wait_until([&] { return !cpr.pointer().holding(); }, 2000));
  EXPECT_EQ(edits(test), 1U);
}

}  // namespace
}  // namespace ostia::workstation
