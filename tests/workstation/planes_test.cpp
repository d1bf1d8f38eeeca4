// Three linked planes, layouts and grey levels of one's own, in the window and by the mouse.

#include "shell/layouts.h"
#include "tube_window.h"
#include "views/grey_presets.h"
#include "views/planes_dock.h"

#include <gmock/gmock.h>

#include <QDoubleSpinBox>
#include <QInputDialog>
#include <QMenu>
#include <QTimer>
#include <QWheelEvent>

namespace ostia::workstation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::sweep;
using view::LinkedPlane;
using view::LinkedPlaneView;
using view::Vec2;

QPoint pixel(const Vec2& px) {
  return {static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y()))};
}

struct Planes : testing::TubeWindow {
  Planes() { open_case(); }
  void command(const char* id) {
    part<QAction>(id)->trigger();
    settle();
  }
  LinkedPlaneView& plane(const char* name) {
    return dynamic_cast<LinkedPlaneView&>(part<PictureWidget>(name)->view());
  }
  static void turn_wheel(QWidget& widget, int clicks, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    const QPoint at = widget.rect().center();
    QWheelEvent event(at, widget.mapToGlobal(at), {}, {0, 120 * clicks}, Qt::NoButton, keys,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&widget, &event);
    QApplication::processEvents();
  }
  std::string place() { return part<QLabel>("place")->text().toStdString(); }
  void start_again() {
    window().close();
    test.reset();
    test = std::make_unique<testing::TestWindow>(folder / "state");
    settle();
  }
  /// The next dialog that asks for a name is given it.
  static void answer_name(const QString& name) {
    QTimer::singleShot(200, [name] {
      auto* dialog = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
      ASSERT_TRUE(dialog);
      dialog->setTextValue(name);
      dialog->accept();
    });
  }
};

TEST_F(Planes, AreALayoutOfTheirOwn) {
  EXPECT_FALSE(window().planes().isVisible());
  command("view.layout_planes");
  for (const char* name : {"plane_axial", "plane_coronal", "plane_sagittal"})
    EXPECT_TRUE(part<PictureWidget>(name)->isVisible()) << name;
  EXPECT_FALSE(window().centralWidget()->isVisible());
  EXPECT_GT(part<PictureWidget>("plane_axial")->width(), 600);
  command("view.layout_reading");
  EXPECT_TRUE(window().centralWidget()->isVisible());
  EXPECT_FALSE(window().planes().isVisible());
  EXPECT_TRUE(part<QWidget>("tree_panel")->isVisible());
}

TEST_F(Planes, NeverLeaveTheWindowEmpty) {
  command("view.layout_planes");
  window().planes().close();
  settle();
  EXPECT_TRUE(window().centralWidget()->isVisible());
  command("view.layout_planes");
  window().planes().setFloating(true);  // to another monitor
  settle();
  EXPECT_TRUE(window().centralWidget()->isVisible());
  EXPECT_TRUE(part<PictureWidget>("plane_axial")->isVisible());
}

TEST_F(Planes, OneCrosshairFollowsTheMouseInAllOfThem) {
  command("view.layout_planes");
  auto* axial = part<PictureWidget>("plane_axial");
  const QPoint there = axial->rect().center() + QPoint(60, -40);
  sweep(*axial, {axial->rect().center() + QPoint(10, 10), axial->rect().center() + QPoint(30, -20), there});
  const view::Vec3 wanted = *axial->view().world(Vec2(there.x(), there.y()));
  EXPECT_NEAR((test->bench().place.get() - wanted).norm(), 0.0, 1e-6);
  for (const char* name : {"plane_axial", "plane_coronal", "plane_sagittal"})
    EXPECT_NEAR(plane(name).project(wanted)->out_mm, 0.0, 1e-9) << name;
}

