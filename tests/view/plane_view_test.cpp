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

TEST(SliceView, MarksTheFirstEndOfAVesselThatIsBeingPlacedNearItsPlaneAlone) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::axial);
  slice.set_size(300, 240, 1.0);
  tube.bench.cursor_mm.set(15.0);
  const auto marks = [&] {
    std::vector<Vec2> found;
    for (const OverlayMark& mark : slice.overlay().marks)
      if (mark.role == Role::selected) found.push_back(mark.px);
    return found;
  };
  EXPECT_TRUE(marks().empty());
  const Vec3 end = *slice.world({100.0, 80.0});
  tube.bench.first_end.set(end);
  ASSERT_EQ(marks().size(), 1U);
  EXPECT_LT((marks().front() - Vec2(100.0, 80.0)).norm(), 1e-6);
  tube.bench.first_end.set(Vec3(end + Vec3(0.0, 0.0, 20.0)));
  EXPECT_TRUE(marks().empty());
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

/// A sagittal slice (its normal is the patient's x axis) at x, through the middle of the tube's length.
void show_at(TubeCase& tube, SliceView& slice, double x_mm) {
  slice.set_size(600, 900, 1.0);
  tube.bench.place.set({x_mm, 0.0, 0.5 * testing::tube_length_mm});
}

TEST(SliceView, CutsATubeBesideItsAxisInTwoParallelLines) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::sagittal);
  const double off = 0.5 * testing::tube_radius_mm;
  const double apart = 2.0 * std::sqrt(testing::tube_radius_mm * testing::tube_radius_mm - off * off);
  for (const double x : {off, -off}) {
    show_at(tube, slice, x);
    ASSERT_EQ(slice.contour_lines().size(), 1U);
    EXPECT_TRUE(slice.contour_lines().front().closed());
    int left = 0, right = 0;
    for (const Vec3& p : slice.contour_lines().front().world) {
      EXPECT_NEAR(p.x(), x, 1e-9);
      if (p.z() < 3.0 || p.z() > testing::tube_length_mm - 3.0) continue;  // its ends are round
      EXPECT_NEAR(2.0 * std::abs(p.y()), apart, 0.04);
      ++(p.y() < 0.0 ? left : right);
    }
    EXPECT_GT(left, 20);
    EXPECT_GT(right, 20);
  }
}

TEST(SliceView, BesideTheAxisALumenGoesOnBeyondANarrowing) {
  TubeCase tube;
  tube.bench.edit(testing::outline_of(tube.bench, 15.0, 0.25 * testing::tube_radius_mm));
  SliceView slice(tube.bench, SliceKind::sagittal);
  show_at(tube, slice, 0.5 * testing::tube_radius_mm);
  ASSERT_EQ(slice.contour_lines().size(), 2U);
  const double a = slice.contour_lines()[0].world.front().z(), b = slice.contour_lines()[1].world.front().z();
  EXPECT_LT((a - 15.0) * (b - 15.0), 0.0);
}

TEST(SliceView, ShowsNothingBesideTheLumen) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::sagittal);
  for (const double share : {1.1, -1.1, 3.0}) {
    show_at(tube, slice, share * testing::tube_radius_mm);
    EXPECT_TRUE(slice.contour_lines().empty()) << share;
  }
}

TEST(SliceView, OfATubeBesideItsAxisThePartInAnEnlargedPictureIsShown) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::sagittal);
  show_at(tube, slice, 0.5 * testing::tube_radius_mm);
  for (const double z : {6.3, 15.0, 24.7}) {
    slice.fit();
    const Vec2 there = slice.project({0.0, 0.0, z})->px;
    slice.zoom(6.0, there);
    slice.pan(Vec2(300.0, 450.0) - there);
    EXPECT_EQ(slice.contour_lines().size(), 2U) << z;  // one on either side, from border to border
  }
}

