// The heart in 3D in the window: prepared in the background, without bones, with its look, box and scissors,
// and the C-arm's angles.

#include "tube_case.h"
#include "views/heart_memory.h"
#include "views/heart_volume.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"
#include "ostia/view/volume_box.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QInputDialog>
#include <QSlider>
#include <QTest>
#include <QWindow>
#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::wait_until;
using view::Vec3;

// A bone beside the tube: a shell about marrow.
const Vec3 bone_middle(8.2, 0.0, 20.0);
constexpr double bone_mm = 3.9, marrow_mm = 2.0;

imaging::ImageVolume tube_beside_a_bone() {
  imaging::ImageVolume image = testing::tube_image();
  const auto& size = image.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const Vec3 at =
            image.geometry.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        const double out = std::hypot(at.x() - bone_middle.x(), at.y() - bone_middle.y());
        if (out < bone_mm) image(i, j, k) = out < marrow_mm ? 250 : 900;
      }
  return image;
}

struct HeartWindow : ::testing::Test {
  testing::Folder folder;
  std::unique_ptr<testing::TestWindow> test;
  QWindow* native = nullptr;

  HeartWindow() {
    const fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
    imaging::write_image(image, tube_beside_a_bone());
    session::CaseFile::create(case_file, testing::tube_model(), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
    test = std::make_unique<testing::TestWindow>(state);
    test->open(case_file);
    for (QWindow* one : QGuiApplication::allWindows())
      if (one->inherits("QVTKOpenGLWindow") && one->isExposed()) native = one;
    if (!native) throw std::runtime_error("the tree's window is not on the screen");
    testing::let_rest();
    scene().set_pose(view::pose_from(view::ViewFrom::anterior, {0.0, 0.0, 20.0}, 24.0));
    test->window().scene().request_render();
    testing::let_rest();
  }
  HeartVolume& heart() { return test->window().heart(); }
  view::TreeScene& scene() { return test->window().scene().scene(); }
  template <class Widget>
  Widget& child(const char* name) {
    auto* found = test->window().findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("the window has no ") + name);
    return *found;
  }
  void run(const char* command) { child<QAction>(command).trigger(); }
  bool is_ready() {
    return wait_until([&] { return heart().shown() && !test->window().jobs().any(); });
  }
  bool picked() { return scene().pick(scene().project({0.0, -1.5, 13.0})).has_value(); }
  void choose_behind(int row) {
    auto& mode = child<QComboBox>("volume_mode");
    mode.setCurrentIndex(row);
    emit mode.activated(row);
  }
  /// The CT number that is shown at a place; air where it is beyond what is shown.
  int hu_at(const Vec3& place) {
    const imaging::ImageVolume& image = *heart().shown();
    const Vec3 at = image.geometry.index(place);
    return image(std::lround(at.x()), std::lround(at.y()), std::lround(at.z()));
  }
  void mouse(QEvent::Type type, const Vec3& place, Qt::MouseButton button, Qt::MouseButtons held) {
    const geometry::Vec2 px = scene().project(place);
    const double ratio = native->devicePixelRatio();
    const QPointF where(px.x() / ratio, native->height() - px.y() / ratio);
    QMouseEvent event(type, where, native->mapToGlobal(where.toPoint()), button, held, Qt::NoModifier);
    QApplication::sendEvent(native, &event);
  }
  /// Around the places from z = 10 to z = 16 mm, across all of the image.
  void draw_around(bool let_go = true) {
    const std::vector<Vec3> way{{-14, 0, 10}, {-14, 0, 16}, {14, 0, 16}, {14, 0, 10}, {-13, 0, 10}};
    mouse(QEvent::MouseButtonPress, way.front(), Qt::LeftButton, Qt::LeftButton);
    for (std::size_t n = 0; n + 1 < way.size(); ++n)
      for (int step = 1; step <= 8; ++step)
        mouse(QEvent::MouseMove, way[n] + step / 8.0 * (way[n + 1] - way[n]), Qt::NoButton, Qt::LeftButton);
    if (let_go) mouse(QEvent::MouseButtonRelease, way.back(), Qt::LeftButton, Qt::NoButton);
  }
};