TEST_F(Planes, TheMouseTurnsThemAndAButtonPutsThemStraight) {
  command("view.layout_planes");
  auto* axial = part<PictureWidget>("plane_axial");
  LinkedPlaneView& view = plane("plane_axial");
  const Vec2 ring = view.grip_px({LinkedPlaneView::Grip::turn, LinkedPlane::coronal}, false);
  sweep(*axial, {pixel(ring), pixel(ring + Vec2(0, 30)), pixel(ring + Vec2(-10, 90))});
  view::LinkedPlanes& planes = window().planes().planes();
  EXPECT_FALSE(planes.straight());
  const view::Vec3 a = planes.axes(LinkedPlane::axial).normal(),
                   c = planes.axes(LinkedPlane::coronal).normal(),
                   s = planes.axes(LinkedPlane::sagittal).normal();
  EXPECT_NEAR(std::abs(a.dot(c)) + std::abs(a.dot(s)) + std::abs(c.dot(s)), 0.0, 1e-12);
  EXPECT_GT(std::acos(std::abs(c.y())), 0.05);
  QTest::mouseClick(part<QPushButton>("planes_reset"), Qt::LeftButton);
  EXPECT_TRUE(planes.straight());
}

TEST_F(Planes, TheSlabHasAKindAFieldAndTheWheel) {
  command("view.layout_planes");
  testing::pick(part<QComboBox>("planes_slab"), 2);
  EXPECT_EQ(test->bench().slab.get(), reformat::Slab::maximum);
  testing::type(part<QDoubleSpinBox>("planes_slab_mm"), "12.5");
  EXPECT_NEAR(test->bench().slab_mm.get(), 12.5, 1e-9);
  turn_wheel(*part<PictureWidget>("plane_coronal"), 2, Qt::ShiftModifier);
  EXPECT_NEAR(test->bench().slab_mm.get(), 14.5, 1e-9);
  auto* axial = part<PictureWidget>("plane_axial");
  LinkedPlaneView& view = plane("plane_axial");
  const Vec2 dot = view.grip_px({LinkedPlaneView::Grip::slab, LinkedPlane::coronal}, false);
  sweep(*axial, {pixel(dot), pixel(dot + Vec2(0, 40))});
  EXPECT_GT(test->bench().slab_mm.get(), 15.0);
  command("view.minip");
  EXPECT_EQ(test->bench().slab.get(), reformat::Slab::minimum);
}

TEST_F(Planes, TheCtNumberIsToldRightAfterEachScroll) {
  auto* slice = part<PictureWidget>("slice");
  testing::send(*slice, QEvent::MouseMove, slice->rect().center(), Qt::NoButton, Qt::NoButton);
  std::string before = place();
  EXPECT_THAT(before, HasSubstr("HU"));
  for (int i = 0; i < 3; ++i) {
    turn_wheel(*slice, 1);
    const view::Vec3 at = *slice->view().world(Vec2(slice->rect().center().x(), slice->rect().center().y()));
    EXPECT_THAT(place(), HasSubstr("z " + QString::number(at.z(), 'f', 1).toStdString()));
    EXPECT_NE(place(), before);
    before = place();
  }
}

TEST_F(Planes, WindowAndLevelAreWrittenWhileTheyChangeAndForAMoment) {
  auto* slice = part<PictureWidget>("slice");
  auto* moment = slice->findChild<QTimer*>("grey_told");
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->interval(), 4000);
  moment->setInterval(100);  // a test need not wait for what a person is given to read
  const QRect corner(slice->width() / 2, 0, slice->width() / 2, 22);
  const session::GreyWindow grey = test->bench().grey.get();
  const QImage without = slice->grab().toImage().copy(corner);
  test->bench().grey.set({grey.level_hu + 1.0, grey.width_hu});
  test->bench().grey.set(grey);
  EXPECT_NE(slice->grab().toImage().copy(corner), without);
  EXPECT_TRUE(testing::wait_until([&] { return slice->grab().toImage().copy(corner) == without; }, 8000));
}

