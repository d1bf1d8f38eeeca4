// Results of a flow computation in the 3D view, by mouse and keys.

#include "flow/bar.h"
#include "flow_window.h"
#include "layout_faults.h"
#include "shell/language.h"
#include "views/picture_widget.h"

#include "ostia/io/surface_file.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QToolButton>
#include <QTranslator>
#include <algorithm>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::answer_file_dialog;
using testing::message;
using testing::pick;
using testing::pressure_pa;
using testing::radius_mm;
using testing::shear_pa;
using testing::type;
using testing::wait_until;
using testing::write_wall;

struct FlowResultWindow : testing::FlowWindow {};

TEST_F(FlowResultWindow, AResultIsColouredAndTheValueUnderTheMouseIsTold) {
  open_case();
  open_wall();
  EXPECT_EQ(part<QComboBox>("flow_array")->currentText(), "wall shear stress, Pa");
  for (const double z : {5.0, 12.3, 20.0, 33.0})
    EXPECT_NEAR(value_told({0.4, -radius_mm, z}), shear_pa(z), 0.06) << z;
  EXPECT_TRUE(told({0.0, -radius_mm, 20.0}).startsWith("wall shear stress "));
  EXPECT_TRUE(told({0.0, -radius_mm, 20.0}).endsWith(" Pa"));
  EXPECT_TRUE(told({8.0, 0.0, 20.0}).isEmpty()) << "beside the wall";
  // From the 2nd to the 98th percentile of 81 rings of equal values: those of rings 1 and 79.
  // 1.125 and 10.875, outwards to three digits of the larger one.
  EXPECT_EQ(part<QLineEdit>("flow_low")->text(), "1.1");
  EXPECT_EQ(part<QLineEdit>("flow_high")->text(), "10.9");
  // Dark blue at the beginning, yellow at the end.
  const QColor first = color_at({0.0, -radius_mm, 2.0}), last = color_at({0.0, -radius_mm, 38.0});
  EXPECT_GT(first.blue(), first.green());
  EXPECT_GT(last.red() + last.green(), 3 * last.blue());
}

TEST_F(FlowResultWindow, ArraysAndRangesAreChosenByKeys) {
  open_case();
  open_wall();
  auto* arrays = part<QComboBox>("flow_array");
  ASSERT_EQ(arrays->count(), 2);
  arrays->setFocus();
  QTest::keyClick(arrays, Qt::Key_Home);
  EXPECT_EQ(arrays->currentText(), "pressure, Pa");
  settle();
  EXPECT_NEAR(value_told({0.0, -radius_mm, 10.0}), pressure_pa(10.0), 0.3);
  EXPECT_NEAR(part<QLineEdit>("flow_low")->text().toDouble(), pressure_pa(39.5), 1e-3);
  auto* automatic = part<QCheckBox>("flow_automatic");
  auto* low = part<QLineEdit>("flow_low");
  auto* high = part<QLineEdit>("flow_high");
  EXPECT_FALSE(low->isEnabled());
  automatic->setFocus();
  QTest::keyClick(automatic, Qt::Key_Space);
  ASSERT_TRUE(low->isEnabled());
  const QColor before = color_at({0.0, -radius_mm, 20.0});
  type(low, "90");
  type(high, "60");
  EXPECT_TRUE(part<QLabel>("flow_range_trouble")->isVisible());
  EXPECT_TRUE(part<QLabel>("flow_range_trouble")->text().contains("smaller"));
  type(low, "-500");
  EXPECT_FALSE(part<QLabel>("flow_range_trouble")->isVisible());
  settle();
  const QColor after = color_at({0.0, -radius_mm, 20.0});
  EXPECT_GT(after.red() + after.green(), before.red() + before.green() + 40) << "yellower: nearly the last";
  automatic->setFocus();
  QTest::keyClick(automatic, Qt::Key_Space);
  settle();
  EXPECT_NEAR(low->text().toDouble(), pressure_pa(39.5), 1e-3);
  EXPECT_LT(std::abs(color_at({0.0, -radius_mm, 20.0}).red() - before.red()), 4);
}