const Vec3 in_the_tube(0.0, 0.0, 13.0), above_it(0.0, 0.0, 22.0), in_the_shell(bone_middle + Vec3(3.0, 0, 0));

TEST_F(HeartWindow, IsWithoutBonesUntilTheyAreAskedFor) {
  EXPECT_FALSE(heart().shown()) << "nothing is prepared before it is wanted";
  choose_behind(1);
  ASSERT_TRUE(is_ready());
  EXPECT_GT(hu_at(in_the_tube), 300);
  EXPECT_LT(hu_at(in_the_shell), -500);
  EXPECT_FALSE(heart().histogram().empty());
  EXPECT_TRUE(picked());
  run("heart.tree");
  EXPECT_FALSE(picked()) << "the tree is not there any more";
  choose_behind(0);
  EXPECT_TRUE(picked()) << "without a heart there has to be a tree";
  choose_behind(1);
  EXPECT_FALSE(picked());
  run("heart.tree");
  EXPECT_TRUE(picked());
  run("heart.alone");
  ASSERT_TRUE(wait_until([&] { return hu_at(in_the_shell) > 700; }));
  run("heart.alone");
  ASSERT_TRUE(wait_until([&] { return hu_at(in_the_shell) < -500; }));
}

TEST_F(HeartWindow, ScissorsCutWhatTheHandDrawsAround) {
  run("heart.cut_inside");  // shows the heart by itself
  ASSERT_TRUE(is_ready());
  EXPECT_EQ(child<QComboBox>("volume_mode").currentIndex(), 1);
  const view::CameraPose before = scene().pose();
  draw_around();
  ASSERT_TRUE(wait_until([&] { return hu_at(in_the_tube) < -500; }));
  EXPECT_GT(hu_at(above_it), 300);
  EXPECT_LT((scene().pose().towards - before.towards).norm(), 1e-12) << "the hand turned the tree";
  EXPECT_EQ(heart().cuts(), 1U);

  run("heart.cut_outside");
  draw_around();
  ASSERT_TRUE(wait_until([&] { return hu_at(above_it) < -500; }));
  run("heart.undo_cut");
  ASSERT_TRUE(wait_until([&] { return hu_at(above_it) > 300; }));
  EXPECT_LT(hu_at(in_the_tube), -500) << "one step at a time";
  run("heart.undo_cut");
  ASSERT_TRUE(wait_until([&] { return hu_at(in_the_tube) > 300; }));
  run("heart.undo_cut");
  EXPECT_EQ(heart().cuts(), 0U);
}

TEST_F(HeartWindow, EscapeLaysTheScissorsDown) {
  run("heart.cut_inside");
  ASSERT_TRUE(is_ready());
  draw_around(false);
  QTest::keyClick(native, Qt::Key_Escape);
  mouse(QEvent::MouseButtonRelease, {-13, 0, 10}, Qt::LeftButton, Qt::NoButton);
  testing::let_rest();
  EXPECT_EQ(heart().cuts(), 0U);
  const view::CameraPose before = scene().pose();
  draw_around();  // turns the tree again
  testing::let_rest();
  EXPECT_GT((scene().pose().towards - before.towards).norm(), 1e-3);
  EXPECT_EQ(heart().cuts(), 0U);
}

