// The calcium score in the window: scored by a key, a lesion chosen in the table and by a click in a slice,
// its place corrected by a key, taken back, found again in its case, taken into a report.

#include "calcium/page.h"
#include "calcium/reading.h"
#include "tube_window.h"
#include "views/picture_widget.h"

#include "ostia/view/plane_view.h"

#include <gmock/gmock.h>

#include <QCheckBox>
#include <QTreeWidget>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace ostia::workstation {
namespace {

using analysis::CalciumPlace;
using ::testing::HasSubstr;
using testing::wait_until;

/// A body of 40 HU with cubes of calcium in one slice of 3 mm, 16 mm apart.
imaging::ImageVolume scan_with_calcium() {
  imaging::ImageVolume image;
  image.geometry.size = {80, 80, 14};
  image.geometry.spacing = {1.0, 1.0, 3.0};
  image.voxels.assign(80 * 80 * 14, 40);
  for (const auto& [x, y, hu] : {std::tuple(30, 38, 500), {46, 38, 250}})
    for (int j = y; j < y + 3; ++j)
      for (int i = x; i < x + 3; ++i)
        image.voxels[static_cast<std::size_t>(i + 80 * (j + 80 * 7))] = static_cast<std::int16_t>(hu);
  return image;
}

struct CalciumWindow : testing::TubeWindow {
  testing::fs::path scan = folder / "scan.nrrd";

