// The beating case, driven by mouse and keys: a motion is opened, the phase is dragged and played in all
// views, and nothing is edited at another phase than the case's.

#include "known_motion.h"
#include "layout_faults.h"
#include "phases/bar.h"
#include "phases/beating_case.h"
#include "phases/map.h"
#include "tube_window.h"

#include "ostia/io/cage_motion_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QStatusBar>
#include <QStyle>

namespace ostia::workstation {
namespace {

using session::testing::known_motion;
using ::testing::HasSubstr;
using testing::send;
using testing::type;
using testing::wait_until;
namespace fs = std::filesystem;

/// The tube's image where the motion has taken it.
imaging::ImageVolume tube_image_at(double phase) {
  const imaging::ImageVolume rest = testing::tube_image();
  imaging::ImageVolume image = rest;
  const double c = session::testing::contraction(phase);
  const auto& size = rest.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const geometry::Vec3 at = rest.geometry.world({double(i), double(j), double(k)});
        const geometry::Vec3 from = rest.geometry.index(
            {(at.x() - 4.0 * c) / (1.0 - 0.2 * c), at.y() / (1.0 - 0.2 * c), at.z() / (1.0 - 0.1 * c)});
        const auto nearest = [&](int a) {
          return std::clamp<std::int64_t>(std::lround(from[a]), 0, size[static_cast<std::size_t>(a)] - 1);
        };
        image(i, j, k) = rest(nearest(0), nearest(1), nearest(2));
      }
  return image;
}

/// The tube along z, and a motion that makes it 20 % thinner and 10 % shorter, and shifts it by 4 mm.
class BeatingWindow : public testing::TubeWindow {
 public:
  fs::path motion_file = folder / "motion.json";
  BeatingWindow() {
    io::write_cage_motion(motion_file, {known_motion({-9.0, -9.0, -4.0}, {9.0, 9.0, 44.0}), ""});
    open_case();
  }
  ~BeatingWindow() override { QApplication::processEvents(); }