TEST_F(HeartWindow, SlidersChangeLookAndBoxAndAreSetBack) {
  run("heart.controls");
  ASSERT_TRUE(child<QDockWidget>("heart").isVisible());
  run("heart.look_bone");
  ASSERT_TRUE(is_ready());
  EXPECT_EQ(heart().look(), (view::VolumeLook{view::VolumePreset::bone, 0.0, 1.0}));
  EXPECT_EQ(child<QComboBox>("heart_look").currentText(), "Bone");
  child<QSlider>("heart_shift").setValue(120);
  child<QSlider>("heart_stretch").setValue(50);
  EXPECT_NEAR(heart().shift_hu.get(), 120.0, 1e-9);
  EXPECT_GT(heart().stretch.get(), 1.5);
  auto& curve = child<QWidget>("heart_curve");
  testing::send(curve, QEvent::MouseButtonPress, {60, 30}, Qt::LeftButton, Qt::LeftButton);
  testing::send(curve, QEvent::MouseMove, {40, 30}, Qt::NoButton, Qt::LeftButton);
  testing::send(curve, QEvent::MouseButtonRelease, {40, 30}, Qt::LeftButton, Qt::NoButton);
  EXPECT_LT(heart().shift_hu.get(), 100.0);
  testing::send(curve, QEvent::MouseButtonDblClick, {40, 30}, Qt::LeftButton, Qt::LeftButton);
  EXPECT_EQ(child<QSlider>("heart_shift").value(), 0);
  EXPECT_EQ(child<QSlider>("heart_stretch").value(), 0);

  child<QSlider>("heart_from_3").setValue(80);
  EXPECT_NEAR(heart().crop.get().low[2], 0.4, 1e-9);
  child<QSlider>("heart_to_3").setValue(10);  // pushes the other side before it
  EXPECT_LT(heart().crop.get().low[2], heart().crop.get().high[2]);
  EXPECT_NEAR(heart().crop.get().high[2], 0.05, 0.006);
  run("heart.all_back");
  EXPECT_TRUE(heart().crop.get().whole());
  EXPECT_EQ(child<QSlider>("heart_from_3").value(), 0);
}

