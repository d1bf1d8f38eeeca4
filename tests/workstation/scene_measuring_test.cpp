#include "measuring/list.h"
#include "shell/main_window.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QMessageBox>
#include <QStatusBar>
#include <QTest>
#include <QWindow>
#include <cmath>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using session::Tool;
using testing::wait_until;
using view::Vec3;

constexpr double narrowing = 0.5;  // of the radius at the throat

/// The program's window with the narrowed tube in it, the tree seen from the front.
struct SceneMeasuring : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  std::unique_ptr<testing::TestWindow> test;
  QWindow* native = nullptr;

  SceneMeasuring() {
    imaging::write_image(image, testing::tube_image(narrowing));
    session::CaseFile::create(case_file, testing::tube_model(narrowing), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
    test = std::make_unique<testing::TestWindow>(state);
    test->open(case_file);
    for (QWindow* one : QGuiApplication::allWindows())
      if (one->inherits("QVTKOpenGLWindow") && one->isExposed()) native = one;
    if (!native) throw std::runtime_error("the tree's window is not on the screen");
    settle();
    view::TreeScene& scene = test->window().scene().scene();
    scene.set_pose(view::pose_from(view::ViewFrom::anterior, {0.0, 0.0, 20.0}, 24.0));
    test->window().scene().request_render();
    settle();
  }
  session::Workbench& bench() { return test->bench(); }
  static void settle() { testing::let_rest(); }
  std::vector<analysis::Measurement> made() { return bench().session().file().annotations()->measurements; }
  /// Where a place of the patient is in the tree's window.
  QPointF at(const Vec3& place) {
    const geometry::Vec2 px = test->window().scene().scene().project(place);
    const double ratio = native->devicePixelRatio();
    return {px.x() / ratio, native->height() - px.y() / ratio};
  }
  /// On the near wall, in the middle of the vessel as it is seen.
  QPointF wall(double z) { return at({0.0, -testing::tube_radius(z, narrowing), z}); }
  void mouse(QEvent::Type type, const QPointF& where, Qt::MouseButton button, Qt::MouseButtons held) {
    QMouseEvent event(type, where, native->mapToGlobal(where.toPoint()), button, held, Qt::NoModifier);
    QApplication::sendEvent(native, &event);
  }
  void click(const QPointF& where) {
    mouse(QEvent::MouseMove, where, Qt::NoButton, Qt::NoButton);
    mouse(QEvent::MouseButtonPress, where, Qt::LeftButton, Qt::LeftButton);
    mouse(QEvent::MouseButtonRelease, where, Qt::LeftButton, Qt::NoButton);
    settle();
  }
  void drag(const std::vector<QPointF>& way) {
    mouse(QEvent::MouseMove, way.front(), Qt::NoButton, Qt::NoButton);
    mouse(QEvent::MouseButtonPress, way.front(), Qt::LeftButton, Qt::LeftButton);
    for (const QPointF& where : way) mouse(QEvent::MouseMove, where, Qt::NoButton, Qt::LeftButton);
    mouse(QEvent::MouseButtonRelease, way.back(), Qt::LeftButton, Qt::NoButton);
    settle();
  }
  void key(int which) {
    QTest::keyClick(native, static_cast<Qt::Key>(which));  // as from the keyboard: shortcuts first
    settle();
  }
  void choose(const char* tool) { test->window().findChild<QAction*>(tool)->trigger(); }
  MeasurementList& list() { return *test->window().findChild<MeasurementList*>("measurements"); }
};