  session::Workbench& bench() { return test->bench(); }
  /// By the menu's command and the file dialog.
  void open_motion(const fs::path& file) {
    testing::answer_file_dialog(file);
    part<QAction>("file.motion")->trigger();
    ASSERT_TRUE(wait_until([&] { return idle(); }));
    settle();
  }
  PhaseBar& bar() { return *part<PhaseBar>("phase_bar"); }
  PhaseSlider& slider() { return *part<PhaseSlider>("phase"); }
  QPoint place_of(double percent) {
    const int handle = slider().style()->pixelMetric(QStyle::PM_SliderLength, nullptr, &slider());
    return {handle / 2 + static_cast<int>(std::lround(percent / 100.0 * (slider().width() - handle))),
            slider().height() / 3};
  }
  void drag_slider(double from, double to) {
    std::vector<QPoint> way;
    for (int i = 0; i <= 10; ++i) way.push_back(place_of(from + i * (to - from) / 10.0));
    testing::sweep(slider(), way);
    settle();
  }
  void type_number(const char* field, const QString& text) {
    type(part<QDoubleSpinBox>(field), text);
    QTest::keyClick(part<QDoubleSpinBox>(field)->findChild<QLineEdit*>(), Qt::Key_Return);
    settle();
  }
  double percent() { return window().beating().clock().percent.get(); }
  QImage look(const char* name) { return testing::on_screen(window(), name); }
  QImage tree_of(const QImage& whole) {
    return whole.copy(QRect(window().scene().mapTo(&window(), QPoint(0, 0)), window().scene().size()));
  }
};

TEST_F(BeatingWindow, TheBarComesAndGoesWithTheMotion) {
  EXPECT_FALSE(bar().isVisible());
  EXPECT_FALSE(part<QAction>("view.play")->isEnabled());
  open_motion(motion_file);
  EXPECT_TRUE(bar().isVisible());
  EXPECT_TRUE(part<QAction>("view.play")->isEnabled());
  EXPECT_DOUBLE_EQ(percent(), 75.0);
  EXPECT_FALSE(bench().other_phase()) << "the case's own phase is shown first";
  EXPECT_EQ(part<QToolButton>("phase_back")->text(), "Back to 75 %");
  EXPECT_TRUE(testing::layout_faults(window()).isEmpty())
      << testing::layout_faults(window()).join("\n").toStdString();
  QTest::mouseClick(part<QToolButton>("phase_close"), Qt::LeftButton);
  EXPECT_FALSE(bar().isVisible());
  open_motion(motion_file);
  open_other_case();
  EXPECT_FALSE(bar().isVisible()) << "it is of the other patient";
}

TEST_F(BeatingWindow, TheSliderMovesTheTreeInAllViews) {
  open_motion(motion_file);
  bench().cursor_mm.set(16.0);
  const QImage before = look("beating_75");
  drag_slider(75.0, 25.0);
  EXPECT_NEAR(percent(), 25.0, 0.6);
  ASSERT_TRUE(bench().other_phase());
  const double share = session::testing::contraction(percent() / 100.0);
  EXPECT_NEAR(bench().place.get().x(), 4.0 * share, 0.02);
  EXPECT_NEAR(bench().place.get().z(), 16.0 * (1.0 - 0.1 * share), 0.02);
  const QImage after = look("beating_25");
  EXPECT_NE(tree_of(before), tree_of(after)) << "the 3D view";
  for (const char* name : {"cpr1", "cpr2", "section", "slice"}) {
    const auto& lines = test->picture(name).view().contour_lines();
    EXPECT_FALSE(lines.empty()) << name;
    for (const auto& line : lines)
      for (const view::Vec3& p : line.world)
        if (p.z() > 1.0 && p.z() < 34.0) {
          EXPECT_NEAR(std::hypot(p.x() - 4.0 * share, p.y()), 1.2, 0.06) << name;
        }
  }
  EXPECT_TRUE(testing::layout_faults(window()).isEmpty())
      << testing::layout_faults(window()).join("\n").toStdString();
  QTest::mouseClick(part<QToolButton>("phase_back"), Qt::LeftButton);
  EXPECT_FALSE(bench().other_phase());
  EXPECT_DOUBLE_EQ(percent(), 75.0);
  EXPECT_EQ(tree_of(look("beating_back")), tree_of(before)) << "the wall is where it was";
}

TEST_F(BeatingWindow, KeysAndTheNumberGoToAPhase) {
  open_motion(motion_file);
  slider().setFocus();
  for (int i = 0; i < 3; ++i) QTest::keyClick(&slider(), Qt::Key_Right);
  EXPECT_NEAR(percent(), 78.0, 1e-9);
  QTest::keyClick(&slider(), Qt::Key_Home);
  EXPECT_NEAR(percent(), 0.0, 1e-9);
  type_number("phase_percent", "37.5");
  EXPECT_NEAR(percent(), 37.5, 1e-9);
  EXPECT_NEAR(bench().other_phase()->phase(), 0.375, 1e-9);
  EXPECT_EQ(slider().value(), 375);
}

TEST_F(BeatingWindow, PlaysAndPausesByButtonAndKey) {
  open_motion(motion_file);
  type_number("phase_speed", "30");
  std::vector<double> shown;
  const auto kept = bench().phase_changed.observe([&] { shown.push_back(percent()); });
  QTest::mouseClick(part<QToolButton>("phase_play"), Qt::LeftButton);
  ASSERT_TRUE(window().beating().clock().playing.get());
  ASSERT_TRUE(wait_until([&] { return shown.size() > 30; }, 60000));
  QTest::mouseClick(part<QToolButton>("phase_play"), Qt::LeftButton);
  EXPECT_FALSE(window().beating().clock().playing.get());
  testing::let_work(300);  // a frame that had begun
  const std::size_t frames = shown.size();
  testing::let_work(300);
  EXPECT_EQ(shown.size(), frames) << "it stands";
  part<QAction>("view.play")->trigger();
  EXPECT_TRUE(window().beating().clock().playing.get());
  send(slider(), QEvent::MouseButtonPress, place_of(40.0), Qt::LeftButton, Qt::LeftButton);
  EXPECT_FALSE(window().beating().clock().playing.get()) << "the hand has the slider";
  EXPECT_NEAR(percent(), 40.0, 0.6);
  send(slider(), QEvent::MouseButtonRelease, place_of(40.0), Qt::LeftButton, Qt::NoButton);
}

TEST_F(BeatingWindow, WithoutALoopItStopsAtTheEndOfTheCycle) {
  open_motion(motion_file);
  QTest::mouseClick(part<QCheckBox>("phase_loop"), Qt::LeftButton);
  type_number("phase_speed", "200");
  part<QAction>("view.play")->trigger();
  ASSERT_TRUE(wait_until([&] { return !window().beating().clock().playing.get(); }, 60000));
  EXPECT_DOUBLE_EQ(percent(), 100.0);
}

TEST_F(BeatingWindow, AnEditAtAnotherPhaseIsRefusedAndTheWayBackOffered) {
  open_motion(motion_file);
  drag_slider(75.0, 30.0);
  part<QAction>("tool.drag")->trigger();
  const std::string before = lumen::digest(*bench().model());
  PictureWidget& cpr = test->picture("cpr1");
  const view::Vec2 wall = cpr.view().contour_lines().front().picture_px[10];
  const QPoint at(static_cast<int>(wall.x()), static_cast<int>(wall.y()));
  testing::sweep(cpr, {at, at + QPoint(8, 0), at + QPoint(16, 0)});
  EXPECT_EQ(lumen::digest(*bench().model()), before);
  EXPECT_THAT(window().statusBar()->currentMessage().toStdString(), HasSubstr("at 75 % only"));
  auto* trouble = part<QLabel>("phase_trouble");
  EXPECT_TRUE(trouble->isVisible());
  look("beating_refused");
  auto* back = part<QToolButton>("phase_back");
  EXPECT_EQ(window().focusWidget(), back) << "the way back is one key away";
  QTest::keyClick(back, Qt::Key_Space);
  EXPECT_FALSE(bench().other_phase());
  EXPECT_FALSE(trouble->isVisible());
  settle();
  const view::Vec2 own = cpr.view().contour_lines().front().picture_px[10];
  const QPoint there(static_cast<int>(own.x()), static_cast<int>(own.y()));
  testing::sweep(cpr, {there, there + QPoint(8, 0), there + QPoint(16, 0)});
  EXPECT_NE(lumen::digest(*bench().model()), before) << "at its own phase it is edited";
  drag_slider(75.0, 30.0);
  EXPECT_TRUE(bench().other_phase()) << "the motion goes with the edited tree";
}

TEST_F(BeatingWindow, ImagesOfThePhasesAreShownWhereTheyAre) {
  const fs::path phases = folder / "phases";
  fs::create_directories(phases);
  for (const int percent : {0, 25, 50})
    imaging::write_image(phases / ("phase_" + std::to_string(percent) + ".nrrd"),
                         tube_image_at(percent / 100.0));
  open_motion(motion_file);
  bench().cursor_mm.set(16.0);
  drag_slider(75.0, 25.0);
  PictureWidget& section = test->picture("section");
  const auto mismatch = [&] {
    for (const view::OverlayText& text : section.view().overlay().texts)
      if (text.text.starts_with("image ")) return QString::fromStdString(text.text);
    return QString();
  };
  EXPECT_TRUE(mismatch().startsWith("image 75 %, tree 25")) << mismatch().toStdString();
  look("beating_without_image");
  testing::answer_file_dialog(phases);
  QTest::mouseClick(part<QToolButton>("phase_images"), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return idle() && window().beating().images().any(); }));
  EXPECT_EQ(part<QToolButton>("phase_images")->text(), "Images: 3");
  ASSERT_TRUE(wait_until([&] { return !window().beating().images().reading(); }));
  type_number("phase_percent", "25");
  EXPECT_EQ(mismatch(), "");
  // Where the lumen is at that phase there is contrast, in the image of that phase alone.
  const view::Vec2 middle(section.view().width() / 2.0, section.view().height() / 2.0);
  EXPECT_GT(*section.view().value_at(middle), 300.0);
  look("beating_with_image");
  type_number("phase_percent", "40");
  EXPECT_TRUE(mismatch().startsWith("image 50 %, tree 40")) << "the nearest: " << mismatch().toStdString();
  type_number("phase_percent", "70");
  EXPECT_TRUE(mismatch().startsWith("image 75 %, tree 70")) << "the case's own: " << mismatch().toStdString();
  fs::create_directories(folder / "nothing");
  testing::answer_file_dialog(folder / "nothing");
  QTest::mouseClick(part<QToolButton>("phase_images"), Qt::LeftButton);
  EXPECT_NE(testing::message(), "no message");
}