TEST_F(HeartWindow, ASideOfTheBoxIsPulledByTheMouse) {
  run("heart.box");  // shows the heart by itself
  ASSERT_TRUE(is_ready());
  testing::let_rest();
  const auto top = [&] { return view::faces_of(heart().crop.get(), heart().shown()->geometry)[5]; };
  const view::CameraPose before = scene().pose();
  const Vec3 from = top().middle, to = from - 12.0 * Vec3::UnitZ();
  mouse(QEvent::MouseMove, from, Qt::NoButton, Qt::NoButton);
  EXPECT_EQ(native->cursor().shape(), Qt::SizeAllCursor) << "something to take hold of is there";
  const auto pull = [&] {
    mouse(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
    for (int step = 1; step <= 6; ++step)
      mouse(QEvent::MouseMove, from + step / 6.0 * (to - from), Qt::NoButton, Qt::LeftButton);
  };
  pull();
  EXPECT_NEAR((top().middle - to).norm(), 0.0, 0.3);
  QTest::keyClick(native, Qt::Key_Escape);
  mouse(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
  EXPECT_TRUE(heart().crop.get().whole()) << "Escape takes it back";
  pull();
  mouse(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
  EXPECT_NEAR((top().middle - to).norm(), 0.0, 0.3);
  EXPECT_EQ(heart().crop.get().low, (std::array{0.0, 0.0, 0.0}));
  EXPECT_LT((scene().pose().towards - before.towards).norm(), 1e-12) << "the hand turned the tree";
  EXPECT_LT(child<QSlider>("heart_to_3").value(), 200) << "the dock follows";
  testing::on_screen(test->window(), "heart-box");
  run("heart.box");  // without it the mouse turns the tree again
  testing::let_rest();
  mouse(QEvent::MouseButtonPress, top().middle, Qt::LeftButton, Qt::LeftButton);
  mouse(QEvent::MouseMove, top().middle + Vec3(6, 0, 0), Qt::NoButton, Qt::LeftButton);
  mouse(QEvent::MouseMove, top().middle + Vec3(9, 0, 0), Qt::NoButton, Qt::LeftButton);
  mouse(QEvent::MouseButtonRelease, top().middle + Vec3(9, 0, 0), Qt::LeftButton, Qt::NoButton);
  EXPECT_GT((scene().pose().towards - before.towards).norm(), 1e-3);
}

TEST_F(HeartWindow, ScissorsWorkBesideTheBoxAndGiveItBack) {
  run("heart.box");
  ASSERT_TRUE(is_ready());
  run("heart.cut_inside");
  draw_around();
  ASSERT_TRUE(wait_until([&] { return hu_at(in_the_tube) < -500; }));
  testing::let_rest();
  const Vec3 top = view::faces_of(heart().crop.get(), heart().shown()->geometry)[5].middle;
  mouse(QEvent::MouseButtonPress, top, Qt::LeftButton, Qt::LeftButton);
  mouse(QEvent::MouseMove, top - Vec3(0, 0, 5), Qt::NoButton, Qt::LeftButton);
  mouse(QEvent::MouseButtonRelease, top - Vec3(0, 0, 5), Qt::LeftButton, Qt::NoButton);
  EXPECT_LT(heart().crop.get().high[2], 1.0);
}

TEST_F(HeartWindow, CutsAndBoxComeBackWithTheCaseAndTheLookWithTheWindow) {
  run("heart.look_bone");
  heart().shift_hu.set(60.0);
  run("heart.cut_inside");
  ASSERT_TRUE(is_ready());
  draw_around();
  ASSERT_TRUE(wait_until([&] { return hu_at(in_the_tube) < -500; }));
  view::VolumeCrop box;
  box.low = {0.0, 0.1, 0.25};
  box.high = {0.9, 1.0, 0.75};
  heart().crop.set(box);
  // Where the sides that cut something off lie in the patient, mm.
  const auto sides = [this] {
    const auto faces = view::faces_of(heart().crop.get(), heart().crop_grid());
    std::vector<double> mm;
    for (const std::size_t side : {1U, 2U, 4U, 5U}) mm.push_back(faces[side].middle.dot(faces[side].towards));
    return mm;
  };
  using ::testing::DoubleNear;
  const std::vector<double> set = sides();
  const auto where_they_were = ::testing::ElementsAre(DoubleNear(set[0], 0.02), DoubleNear(set[1], 0.02),
                                                      DoubleNear(set[2], 0.02), DoubleNear(set[3], 0.02));
  const std::vector<view::VolumeCut> cuts = heart().all_cuts();
  ASSERT_EQ(cuts.size(), 1U);
  const fs::path case_file = folder / "tube.ostia";
  test->window().close();
  test.reset();
  {
    const auto file = session::CaseFile::open(case_file, session::OpenMode::read_only);
    EXPECT_TRUE(file.setting("heart.box"));
    EXPECT_EQ(file.journal().size(), 1U) << "how it is looked at is no step";
  }
  test = std::make_unique<testing::TestWindow>(folder / "state");
  EXPECT_EQ(heart().look(), (view::VolumeLook{view::VolumePreset::bone, 60.0, 1.0}));
  EXPECT_EQ(heart().cuts(), 0U) << "without the case";
  test->open(case_file);
  ASSERT_EQ(heart().cuts(), 1U);
  ASSERT_EQ(heart().all_cuts()[0].outline_mm.size(), cuts[0].outline_mm.size());
  for (std::size_t n = 0; n < cuts[0].outline_mm.size(); ++n)
    EXPECT_LT((heart().all_cuts()[0].outline_mm[n] - cuts[0].outline_mm[n]).norm(), 0.08);
  EXPECT_THAT(sides(), where_they_were);
  choose_behind(1);
  ASSERT_TRUE(is_ready());
  EXPECT_THAT(sides(), where_they_were) << "the heart alone has a grid of its own";
  EXPECT_LT(hu_at(in_the_tube), -500) << "what was cut away is not there";
  EXPECT_GT(hu_at(above_it), 300);
  run("file.close");
  EXPECT_EQ(heart().cuts(), 0U) << "they are those of the case";
  EXPECT_TRUE(heart().crop.get().whole());
}

TEST_F(HeartWindow, WhatACaseCannotHoldIsNoCutAndNoBox) {
  for (const char* text :
       {"", "{}", "[1]", "[{}]", "nothing", R"([{"right":[1,0,0],"up":[1,0,0],"outline_mm":[]}])",
        R"([{"right":[1,0,0],"up":[0,0,1],"outline_mm":[0,0,1,1,2]}])"})
    EXPECT_FALSE(cuts_of_text(text)) << text;
  EXPECT_TRUE(cuts_of_text("[]"));
  for (const char* text :
       {"", "[]", "[[0,1],[0,1]]", "[[0,1],[0,1],[1,0]]", "[[0,1],[0,2],[0,1]]", "[0,1,2]"})
    EXPECT_FALSE(box_of_text(text)) << text;
  EXPECT_EQ(box_of_text("[[0,1],[0,1],[0.5,1]]")->low[2], 0.5);
  test->bench().session().file().set_settings(
      {{"heart.cuts", "spoilt"}, {"heart.box", "[[3,1],[0,1],[0,1]]"}});
  test->window().close();
  test.reset();
  test = std::make_unique<testing::TestWindow>(folder / "state");
  test->open(folder / "tube.ostia");
  EXPECT_EQ(heart().cuts(), 0U);
  EXPECT_TRUE(heart().crop.get().whole());
}

TEST_F(HeartWindow, FollowsTheSeriesThatTheViewsShow) {
  choose_behind(1);
  ASSERT_TRUE(is_ready());
  ASSERT_GT(hu_at(in_the_tube), 300);
  const int own = hu_at(in_the_tube);
  run("heart.cut_inside");
  draw_around();
  ASSERT_TRUE(wait_until([&] { return hu_at(in_the_tube) < -500; }));
  imaging::ImageVolume brighter = *test->bench().image().volume;
  for (std::int16_t& hu : brighter.voxels)
    if (hu > 200) hu = static_cast<std::int16_t>(hu + 150);
  session::OtherImage other;
  other.volume = std::make_shared<const imaging::ImageVolume>(std::move(brighter));
  other.name = "45 %";
  test->bench().show_other_image(std::make_shared<const session::OtherImage>(other));
  ASSERT_TRUE(wait_until([&] { return hu_at(above_it) > own + 100; }));
  EXPECT_LT(hu_at(in_the_tube), -500) << "the cuts are those of the patient";
  test->bench().show_other_image(nullptr);
  ASSERT_TRUE(wait_until([&] { return hu_at(above_it) < own + 50; }));
}

TEST_F(HeartWindow, AnglesAreTypedAndChosenAsTheLaboratorySays) {
  const auto type = [&](const QString& text) {
    QTimer::singleShot(0, &test->window(), [&, text] {
      auto* dialog = test->window().findChild<QInputDialog*>();
      ASSERT_TRUE(dialog);
      dialog->setTextValue(text);
      dialog->accept();
    });
    run("camera.angles");
    testing::let_rest();
  };
  type("LAO 90");
  EXPECT_LT((scene().pose().towards - Vec3::UnitX()).norm(), 1e-6) << "from the patient's left";
  type("rao 30, cau 25");
  const view::CarmAngles angles = view::carm_angles(scene().pose());
  EXPECT_NEAR(angles.lao_deg, -30.0, 1e-6);
  EXPECT_NEAR(angles.cranial_deg, -25.0, 1e-6);
  run("camera.lao45_caudal25");
  testing::let_rest();
  EXPECT_NEAR(view::carm_angles(scene().pose()).lao_deg, 45.0, 1e-6);
  EXPECT_NEAR(view::carm_angles(scene().pose()).cranial_deg, -25.0, 1e-6);
  run("camera.ap0_caudal30");
  testing::let_rest();
  EXPECT_NEAR(view::carm_angles(scene().pose()).cranial_deg, -30.0, 1e-6);
}

}  // namespace
}  // namespace ostia::workstation
