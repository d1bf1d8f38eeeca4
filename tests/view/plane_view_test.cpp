#include "ostia/view/plane_view.h"

#include "bench_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::view {
namespace {

using testing::TubeCase;

TEST(SectionView, ShowsTheLumenRoundAndInTheMiddle) {
  TubeCase tube;
  SectionView section(tube.bench, 0.0);
  section.set_size(400, 400, 1.0);
  tube.bench.cursor_mm.set(12.0);
  ASSERT_TRUE(section.ready());
  const auto& lines = section.contour_lines();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines.front().closed());
  for (const Vec2& p : lines.front().picture_px)
    EXPECT_NEAR((p - Vec2(200.0, 200.0)).norm() * section.pixel_mm(), testing::tube_radius_mm, 0.02);
  for (const Vec3& p : lines.front().world) EXPECT_NEAR(p.z(), tube.bench.axis()->point(12.0).z(), 1e-6);
}

TEST(SectionView, ShowsTheEndsToo) {
  TubeCase tube;
  SectionView section(tube.bench, 0.0);
  section.set_size(200, 200, 1.0);
  for (const double s : {0.0, testing::tube_length_mm}) {
    tube.bench.cursor_mm.set(s);
    EXPECT_EQ(section.contour_lines().size(), 1U) << s;
  }
}

TEST(SectionView, NeighboursEndWithTheVessel) {
  TubeCase tube;
  SectionView before(tube.bench, -2.0), after(tube.bench, 2.0);
  for (SectionView* view : {&before, &after}) view->set_size(100, 100, 1.0);
  tube.bench.cursor_mm.set(1.0);
  EXPECT_FALSE(before.ready());
  EXPECT_TRUE(after.ready());
  EXPECT_DOUBLE_EQ(after.s_mm(), 3.0);
}

TEST(SectionView, TheWheelWalksAlongTheVessel) {
  TubeCase tube;
  SectionView section(tube.bench, 0.0);
  section.set_size(100, 100, 1.0);
  tube.bench.cursor_mm.set(10.0);
  section.scroll(-2.0);
  EXPECT_DOUBLE_EQ(tube.bench.cursor_mm.get(), 11.0);
}

TEST(SliceView, HangsAsRadiologistsDo) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::axial);
  slice.set_size(300, 240, 1.0);
  tube.bench.cursor_mm.set(15.0);
  const Vec3 right = *slice.world({250.0, 100.0}) - *slice.world({150.0, 100.0});
  const Vec3 down = *slice.world({150.0, 200.0}) - *slice.world({150.0, 100.0});
  EXPECT_GT(right.x(), 0.0);
  EXPECT_GT(down.y(), 0.0);
  slice.set_kind(SliceKind::sagittal);
  EXPECT_GT((*slice.world({250.0, 100.0}) - *slice.world({150.0, 100.0})).y(), 0.0);
  EXPECT_LT((*slice.world({150.0, 200.0}) - *slice.world({150.0, 100.0})).z(), 0.0);
}

TEST(SliceView, GoesThroughTheCursorAndShowsTheVesselThere) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::axial);
  slice.set_size(600, 600, 1.0);
  tube.bench.cursor_mm.set(15.0);
  const auto at = slice.project(tube.bench.place.get());
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->out_mm, 0.0, 1e-9);
  EXPECT_NEAR(*slice.value_at(at->px), testing::tube_hu, 2.0);
  ASSERT_EQ(slice.contour_lines().size(), 1U);
  for (const Vec2& p : slice.contour_lines().front().picture_px)
    EXPECT_NEAR((p - at->px).norm() * slice.pixel_mm(), testing::tube_radius_mm, 0.05);
}

TEST(SliceView, ScrollsSliceBySlice) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::axial);
  slice.set_size(100, 100, 1.0);
  const double before = tube.bench.place.get().z();
  slice.scroll(3.0);
  EXPECT_NEAR(std::abs(tube.bench.place.get().z() - before), 1.2, 1e-9);
}

TEST(SliceView, AnObliqueSliceTurnsAndStaysOrthonormal) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::oblique);
  slice.set_size(200, 200, 1.0);
  const Vec3 before = slice.plane()->normal();
  for (int i = 0; i < 50; ++i) slice.tilt(1.7, -2.3);
  const reformat::Plane& plane = *slice.plane();
  EXPECT_NO_THROW(reformat::validate(plane));
  EXPECT_LT(plane.normal().dot(before), 0.99);
  const auto at = slice.project(tube.bench.place.get());
  EXPECT_NEAR(at->out_mm, 0.0, 1e-9);
}

TEST(PlaneView, ZoomKeepsThePlaceUnderTheMouse) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::coronal);
  slice.set_size(320, 200, 2.0);
  const Vec2 at(77.0, 150.0);
  const Vec3 before = *slice.world(at);
  const double pixel = slice.pixel_mm();
  slice.zoom(3.0, at);
  EXPECT_NEAR(slice.pixel_mm(), pixel / 3.0, 1e-9);
  EXPECT_NEAR((*slice.world(at) - before).norm(), 0.0, 1e-9);
  slice.pan({10.0, 5.0});
  EXPECT_NEAR((*slice.world(at + Vec2(10.0, 5.0)) - before).norm(), 0.0, 1e-9);
}

TEST(PlaneView, WithoutAnImageSlicesAreNotReady) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::axial);
  SectionView section(tube.bench, 0.0);
  slice.set_size(100, 100, 1.0);
  section.set_size(100, 100, 1.0);
  tube.bench.close_image();
  EXPECT_FALSE(slice.ready());
  EXPECT_TRUE(section.ready());
  EXPECT_EQ(section.image().width, 0);
  EXPECT_EQ(section.contour_lines().size(), 1U);  // the wall can still be looked at and edited
}

}  // namespace
}  // namespace ostia::view
