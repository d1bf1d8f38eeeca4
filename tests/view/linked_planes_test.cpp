#include "ostia/view/linked_planes.h"

#include "bench_case.h"

#include "ostia/view/pointer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::view {
namespace {

using testing::TubeCase;
using Axes = LinkedPlanes::Axes;

constexpr std::array planes_of_all{LinkedPlane::axial, LinkedPlane::coronal, LinkedPlane::sagittal};

/// Farthest that three frames are from being orthonormal, and their normals from right angles.
double fault(const LinkedPlanes& planes) {
  double worst = 0.0;
  for (const LinkedPlane one : planes_of_all) {
    const Axes& axes = planes.axes(one);
    worst = std::max(
        {worst, std::abs(axes.u.norm() - 1.0), std::abs(axes.v.norm() - 1.0), std::abs(axes.u.dot(axes.v))});
    for (const LinkedPlane other : planes_of_all)
      if (other != one) worst = std::max(worst, std::abs(axes.normal().dot(planes.axes(other).normal())));
  }
  return worst;
}

TEST(LinkedPlanes, BeginAsRadiologistsHangThem) {
  const LinkedPlanes planes;
  EXPECT_TRUE(planes.straight());
  EXPECT_EQ(planes.axes(LinkedPlane::axial).u, Vec3(1, 0, 0));
  EXPECT_EQ(planes.axes(LinkedPlane::axial).v, Vec3(0, 1, 0));
  EXPECT_EQ(planes.axes(LinkedPlane::coronal).v, Vec3(0, 0, -1));
  EXPECT_EQ(planes.axes(LinkedPlane::sagittal).u, Vec3(0, 1, 0));
  EXPECT_EQ(fault(planes), 0.0);
}

TEST(LinkedPlanes, StayAtRightAnglesAfterAnyTurns) {
  LinkedPlanes planes;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-0.2, 0.2);
  std::uniform_int_distribution<std::size_t> which(0, 2);
  for (int i = 0; i < 20000; ++i) planes.turn(planes_of_all.at(which(random)), angle(random));
  EXPECT_LT(fault(planes), 1e-9);
  EXPECT_FALSE(planes.straight());
  planes.reset();
  EXPECT_TRUE(planes.straight());
  EXPECT_EQ(fault(planes), 0.0);
}

TEST(LinkedPlanes, ATurnLeavesThePictureThatItIsMadeInAlone) {
  LinkedPlanes planes;
  planes.turn(LinkedPlane::axial, 0.3);
  EXPECT_EQ(planes.axes(LinkedPlane::axial).u, Vec3(1, 0, 0));
  // From u (left) towards v (back): the coronal plane's picture runs to the right along it.
  EXPECT_NEAR((planes.axes(LinkedPlane::coronal).u - Vec3(std::cos(0.3), std::sin(0.3), 0)).norm(), 0.0,
              1e-12);
  EXPECT_NEAR((planes.axes(LinkedPlane::coronal).v - Vec3(0, 0, -1)).norm(), 0.0, 1e-12);
  planes.turn(LinkedPlane::axial, std::nan(""));
  EXPECT_LT(fault(planes), 1e-12);
}

struct ThreeViews : ::testing::Test {
  TubeCase tube;
  std::shared_ptr<LinkedPlanes> planes = std::make_shared<LinkedPlanes>();
  LinkedPlaneView axial{tube.bench, LinkedPlane::axial, planes};
  LinkedPlaneView coronal{tube.bench, LinkedPlane::coronal, planes};
  LinkedPlaneView sagittal{tube.bench, LinkedPlane::sagittal, planes};
  Pointer hand{axial};
  ThreeViews() {
    for (LinkedPlaneView* one : {&axial, &coronal, &sagittal}) one->set_size(300, 300, 1.0);
    tube.bench.place.set({1.0, -2.0, 12.0});
  }
  static PointerEvent at(const Vec2& px, Button button = Button::left) {
    PointerEvent event;
    event.px = px;
    event.button = button;
    return event;
  }
  void drag(const Vec2& from, const std::vector<Vec2>& way) {
    hand.press(at(from));
    for (const Vec2& px : way) hand.move(at(px));
    hand.release(at(way.back()));
  }
};

TEST_F(ThreeViews, AllShowTheCursorsPlace) {
  planes->turn(LinkedPlane::coronal, 0.4);
  for (LinkedPlaneView* one : {&axial, &coronal, &sagittal}) {
    ASSERT_TRUE(one->ready());
    const auto shown = one->project(tube.bench.place.get());
    ASSERT_TRUE(shown);
    EXPECT_NEAR(shown->out_mm, 0.0, 1e-9);
  }
}

TEST_F(ThreeViews, TheCrosshairFollowsTheMouse) {
  const Vec2 there(180.0, 120.0);
  drag(Vec2(150.0, 150.0), {Vec2(160.0, 140.0), there});
  EXPECT_NEAR((axial.project(tube.bench.place.get())->px - there).norm(), 0.0, 1e-6);
  EXPECT_NEAR(tube.bench.place.get().z(), 12.0, 1e-9);
  EXPECT_TRUE(planes->straight());
}