TEST_F(FlowResultWindow, TheProfileShowsWhatFlowsAlongTheVessel) {
  open_case();
  auto* profile = window().findChild<ProfileWidget*>();
  ASSERT_TRUE(profile);
  const auto curves = [&](view::Role role) {
    const auto& lines = profile->view().overlay().lines;
    return std::count_if(lines.begin(), lines.end(), [&](const auto& line) { return line.role == role; });
  };
  const auto legend = [&](view::Role role) {
    for (const auto& text : profile->view().overlay().texts)
      if (text.role == role && text.text.find("Pa") != std::string::npos)
        return QString::fromStdString(text.text);
    return QString();
  };
  EXPECT_EQ(curves(view::Role::shear), 0);
  EXPECT_GT(curves(view::Role::area), 0);
  open_wall();
  ASSERT_TRUE(wait_until([&] { return idle() && curves(view::Role::shear) > 0; }));
  EXPECT_GT(curves(view::Role::pressure), 0);
  EXPECT_EQ(curves(view::Role::area), 0) << "its axis is the result's now";
  // A click moves the cursor; the legend tells what is there.
  for (const double s : {12.0, 29.0}) {
    const double ratio = profile->devicePixelRatioF();
    QTest::mouseClick(
        profile, Qt::LeftButton, Qt::NoModifier,
        QPoint(static_cast<int>(std::lround(profile->view().x_of(s) / ratio)), profile->height() / 2));
    settle();
    const double here = test->bench().cursor_mm.get();
    EXPECT_NEAR(here, s, 0.2);
    const QStringList words = legend(view::Role::shear).split(": ").last().remove('(').remove(')').split(' ');
    ASSERT_EQ(words.size(), 2) << legend(view::Role::shear).toStdString();
    EXPECT_NEAR(words[0].toDouble(), shear_pa(here), 0.04);
    const QStringList ends = words[1].split(QStringLiteral("\u2013"));
    ASSERT_EQ(ends.size(), 2);
    EXPECT_NEAR(ends[0].toDouble(), shear_pa(here - 0.5), 0.15);
    EXPECT_NEAR(ends[1].toDouble(), shear_pa(here + 0.5), 0.15);
    EXPECT_TRUE(legend(view::Role::shear).startsWith("wall shear stress, Pa: mean (least to greatest)"));
    EXPECT_NEAR(legend(view::Role::pressure).split(' ').last().toDouble(), pressure_pa(here), 0.06);
    EXPECT_TRUE(legend(view::Role::pressure).startsWith("pressure, Pa"));
  }
  auto* along = part<QToolButton>("flow_along");
  QTest::mouseClick(along, Qt::LeftButton);
  EXPECT_EQ(curves(view::Role::shear), 0);
  EXPECT_GT(curves(view::Role::area), 0);
  QTest::mouseClick(along, Qt::LeftButton);
  EXPECT_TRUE(wait_until([&] { return idle() && curves(view::Role::shear) > 0; }));
  QTest::mouseClick(part<QToolButton>("flow_hide"), Qt::LeftButton);
  EXPECT_TRUE(wait_until([&] { return curves(view::Role::shear) == 0; })) << "it goes with the result";
}

TEST_F(FlowResultWindow, ThePictureIsSavedAndTheWallComesBack) {
  open_case();
  open_wall();
  const fs::path png = folder / "shear.png";
  answer_file_dialog(png);
  QTest::mouseClick(part<QToolButton>("flow_save"), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return fs::exists(png); }));
  const QImage saved(QString::fromStdString(png.string()));
  EXPECT_NEAR(saved.width(), 2.0 * native->width() * native->devicePixelRatio(), 2.0);
  // In the middle of the picture is the middle of the tube.
  const QColor middle = saved.pixelColor(saved.width() / 2, saved.height() / 2);
  EXPECT_GT(middle.green(), middle.red()) << "the middle of viridis is green";
  auto* hide = part<QToolButton>("flow_hide");
  hide->setFocus();
  QTest::keyClick(hide, Qt::Key_Space);
  settle();
  EXPECT_FALSE(window().flow_results().shown());
  EXPECT_FALSE(part<FlowBar>("flow_bar")->isVisible());
  EXPECT_TRUE(window().scene().scene().pick(window().scene().scene().project({0.0, -radius_mm, 20.0})));
  open_wall();
  part<QAction>("file.close")->trigger();
  EXPECT_TRUE(wait_until([&] { return !window().flow_results().shown(); })) << "it is of another case";
}