TEST_F(Planes, TwoDAloneGivesTheTreesRoomToTheOthers) {
  const int before = part<QWidget>("cpr1")->width();
  command("view.layout_flat");
  EXPECT_FALSE(part<QWidget>("tree_panel")->isVisible());
  EXPECT_GT(part<QWidget>("cpr1")->width(), before);
  start_again();
  EXPECT_FALSE(part<QWidget>("tree_panel")->isVisible()) << "as it was left";
  command("view.layout_reading");
  EXPECT_TRUE(part<QWidget>("tree_panel")->isVisible());
}

TEST_F(Planes, ALayoutIsKeptUnderAName) {
  window().planes().show();
  window().planes().setFloating(true);
  window().planes().setGeometry(900, 200, 500, 420);
  settle();
  const QRect stood = window().planes().geometry();
  answer_name("  Two   monitors ");
  command("view.layout_save");
  EXPECT_THAT(window().layouts().names(), ElementsAre(QString("Two monitors")));
  command("view.layout_reading");
  EXPECT_FALSE(window().planes().isVisible());
  start_again();
  auto* menu = part<QAction>("view.layout_save")->associatedWidgets().isEmpty() ? nullptr : [&]() -> QMenu* {
    for (QWidget* widget : part<QAction>("view.layout_save")->associatedWidgets())
      if (auto* one = qobject_cast<QMenu*>(widget)) return one;
    return nullptr;
  }();
  ASSERT_TRUE(menu);
  emit menu->aboutToShow();
  ASSERT_EQ(menu->actions().back()->text(), "Two monitors");
  menu->actions().back()->trigger();
  settle();
  EXPECT_TRUE(window().planes().isFloating());
  EXPECT_TRUE(window().planes().isVisible());
  EXPECT_NEAR(window().planes().geometry().width(), stood.width(), 20);
  EXPECT_NEAR(window().planes().geometry().x(), stood.x(), 40);
  window().layouts().forget("Two monitors");
  EXPECT_THAT(window().layouts().names(), IsEmpty());
}

TEST_F(Planes, TheWindowBeginsWithTheLayoutThatIsSetAsFirst) {
  command("view.layout_planes");
  command("view.layout_first");
  command("view.layout_reading");
  start_again();
  EXPECT_TRUE(part<PictureWidget>("plane_axial")->isVisible());
  EXPECT_FALSE(window().centralWidget()->isVisible());
  command("view.layout_first");  // no longer
  command("view.layout_reading");
  start_again();
  EXPECT_FALSE(window().planes().isVisible());
}

TEST_F(Planes, GreyLevelsAreKeptUnderANameOnThisComputer) {
  test->bench().grey.set({120.0, 640.0});
  answer_name("Stents & calcium");
  command("window.save");
  test->bench().grey.set({0.0, 100.0});
  start_again();
  auto* presets = part<GreyPresets>("");
  EXPECT_THAT(presets->names(), ElementsAre(QString("Stents & calcium")));
  presets->use("Stents & calcium");
  EXPECT_EQ(test->bench().grey.get(), (session::GreyWindow{120.0, 640.0}));
  presets->use("none of this name");
  EXPECT_EQ(test->bench().grey.get(), (session::GreyWindow{120.0, 640.0}));
  presets->forget("Stents & calcium");
  EXPECT_THAT(presets->names(), IsEmpty());
}

TEST_F(Planes, DamagedSettingsAreAsIfThereWereNone) {
  window().desk().machine.set_setting("layouts.own", "{ no json");
  window().desk().machine.set_setting("window.own", "[1, 2]");
  window().desk().machine.set_setting("layouts.first", "own:gone");
  start_again();
  EXPECT_THAT(window().layouts().names(), IsEmpty());
  EXPECT_THAT(part<GreyPresets>("")->names(), IsEmpty());
  EXPECT_TRUE(window().centralWidget()->isVisible());
}

}  // namespace
}  // namespace ostia::workstation