  CalciumWindow() { imaging::write_image(scan, scan_with_calcium()); }
  void open_scan() {
    test = std::make_unique<testing::TestWindow>(folder / "state");
    window().open(scan);
    ASSERT_TRUE(wait_until([&] { return test->bench().image().volume && idle(); }, 60000));
    settle();
  }
  session::CalciumBoard& board() { return window().calcium().board(); }
  const analysis::CalciumScore& score() { return board().score(); }
  QTreeWidget& lesions() { return *part<QTreeWidget>("calcium_lesions"); }
  void key(int key, Qt::KeyboardModifiers modifiers) {
    QApplication::setActiveWindow(&window());
    QTest::keyClick(window().windowHandle(), static_cast<Qt::Key>(key), modifiers);
    QApplication::processEvents();
  }
  void score_by_key() {
    key(Qt::Key_A, Qt::ControlModifier | Qt::ShiftModifier);
    ASSERT_TRUE(wait_until([&] { return board().reading() && idle(); }, 60000));
    settle();
  }
  /// Of 3 x 3 mm in 3 mm, brighter than 400 HU or 200: 9 mm2 times the weight.
  static constexpr double bright = 36.0, dim = 18.0;
  const analysis::CalciumLesion& lesion_of(double agatston) {
    for (const analysis::CalciumLesion& one : score().lesions)
      if (std::abs(one.amount.agatston - agatston) < 1e-9) return one;
    throw std::runtime_error("no such lesion");
  }
  void click_in_slice(const geometry::Vec3& place) {
    PictureWidget& slice = test->picture("slice");
    const auto at = slice.view().project(place);
    ASSERT_TRUE(at);
    const double ratio = slice.devicePixelRatioF();
    QTest::mouseClick(&slice, Qt::LeftButton, {}, (QPointF(at->px.x(), at->px.y()) / ratio).toPoint());
    settle();
  }
  QTreeWidgetItem* row_of(int number) {
    for (int i = 0; i < lesions().topLevelItemCount(); ++i)
      if (lesions().topLevelItem(i)->data(0, Qt::UserRole).toInt() == number)
        return lesions().topLevelItem(i);
    return nullptr;
  }
  /// Shown, too, whatever the program proposes.
  void choose_in_table(int number) {
    auto* all = part<QCheckBox>("calcium_all");
    if (!all->isChecked()) QTest::mouseClick(all, Qt::LeftButton, {}, QPoint(8, all->height() / 2));
    const QRect row = lesions().visualItemRect(row_of(number));
    QTest::mouseClick(lesions().viewport(), Qt::LeftButton, {}, row.center());
    settle();
  }
  testing::fs::path calcium_case() {
    return folder / "state/cases" / (board().reading()->reference.pseudonym + "-calcium.ostia");
  }
};

TEST_F(CalciumWindow, ALesionIsChosenByTheMouseAndCorrectedByAKeyAndTakenBack) {
  open_scan();
  score_by_key();
  ASSERT_TRUE(part<QWidget>("calcium")->isVisible());
  ASSERT_EQ(score().lesions.size(), 2U);
  const auto bright_one = lesion_of(bright), dim_one = lesion_of(dim);
  choose_in_table(bright_one.number);
  EXPECT_EQ(board().chosen.get(), bright_one.number);
  EXPECT_LT((test->bench().place.get() - bright_one.centre).norm(), 1e-9) << "slices go to it";
  click_in_slice(dim_one.centre);
  ASSERT_EQ(board().chosen.get(), dim_one.number);
  EXPECT_EQ(lesions().currentItem(), row_of(dim_one.number));
  key(Qt::Key_8, Qt::ControlModifier);
  EXPECT_EQ(board().lesion(dim_one.number)->place, CalciumPlace::rca);
  EXPECT_DOUBLE_EQ(score().of(CalciumPlace::rca).agatston, dim);
  EXPECT_EQ(row_of(dim_one.number)->text(0), "RCA");
  click_in_slice(bright_one.centre);
  key(Qt::Key_9, Qt::ControlModifier);
  EXPECT_DOUBLE_EQ(score().total.agatston, dim);
  EXPECT_THAT(part<QLabel>("calcium_total")->text().toStdString(), HasSubstr("18.0"));
  const QImage kept = testing::on_screen(window(), "calcium");
  EXPECT_FALSE(kept.isNull());
  key(Qt::Key_Z, Qt::ControlModifier);
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(board().lesion(dim_one.number)->place, dim_one.place);
  key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(board().lesion(dim_one.number)->place, CalciumPlace::rca);
}

TEST_F(CalciumWindow, LesionsAreColouredOnSlicesByTheirArtery) {
  open_scan();
  score_by_key();
  const auto one = lesion_of(bright);
  window().calcium().choose(one.number);
  window().calcium().say(CalciumPlace::lcx);
  const auto found = coloured("slice");
  EXPECT_NE(std::count(found.begin(), found.end(), view::Role::calcium_lcx), 0);
  // 9 mm2 of the slice: as many pixels as that is.
  const double pixel = test->picture("slice").view().pixel_mm();
  EXPECT_NEAR(std::count(found.begin(), found.end(), view::Role::calcium_lcx) * pixel * pixel, 9.0, 1.5);
  part<QWidget>("calcium")->hide();
  EXPECT_TRUE(coloured("slice").empty());
}

TEST_F(CalciumWindow, ItsCaseIsOpenedAndAReportTakesTheScore) {
  open_scan();
  score_by_key();
  window().calcium().choose(lesion_of(bright).number);
  key(Qt::Key_6, Qt::ControlModifier);
  window().calcium().choose(lesion_of(dim).number);
  key(Qt::Key_9, Qt::ControlModifier);
  const testing::fs::path kept = calcium_case();
  ASSERT_TRUE(testing::fs::exists(kept));
  EXPECT_FALSE(part<QAction>("calcium.report")->isEnabled()) << "there is no case";
  test.reset();

  test = std::make_unique<testing::TestWindow>(folder / "state");
  window().open(kept);
  ASSERT_TRUE(wait_until([&] { return board().reading() && idle(); }, 60000));
  settle();
  EXPECT_FALSE(test->bench().has_case());
  EXPECT_DOUBLE_EQ(score().total.agatston, bright);
  EXPECT_DOUBLE_EQ(score().of(CalciumPlace::lad).agatston, bright);

  test->open(case_file);
  settle();
  ASSERT_TRUE(part<QAction>("calcium.report")->isEnabled());
  QTest::mouseClick(part<QToolButton>("button.calcium.report"), Qt::LeftButton);
  const auto notes = [&] { return test->bench().session().file().annotations()->report.modifiers; };
  EXPECT_EQ(notes().agatston, bright);
  ASSERT_TRUE(test->bench().undo());
  EXPECT_FALSE(notes().agatston);
}

}  // namespace
}  // namespace ostia::workstation