TEST_F(FlowResultWindow, AResultThatIsStillReadGoesWithItsCase) {
  open_case();
  write_wall(wall);
  answer_file_dialog(wall);
  part<QAction>("file.flow_results")->trigger();
  ASSERT_TRUE(window().jobs().running("flow_results"));
  part<QAction>("file.close")->trigger();
  ASSERT_FALSE(test->bench().has_case());
  ASSERT_TRUE(wait_until([&] { return idle(); }));
  settle();
  EXPECT_FALSE(window().flow_results().shown()) << "another patient may be opened by now";
  EXPECT_FALSE(part<FlowBar>("flow_bar")->isVisible());
}

TEST_F(FlowResultWindow, BoundsThatDifferLittleAreShownApart) {
  open_case();
  write_wall(wall, 13332.0, 13334.0);
  window().flow_results().open({wall});
  ASSERT_TRUE(wait_until([&] { return idle() && window().flow_results().shown(); }));
  pick(part<QComboBox>("flow_array"), 0);
  settle();
  const double low = part<QLineEdit>("flow_low")->text().toDouble(),
               high = part<QLineEdit>("flow_high")->text().toDouble();
  EXPECT_NEAR(high - low, 0.975 * 2.0, 0.025)
      << "from ring 1 to ring 79 of 81, each end outwards to hundredths";
  auto* automatic = part<QCheckBox>("flow_automatic");
  automatic->setFocus();
  QTest::keyClick(automatic, Qt::Key_Space);
  EXPECT_FALSE(part<QLabel>("flow_range_trouble")->isVisible());
}

TEST_F(FlowResultWindow, WhatIsNoResultIsSaidAndNothingChanges) {
  open_case();
  write_wall(wall);
  const geometry::TriMesh plain{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  io::write_surface(folder / "plain.vtp", plain);
  core::write_file(folder / "broken.vtp", "<VTKFile type=\"PolyData\">");
  for (const auto& [name, part_of_message] :
       {std::pair("plain.vtp", "without values"), {"broken.vtp", "broken.vtp"}, {"none.vtp", "none.vtp"}}) {
    window().flow_results().open({folder / name});
    const std::string text = message();
    EXPECT_NE(text.find(part_of_message), std::string::npos) << text;
    EXPECT_FALSE(window().flow_results().shown());
  }
}

TEST_F(FlowResultWindow, AllOfItCanBeSeenInASmallWindowInEveryLanguage) {
  write_mesh();
  for (const Language& language : languages()) {
    use_language(language.code.toStdString());
    open_case({800, 600});
    ask();
    ASSERT_TRUE(ready());
    type(part<QDoubleSpinBox>("flow_density", dialog), "1");
    pick(part<QComboBox>("flow_solver", dialog), 1);  // as much text as there is
    settle();
    EXPECT_LE(dialog->width(), 800) << language.code.toStdString();
    EXPECT_LE(dialog->height(), 560) << language.code.toStdString();
    QStringList faults = testing::layout_faults(*dialog);
    EXPECT_TRUE(faults.isEmpty()) << faults.join('\n').toStdString();
    QTest::keyClick(dialog, Qt::Key_Escape);
    write_wall(wall);
    window().flow_results().open({wall});
    ASSERT_TRUE(wait_until([&] { return idle() && window().flow_results().shown(); }));
    settle();
    EXPECT_TRUE(part<FlowBar>("flow_bar")->isVisible()) << "its tab is not in front";
    EXPECT_LE(window().width(), 800);
    EXPECT_LE(window().height(), 600);
    faults = testing::layout_faults(window());
    EXPECT_TRUE(faults.isEmpty()) << faults.join('\n').toStdString();
    part<QAction>("file.close")->trigger();
    EXPECT_TRUE(wait_until([&] { return !test->bench().has_case(); }));
    test.reset();
    for (QTranslator* one : qApp->findChildren<QTranslator*>()) QCoreApplication::removeTranslator(one);
  }
  use_language(std::string("en"));
}

}  // namespace
}  // namespace ostia::workstation