TEST_F(ThreeViews, ARingTurnsTheOtherTwoAsFarAsTheHandGoes) {
  const Vec2 centre = axial.project(tube.bench.place.get())->px;
  const Vec2 ring = axial.grip_px({LinkedPlaneView::Grip::turn, LinkedPlane::coronal}, false);
  ASSERT_TRUE(axial.hold_at(ring));
  EXPECT_EQ(axial.hold_at(ring)->plane, LinkedPlane::coronal);
  const double angle = 0.5;
  const Vec2 from = ring - centre;
  const auto turned = [&](double by) { return Vec2(centre + Eigen::Rotation2Dd(by) * from); };
  drag(ring, {turned(0.2), turned(0.35), turned(angle)});
  EXPECT_NEAR((planes->axes(LinkedPlane::coronal).u - Vec3(std::cos(angle), std::sin(angle), 0)).norm(), 0.0,
              1e-9);
  EXPECT_LT(fault(*planes), 1e-12);
  // The ring stays in the hand.
  EXPECT_NEAR(
      (axial.grip_px({LinkedPlaneView::Grip::turn, LinkedPlane::coronal}, false) - turned(angle)).norm(), 0.0,
      1e-6);
  EXPECT_EQ(tube.bench.place.get(), Vec3(1.0, -2.0, 12.0));
}

TEST_F(ThreeViews, ADotMakesTheSlabAsThickAsItIsDragged) {
  tube.bench.slab.set(reformat::Slab::maximum);
  tube.bench.slab_mm.set(6.0);
  const LinkedPlaneView::Hold hold{LinkedPlaneView::Grip::slab, LinkedPlane::coronal};
  const Vec2 dot = axial.grip_px(hold, false);
  const double pixel = axial.pixel_mm();
  // The coronal plane's normal points to the back, down in the axial picture.
  drag(dot, {dot + Vec2(0.0, 2.0 / pixel)});
  EXPECT_NEAR(tube.bench.slab_mm.get(), 10.0, 1e-6);
  EXPECT_TRUE(planes->straight());
}

TEST_F(ThreeViews, ShiftAndWheelMakeASlabAndThickenIt) {
  ASSERT_EQ(tube.bench.slab.get(), reformat::Slab::none);
  const double before = tube.bench.slab_mm.get();
  PointerEvent event = at(Vec2(100.0, 100.0), Button::none);
  event.shift = true;
  hand.wheel(2.0, event);
  EXPECT_EQ(tube.bench.slab.get(), reformat::Slab::maximum);
  EXPECT_NEAR(tube.bench.slab_mm.get(), before + 2.0, 1e-9);
  EXPECT_EQ(tube.bench.place.get().z(), 12.0);
}

TEST_F(ThreeViews, TheWheelGoesAlongThePlanesOwnNormal) {
  planes->turn(LinkedPlane::sagittal, 0.3);
  const Vec3 before = tube.bench.place.get(), normal = planes->axes(LinkedPlane::axial).normal();
  axial.scroll(3.0);
  const Vec3 by = tube.bench.place.get() - before;
  EXPECT_GT(by.norm(), 0.7);
  EXPECT_NEAR(by.cross(normal).norm(), 0.0, 1e-9);
}

TEST_F(ThreeViews, SlabsNameAndThicknessAreWritten) {
  const auto written = [&](const std::string& text) {
    for (LinkedPlaneView* one : {&axial, &coronal, &sagittal}) {
      bool found = false;
      for (const OverlayText& shown : one->overlay().texts) found |= shown.text == text;
      if (!found) return false;
    }
    return true;
  };
  tube.bench.slab_mm.set(20.0);
  EXPECT_FALSE(written("MIP 20.0 mm"));
  for (const auto& [slab, text] : {std::pair(reformat::Slab::maximum, "MIP 20.0 mm"),
                                   {reformat::Slab::minimum, "MinIP 20.0 mm"},
                                   {reformat::Slab::mean, "mean 20.0 mm"}}) {
    tube.bench.slab.set(slab);
    EXPECT_TRUE(written(text)) << text;
  }
}

TEST_F(ThreeViews, ASlabAcrossTheTubeIsAsWideAsTheTubeIs) {
  // Turned by 45 degrees about the left-right axis the tube is cut aslant; through its whole length it is
  // bright.
  tube.bench.place.set({0.0, 0.0, 15.0});
  tube.bench.slab.set(reformat::Slab::maximum);
  tube.bench.slab_mm.set(4.0);
  planes->turn(LinkedPlane::sagittal, M_PI / 4.0);
  const Vec2 middle = axial.project({0.0, 0.0, 15.0})->px;
  EXPECT_NEAR(*axial.value_at(middle), testing::tube_hu, 1.0);
  // Along the picture's height: a slab of t cut at angle a shows radius / cos a + t / 2 * tan a each way.
  const double reach = testing::tube_radius_mm * std::sqrt(2.0) + 2.0;
  const Vec2 down(0.0, 1.0 / axial.pixel_mm());
  EXPECT_GT(*axial.value_at(middle + (reach - 0.6) * down), 300.0);
  EXPECT_LT(*axial.value_at(middle + (reach + 0.6) * down), 50.0);
}

}  // namespace
}  // namespace ostia::view