TEST_F(SceneMeasuring, DistanceAndStenosisAreListedDraggedUndoneAndExported) {
  choose("tool.distance");
  click(wall(6.0));
  EXPECT_TRUE(made().empty());
  click(wall(16.0));
  choose("tool.stenosis");
  click(wall(34.0));
  click(wall(14.0));
  ASSERT_EQ(made().size(), 2U);
  EXPECT_NEAR(bench().measured(made()[0]).front().value, 10.0, 0.15);
  EXPECT_NEAR(made()[1].from_mm, 14.0, 0.2);
  EXPECT_NEAR(made()[1].to_mm, 34.0, 0.2);
  EXPECT_NEAR(bench().measured(made()[1]).front().value, 100.0 * narrowing, 4.0);
  ASSERT_TRUE(wait_until([&] { return list().topLevelItemCount() == 2; }, 2000));
  EXPECT_TRUE(list().topLevelItem(1)->text(1).endsWith("%"));

  // The distal end goes to the throat's proximal side: no narrowing is left between the two.
  drag({at({0.0, 0.0, made()[1].to_mm}), wall(28.0), wall(22.0), wall(17.0)});
  EXPECT_NEAR(made()[1].to_mm, 17.0, 0.2);
  EXPECT_LT(bench().measured(made()[1]).front().value, 8.0);
  test->window().findChild<QAction*>("edit.undo")->trigger();
  settle();
  EXPECT_NEAR(made()[1].to_mm, 34.0, 0.2) << "the drag was more than one step";
  EXPECT_NEAR(bench().measured(made()[1]).front().value, 100.0 * narrowing, 4.0);

  test->window().findChild<QAction*>("file.report")->trigger();
  const fs::path table = folder / "tube-report" / "measurements.csv";
  ASSERT_TRUE(wait_until([&] { return !test->window().jobs().any() && fs::exists(table); }, 60000));
  const std::string text = core::read_file(table);
  EXPECT_NE(text.find("1,distance,,,length,"), std::string::npos) << text;
  EXPECT_NE(text.find("2,stenosis,,LAD,percent diameter,"), std::string::npos) << text;
  for (QWidget* widget : QApplication::topLevelWidgets())
    if (auto* box = qobject_cast<QMessageBox*>(widget)) box->close();
}

TEST_F(SceneMeasuring, ADragBesideHandlesTurnsAndPlacesNothing) {
  choose("tool.distance");
  const Vec3 before = test->window().scene().scene().pose().towards;
  drag({wall(20.0), wall(20.0) + QPointF(30.0, 0.0), wall(20.0) + QPointF(60.0, 10.0)});
  EXPECT_GT((test->window().scene().scene().pose().towards - before).norm(), 0.1);
  EXPECT_FALSE(test->window().scene().pointer().busy());
  EXPECT_TRUE(made().empty());
}

TEST_F(SceneMeasuring, KeysCancelAndDeleteAndTheCursorTells) {
  choose("tool.angle");
  click(wall(10.0));
  EXPECT_TRUE(test->window().scene().pointer().busy());
  EXPECT_EQ(native->cursor().shape(), Qt::CrossCursor);
  key(Qt::Key_Escape);
  EXPECT_FALSE(test->window().scene().pointer().busy());
  EXPECT_EQ(bench().tool.get(), Tool::angle) << "the tool went with what was begun";
  choose("tool.diameter");
  click(wall(10.0));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(bench().measured(made()[0]).front().value, 2.0 * testing::tube_radius_mm, 0.05);
  bench().cursor_mm.set(25.0);
  ASSERT_TRUE(wait_until([&] { return list().topLevelItemCount() == 1; }, 2000));
  emit list().itemDoubleClicked(list().topLevelItem(0), 0);
  EXPECT_NEAR(bench().cursor_mm.get(), 10.0, 0.2);
  mouse(QEvent::MouseMove, at(made()[0].points[0]), Qt::NoButton, Qt::NoButton);
  EXPECT_EQ(native->cursor().shape(), Qt::PointingHandCursor);
  mouse(QEvent::MouseMove, QPointF(3.0, 3.0), Qt::NoButton, Qt::NoButton);
  EXPECT_EQ(native->cursor().shape(), Qt::ArrowCursor);
  key(Qt::Key_Delete);
  EXPECT_TRUE(made().empty());
}

TEST_F(SceneMeasuring, AClickBesideTheWallIsAnsweredInTheStatusLine) {
  choose("tool.area");
  test->window().statusBar()->clearMessage();
  click(at({9.0, 0.0, 20.0}));
  EXPECT_TRUE(test->window().statusBar()->currentMessage().contains("wall"))
      << test->window().statusBar()->currentMessage().toStdString();
  EXPECT_TRUE(made().empty());
  click(wall(8.0));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(bench().measured(made()[0]).front().value,
              M_PI * testing::tube_radius_mm * testing::tube_radius_mm, 0.25);
}

}  // namespace
}  // namespace ostia::workstation