TEST(SliceView, ShowsAVesselThatDipsIntoItWithoutCrossingIt) {
  // An arc in a plane across the slice x = 0, whose axis comes no nearer to it than `off`.
  const double bend = 20.0, radius = testing::tube_radius_mm, off = 0.5 * radius, middle = 15.0;
  geometry::Centerline axis;
  for (int i = -50; i <= 50; ++i) {
    const double angle = 0.5 * i / 50.0;
    axis.points.emplace_back(off + bend * (1.0 - std::cos(angle)), 0.0, middle + bend * std::sin(angle));
    axis.radius.push_back(radius);
  }
  TubeCase tube(lumen::testing::tree_of(axis));
  SliceView slice(tube.bench, SliceKind::sagittal);
  show_at(tube, slice, 0.0);
  ASSERT_EQ(slice.contour_lines().size(), 1U);
  double highest = 0.0;
  for (const Vec3& p : slice.contour_lines().front().world) {
    const double from_centre = std::hypot(p.x() - off - bend, p.z() - middle);
    EXPECT_NEAR(std::hypot(from_centre - bend, p.y()), radius, 0.03);
    highest = std::max(highest, p.z() - middle);
  }
  // Where the arc's outer wall leaves the slice.
  EXPECT_NEAR(highest, std::sqrt((bend + radius) * (bend + radius) - (bend + off) * (bend + off)), 0.1);
}

TEST(SliceView, ShowsALumenThatReachesFartherThanItsRadius) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::sagittal);
  lumen::WallDrag pull;
  pull.vessel = tube.bench.vessel.get();
  pull.from = Vec3(testing::tube_radius_mm, 0.0, 15.0);
  pull.to = Vec3(testing::tube_radius_mm + 1.0, 0.0, 15.0);
  pull.reach_mm = 4.0;
  tube.bench.edit(pull);
  show_at(tube, slice, testing::tube_radius_mm + 0.4);
  ASSERT_EQ(slice.contour_lines().size(), 1U);
  const auto wall = tube.bench.session().live().surface(tube.bench.vessel.get());
  for (const Vec3& p : slice.contour_lines().front().world) {
    EXPECT_NEAR(wall->value(p), 0.0, 1e-4);
    EXPECT_NEAR(p.z(), 15.0, 4.0);
  }
}

/// A slice of a thick slab that is worth a draft.
struct ThickSlice {
  TubeCase tube;
  SliceView slice{tube.bench, SliceKind::axial};
  ThickSlice() {
    slice.set_size(500, 400, 1.0);
    tube.bench.slab.set(reformat::Slab::maximum);
    tube.bench.slab_mm.set(20.0);
  }
  /// Its image, -9999 where there is none.
  std::vector<float> values() {
    std::vector<float> out = slice.image().values;
    for (float& value : out)
      if (std::isnan(value)) value = -9999.0F;
    return out;
  }
};

TEST(SliceView, AThickSlabIsCoarseWhileItMovesAndWholeAtRest) {
  ThickSlice thick;
  thick.slice.allow_drafts();
  const std::vector<float> coarse = thick.values();
  EXPECT_TRUE(thick.slice.is_draft());
  thick.slice.refine();
  const std::vector<float> whole = thick.values();
  EXPECT_FALSE(thick.slice.is_draft());
  EXPECT_EQ(coarse.size(), whole.size());
  EXPECT_NE(coarse, whole);
  thick.slice.scroll(1.0);
  thick.slice.image();
  EXPECT_TRUE(thick.slice.is_draft());
}

TEST(SliceView, DraftsAreForThoseWhoAskForThem) {
  ThickSlice thick, other;
  const std::vector<float> whole = thick.values();
  EXPECT_FALSE(thick.slice.is_draft());
  const std::uint64_t revision = thick.slice.image_revision();
  thick.slice.refine();  // nothing to refine
  thick.slice.image();
  EXPECT_EQ(thick.slice.image_revision(), revision);
  other.slice.allow_drafts();
  other.slice.image();
  other.slice.refine();
  EXPECT_EQ(other.values(), whole);
}

TEST(SliceView, WhatIsQuickIsNeverADraft) {
  ThickSlice thick;
  thick.slice.allow_drafts();
  thick.tube.bench.slab_mm.set(1.0);
  thick.slice.image();
  EXPECT_FALSE(thick.slice.is_draft());
  thick.tube.bench.slab.set(reformat::Slab::none);
  thick.slice.image();
  EXPECT_FALSE(thick.slice.is_draft());
}

}  // namespace
}  // namespace ostia::view
