// The fat about an artery in the window: measured when its page is opened, told in the page, coloured on the
// CPRs, gone with the page.

#include "tube_window.h"
#include "vessels/fat.h"
#include "views/picture_widget.h"

#include <gmock/gmock.h>

#include <QTreeWidget>
#include <algorithm>
#include <vector>

namespace ostia::workstation {
namespace {

using ::testing::HasSubstr;
using testing::wait_until;

/// The tube is named LAD and lies in fat of -80 HU with noise of up to 20 HU.
struct FatWindow : testing::TubeWindow {
  void key_of_the_page() {
    QApplication::setActiveWindow(&window());
    QTest::keyClick(window().windowHandle(), Qt::Key_F, Qt::ControlModifier | Qt::AltModifier);
    QApplication::processEvents();
  }
  bool is_known() {
    return wait_until([&] { return window().fat().board().known() && idle(); }, 60000);
  }
};

TEST_F(FatWindow, ItsPageTellsTheIndexAndTheCprsShowWhereTheFatIs) {
  open_case();
  EXPECT_FALSE(part<QWidget>("fat")->isVisible()) << "off by default";
  EXPECT_TRUE(coloured("cpr1").empty());
  key_of_the_page();
  ASSERT_TRUE(is_known());
  settle();
  auto* vessels = part<QTreeWidget>("fat_vessels");
  ASSERT_EQ(vessels->topLevelItemCount(), 1);
  EXPECT_EQ(vessels->topLevelItem(0)->text(0), "LAD");
  EXPECT_NEAR(vessels->topLevelItem(0)->text(2).toDouble(), -80.0, 6.0);
  EXPECT_THAT(part<QLabel>("fat_state")->text().toStdString(), HasSubstr("voltage"));
  const QImage kept = testing::on_screen(window(), "fat");
  EXPECT_FALSE(kept.isNull());
  const std::vector<view::Role> found = coloured("cpr1");
  const auto count = [&](view::Role role) { return std::count(found.begin(), found.end(), role); };
  // -80 HU +- 20: nearly all between -110 and -70, some above.
  EXPECT_GT(count(view::Role::fat_middle), 2 * count(view::Role::fat_bright));
  EXPECT_EQ(count(view::Role::fat_dark), 0);
  // A diameter on either side of the outer wall, as far as the view reaches, along the stretch that was
  // measured.
  const session::VesselFat& fat = window().fat().board().known()->vessels.at(0);
  view::PictureView& cpr = test->picture("cpr1").view();
  const double pixel = cpr.pixel_mm(), diameter = fat.profile.diameter_mm;
  const double long_mm = std::min(fat.profile.to_mm - fat.profile.from_mm, cpr.height() * pixel);
  const double wide_mm = std::min(diameter, 0.5 * cpr.width() * pixel - 0.5 * diameter);
  const double shown_mm2 = static_cast<double>(found.size()) * pixel * pixel;
  EXPECT_NEAR(shown_mm2 / (2.0 * wide_mm * long_mm), 1.0, 0.25);
  key_of_the_page();
  EXPECT_TRUE(coloured("cpr1").empty());
}

TEST_F(FatWindow, AfterAnEditItIsMeasuredAgain) {
  open_case();
  key_of_the_page();
  ASSERT_TRUE(is_known());
  lumen::WallDrag drag;
  drag.vessel = 4;
  drag.from = {1.5, 0.0, 20.0};
  drag.to = {2.0, 0.0, 20.0};
  test->bench().edit(drag);
  EXPECT_FALSE(window().fat().board().known());
  EXPECT_TRUE(wait_until([&] { return window().jobs().running("fat"); }));
}

}  // namespace
}  // namespace ostia::workstation