TEST_F(BeatingWindow, TheProfileOverTheCycleIsThatOfTheCarriedLumen) {
  open_motion(motion_file);
  auto* map = part<PhaseMap>("phase_map");
  EXPECT_FALSE(map->isVisible());
  QTest::mouseClick(part<QToolButton>("phase_profile_button"), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return map->profile().has_value(); }));
  for (const double phase : {0.75, 0.25, 0.5})
    EXPECT_NEAR(map->value_at(phase, 16.0), 3.0 * (1.0 - 0.2 * session::testing::contraction(phase)), 0.03);
  const QRect plot = map->plot();
  QTest::mouseClick(map, Qt::LeftButton, Qt::NoModifier,
                    plot.topLeft() + QPoint(plot.width() / 2, plot.height() / 4));
  EXPECT_NEAR(percent(), 25.0, 1.5);
  EXPECT_NEAR(bench().own_mm(bench().cursor_mm.get()), 20.0, 0.3);
  QTest::keyClick(map, Qt::Key_Down);
  EXPECT_NEAR(percent(), 26.0, 1.5);
  EXPECT_TRUE(testing::layout_faults(window()).isEmpty())
      << testing::layout_faults(window()).join("\n").toStdString();
  look("beating_profile");
  auto* value = part<QComboBox>("phase_value");
  testing::pick(value, 2);
  EXPECT_NEAR(map->value_at(0.25, 16.0), -20.0, 0.1) << "percent of the diameter at the case's phase";
  look("beating_profile_change");
  QTest::mouseClick(part<QToolButton>("phase_profile_button"), Qt::LeftButton);
  EXPECT_FALSE(map->isVisible());
}

TEST_F(BeatingWindow, WhatIsNoMotionOfThisTreeIsTold) {
  const fs::path other = folder / "other.json";
  io::write_cage_motion(other, {known_motion({200.0, 200.0, 200.0}, {220.0, 220.0, 240.0}), ""});
  testing::answer_file_dialog(other);
  part<QAction>("file.motion")->trigger();
  EXPECT_THAT(testing::message(), HasSubstr("lie outside of the motion's cage"));
  EXPECT_FALSE(bar().isVisible());
  testing::answer_file_dialog(image);
  part<QAction>("file.motion")->trigger();
  EXPECT_THAT(testing::message(), HasSubstr("image.nrrd"));
  EXPECT_FALSE(bar().isVisible());
}

}  // namespace
}  // namespace ostia::workstation
