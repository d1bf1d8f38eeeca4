// How far a vessel can be judged, in the window: found without being asked for, drawn, told in the list, set
// by keys and by a measurement, undone.

#include "tube_case.h"
#include "vessels/evaluability.h"
#include "vessels/list.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"

#include <gmock/gmock.h>

#include <QAction>
#include <QApplication>
#include <QTest>
#include <QWindow>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using analysis::Evaluability;
using ostia::workstation::testing::wait_until;
using ::testing::HasSubstr;

constexpr double drowned_mm = 20.0;

/// The tube; from 20 mm on it lies in a bright chamber.
imaging::ImageVolume drowned_tube() {
  imaging::ImageVolume image = testing::tube_image();
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < image.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < image.geometry.size[0]; ++i)
        if (image.geometry.world({double(i), double(j), double(k)}).z() > drowned_mm)
          image(i, j, k) = static_cast<std::int16_t>(400 + (i * 7 + j * 13 + k * 5) % 30);
  return image;
}

struct EvaluabilityWindow : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  std::unique_ptr<testing::TestWindow> test;

  EvaluabilityWindow() {
    imaging::write_image(image, drowned_tube());
    session::CaseFile::create(case_file, testing::tube_model(), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
    test = std::make_unique<testing::TestWindow>(state);
    test->open(case_file);
  }
  session::EvaluabilityBoard& board() { return test->window().evaluability().board(); }
  std::vector<analysis::EvaluableStretch> stretches() { return board().stretches(4); }
  Evaluability grade_at(double s_mm) { return analysis::worst_within(stretches(), s_mm, s_mm)->grade; }
  bool is_known() {
    return wait_until([&] { return !stretches().empty(); }, 30000);
  }
  std::vector<view::OverlayBand> bands(const view::Overlay& overlay, view::Role role) {
    std::vector<view::OverlayBand> found;
    for (const view::OverlayBand& band : overlay.bands)
      if (band.role == role) found.push_back(band);
    return found;
  }
  QString in_list() {
    const auto* list = test->window().findChild<VesselList*>("vessels");
    return list->topLevelItem(0)->text(4) + "|" + list->topLevelItem(0)->toolTip(4);
  }
  void key(Qt::Key key) {
    QApplication::setActiveWindow(&test->window());  // keys reach commands of the active window alone
    test->picture("cpr1").setFocus();
    QTest::keyClick(test->window().windowHandle(), key, Qt::ControlModifier);
  }
};

TEST_F(EvaluabilityWindow, IsFoundShownAndToldWithoutBeingAskedFor) {
  ASSERT_TRUE(is_known());
  EXPECT_EQ(grade_at(10.0), Evaluability::evaluable);
  EXPECT_EQ(grade_at(30.0), Evaluability::not_evaluable);
  auto& curved = dynamic_cast<view::CurvedView&>(test->picture("cpr1").view());
  const auto band = bands(curved.overlay(), view::Role::not_evaluable);
  ASSERT_EQ(band.size(), 1U);
  EXPECT_NEAR(curved.abscissa_at(band[0].low.y()), drowned_mm, 1.5);
  EXPECT_NEAR(curved.abscissa_at(band[0].high.y()), testing::tube_length_mm, 0.5);
  bool told = false;
  for (const view::OverlayText& text : curved.overlay().texts) told = told || text.text == "not evaluable";
  EXPECT_TRUE(told);
  auto* profile = test->window().findChild<ProfileWidget*>();
  EXPECT_EQ(bands(profile->view().overlay(), view::Role::not_evaluable).size(), 2U);
  EXPECT_THAT(in_list().toStdString(), HasSubstr("% not|"));
  EXPECT_THAT(in_list().toStdString(), HasSubstr("to 40.0 mm: not evaluable: "));
  board().shown.set(false);
  EXPECT_TRUE(bands(curved.overlay(), view::Role::not_evaluable).empty());
}

TEST_F(EvaluabilityWindow, TheReadersWordIsSetByKeysAndUndone) {
  ASSERT_TRUE(is_known());
  test->bench().cursor_mm.set(30.0);
  EXPECT_TRUE(test->window().findChild<QAction*>("vessel.evaluable")->isEnabled());
  key(Qt::Key_1);
  EXPECT_EQ(grade_at(30.0), Evaluability::evaluable);
  EXPECT_THAT(in_list().toStdString(), HasSubstr("evaluable (reader)"));
  key(Qt::Key_2);
  EXPECT_EQ(grade_at(30.0), Evaluability::limited);
  test->bench().undo();
  EXPECT_EQ(grade_at(30.0), Evaluability::evaluable);
  key(Qt::Key_4);
  EXPECT_EQ(grade_at(30.0), Evaluability::not_evaluable);
  key(Qt::Key_2);
  test->window().close();
  test.reset();
  const auto marks = session::CaseFile::open(case_file, session::OpenMode::read_only).annotations()->marks;
  ASSERT_EQ(marks.size(), 1U);
  ASSERT_EQ(marks[0].evaluable.size(), 1U);
  EXPECT_EQ(marks[0].evaluable[0].grade, Evaluability::limited);
}

TEST_F(EvaluabilityWindow, AMeasurementAlongTheVesselGivesTheStretch) {
  ASSERT_TRUE(is_known());
  analysis::Measurement stretch;
  stretch.kind = analysis::MeasureKind::volume;
  stretch.vessel = 4;
  stretch.from_mm = 5.0, stretch.to_mm = 12.0;
  test->bench().annotate(session::MeasureAdd{stretch});
  test->bench().selected_measurement.set(1);
  key(Qt::Key_3);
  EXPECT_EQ(grade_at(8.0), Evaluability::not_evaluable);
  EXPECT_EQ(grade_at(4.0), Evaluability::evaluable);
  EXPECT_EQ(grade_at(14.0), Evaluability::evaluable);
}

TEST_F(EvaluabilityWindow, AnEditIsLookedAtAgain) {
  ASSERT_TRUE(is_known());
  // The wall is drawn far out in the fat: there is no edge.
  for (const double s : {8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0}) {
    lumen::SectionContour ring;
    ring.vessel = 4;
    ring.s_mm = s;
    for (int i = 0; i < 24; ++i)
      ring.points.push_back(
          test->bench().axis()->place(s, 2.0 * M_PI * i / 24.0, 2.2 * testing::tube_radius_mm));
    test->bench().edit(ring);
  }
  EXPECT_TRUE(wait_until([&] { return grade_at(11.0) != Evaluability::evaluable; }, 30000));
}

}  // namespace
}  // namespace ostia::workstation
