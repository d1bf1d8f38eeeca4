#include "ostia/view/curved_view.h"

#include "bench_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::view {
namespace {

using testing::TubeCase;

struct TwinCpr : ::testing::Test {
  TubeCase tube;
  std::shared_ptr<CurvedFrame> frame = std::make_shared<CurvedFrame>();
  CurvedView first{tube.bench, CurvedView::Which::first, frame},
      second{tube.bench, CurvedView::Which::second, frame};
  TwinCpr() {
    for (CurvedView* view : {&first, &second}) view->set_size(300, 600, 1.0);
  }
};

double width_of_lumen_mm(CurvedView& view, double s_mm) {
  const double row = view.row_of(s_mm);
  double low = 1e9, high = -1e9;
  for (const lumen::ContourLine& line : view.contour_lines())
    for (const Vec2& p : line.picture_px)
      if (std::abs(p.y() - row) < 6.0) {
        low = std::min(low, p.x());
        high = std::max(high, p.x());
      }
  return (high - low) * view.pixel_mm();
}

TEST_F(TwinCpr, ShowsTheTubeWhereItIs) {
  ASSERT_TRUE(first.ready());
  const double middle = first.axis_at(15.0).x();
  EXPECT_NEAR(middle, 150.0, 1e-6);
  EXPECT_NEAR(*first.value_at({middle, first.row_of(15.0)}), testing::tube_hu, 2.0);
  EXPECT_NEAR(*first.value_at({middle + 3.0 / first.pixel_mm(), first.row_of(15.0)}), testing::fat_hu, 2.0);
  EXPECT_NEAR(width_of_lumen_mm(first, 15.0), 2.0 * testing::tube_radius_mm, 0.03);
}

TEST_F(TwinCpr, PlacesGoThereAndBack) {
  for (const Vec2& px : {Vec2(150.0, 300.0), Vec2(120.5, 200.25), Vec2(220.0, 411.0)}) {
    const auto place = second.world(px);
    ASSERT_TRUE(place);
    const auto back = second.project(*place);
    ASSERT_TRUE(back);
    EXPECT_NEAR((back->px - px).norm(), 0.0, 1e-6);
    EXPECT_NEAR(back->out_mm, 0.0, 1e-9);
  }
}

TEST_F(TwinCpr, TheSecondIsTurnedByNinetyDegrees) {
  tube.bench.theta_deg.set(20.0);
  const Vec3 a = *first.world({200.0, 300.0}) - *first.world({150.0, 300.0});
  const Vec3 b = *second.world({200.0, 300.0}) - *second.world({150.0, 300.0});
  EXPECT_NEAR(a.dot(b), 0.0, 1e-9);
  EXPECT_NEAR(a.norm(), b.norm(), 1e-9);
  EXPECT_DOUBLE_EQ(second.theta_deg(), 110.0);
}

TEST_F(TwinCpr, ZoomKeepsThePlaceUnderTheMouseAndIsSharedAlongTheVessel) {
  const Vec2 at(180.0, 222.0);
  const Vec3 before = *first.world(at);
  const double pixel = first.pixel_mm();
  first.zoom(2.0, at);
  EXPECT_NEAR(first.pixel_mm(), 0.5 * pixel, 1e-12);
  EXPECT_NEAR((*first.world(at) - before).norm(), 0.0, first.pixel_mm());  // the shift is whole pixels
  EXPECT_DOUBLE_EQ(second.pixel_mm(), first.pixel_mm());
  EXPECT_NEAR(second.row_of(15.0), first.row_of(15.0), 1e-9);
}

TEST_F(TwinCpr, PanMovesWhatIsShown) {
  const Vec3 before = *first.world({150.0, 300.0});
  first.pan({25.0, -40.0});
  EXPECT_NEAR((*first.world({175.0, 260.0}) - before).norm(), 0.0, 1e-9);
  first.fit();
  EXPECT_NEAR(first.axis_at(15.0).x(), 150.0, 1e-6);
  EXPECT_GT(first.row_of(0.0), 0.0);
  EXPECT_LT(first.row_of(30.0), 600.0);
}

TEST_F(TwinCpr, FollowsTheCursorAlongTheVessel) {
  first.zoom(8.0, {150.0, 300.0});
  for (const double s : {0.5, 10.0, 29.5}) {
    tube.bench.cursor_mm.set(s);
    EXPECT_GE(first.row_of(s), 0.0) << s;
    EXPECT_LE(first.row_of(s), 600.0) << s;
  }
}

TEST_F(TwinCpr, ContoursFollowAnEditWithoutANewImage) {
  first.image();
  first.overlay();
  const std::uint64_t revision = first.image_revision();
  lumen::WallDrag pull;
  pull.vessel = tube.bench.vessel.get();
  pull.from = tube.bench.axis()->place(15.0, 0.0, testing::tube_radius_mm);
  pull.to = tube.bench.axis()->place(15.0, 0.0, testing::tube_radius_mm + 0.8);
  tube.bench.edit(pull);
  EXPECT_NEAR(width_of_lumen_mm(first, 15.0), 2.0 * testing::tube_radius_mm + 0.8, 0.06);
  first.image();
  EXPECT_EQ(first.image_revision(), revision);
  ASSERT_TRUE(tube.bench.undo());
  EXPECT_NEAR(width_of_lumen_mm(first, 15.0), 2.0 * testing::tube_radius_mm, 0.03);
}

TEST_F(TwinCpr, LinesAreCoarseWhileAHandTurnsAndExactWhenItLetsGo) {
  const auto points = [&] {
    std::size_t count = 0;
    for (const lumen::ContourLine& line : first.contour_lines()) count += line.picture_px.size();
    return count;
  };
  const std::size_t exact = points();
  tube.bench.turning.set(true);
  tube.bench.theta_deg.set(30.0);
  EXPECT_LT(points(), 0.7 * static_cast<double>(exact));
  EXPECT_NEAR(width_of_lumen_mm(first, 15.0), 2.0 * testing::tube_radius_mm, first.pixel_mm());
  tube.bench.turning.set(false);
  CurvedView fresh(tube.bench, CurvedView::Which::first, frame);
  fresh.set_size(300, 600, 1.0);
  ASSERT_EQ(first.contour_lines().size(), fresh.contour_lines().size());
  for (std::size_t i = 0; i < fresh.contour_lines().size(); ++i)
    EXPECT_EQ(first.contour_lines()[i].world, fresh.contour_lines()[i].world);
}

TEST_F(TwinCpr, PreparedTogetherOrAloneTheyAreTheSame) {
  tube.bench.theta_deg.set(40.0);
  prepare({&first, &second});
  for (CurvedView* view : {&first, &second}) {
    const std::uint64_t made = view->image_revision();
    CurvedView alone(tube.bench, view == &first ? CurvedView::Which::first : CurvedView::Which::second,
                     frame);
    alone.set_size(300, 600, 1.0);
    EXPECT_EQ(view->image().values, alone.image().values);
    EXPECT_EQ(view->image_revision(), made);  // nothing was left to do
    ASSERT_EQ(view->contour_lines().size(), alone.contour_lines().size());
    for (std::size_t i = 0; i < alone.contour_lines().size(); ++i)
      EXPECT_EQ(view->contour_lines()[i].world, alone.contour_lines()[i].world);
  }
}

TEST_F(TwinCpr, StretchedAndSlabsAreOtherPictures) {
  const auto revision = [&] {
    first.image();
    return first.image_revision();
  };
  const std::uint64_t one = revision();
  tube.bench.slab.set(reformat::Slab::maximum);
  const std::uint64_t two = revision();
  EXPECT_GT(two, one);
  EXPECT_NEAR(*first.value_at(first.axis_at(15.0)), testing::tube_hu, 2.0);
  tube.bench.curved_mode.set(reformat::CurvedMode::stretched);
  EXPECT_GT(revision(), two);
  const auto back = first.project(tube.bench.axis()->point(12.0));
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->px.y(), first.row_of(12.0), 1e-6);
}

/// The farthest from the axis that lines run within a few rows of a place, mm.
template <class Lines, class Points>
double reach_mm(CurvedView& view, double s_mm, const Lines& lines, const Points& points) {
  const double row = view.row_of(s_mm), middle = view.project(view.bench().axis()->point(s_mm))->px.x();
  double farthest = 0.0;
  for (const auto& line : lines)
    for (const Vec2& p : points(line))
      if (std::abs(p.y() - row) < 4.0) farthest = std::max(farthest, std::abs(p.x() - middle));
  return farthest * view.pixel_mm();
}

geometry::Centerline straight(const Vec3& from, const Vec3& direction, double length_mm, double radius_mm) {
  geometry::Centerline line;
  for (double s = 0.0; s <= length_mm; s += 0.5) {
    line.points.push_back(from + s * direction);
    line.radius.push_back(radius_mm);
  }
  geometry::complete(line);
  return line;
}

/// A trunk along z and two branches that leave it at once, 60 degrees to either side.
geometry::VesselTree sharp_fork(double trunk_mm, double trunk_radius_mm) {
  const Vec3 fork(0.0, 0.0, trunk_mm);
  const double c = 0.5, d = std::sqrt(0.75);
  geometry::VesselTree tree;
  tree.segments = {{5, 1, 2, straight(Vec3::Zero(), Vec3::UnitZ(), trunk_mm, trunk_radius_mm)},
                   {6, 2, 3, straight(fork, Vec3(d, 0.0, c), 14.0, 1.4)},
                   {7, 2, 4, straight(fork, Vec3(-d, 0.0, c), 14.0, 1.4)}};
  tree.nodes = {{1, Vec3::Zero()}, {2, fork}};
  for (std::size_t i = 1; i < 3; ++i)
    tree.nodes.push_back({static_cast<std::int32_t>(i) + 2, tree.segments[i].axis.points.back()});
  tree.vessels = {{8, "LAD", {5, 6}}, {9, "LCX", {5, 7}}};
  return tree;
}

TEST(CurvedViewAtASharpBend, DrawsNoWallAcrossThePicture) {
  // Rows fan out where the axis turns, and one of them runs along the other branch.
  const double trunk_mm = 12.0, trunk_radius_mm = 2.0;
  TubeCase fork(sharp_fork(trunk_mm, trunk_radius_mm));
  const auto frame = std::make_shared<CurvedFrame>();
  double before = 0.0;
  for (const double theta : {0.0, 30.0, 60.0, 90.0, 120.0, 150.0}) {
    fork.bench.theta_deg.set(theta);
    CurvedView view(fork.bench, CurvedView::Which::first, frame);
    view.set_size(300, 600, 1.0);
    before = std::max(before, reach_mm(view, trunk_mm, view.contour_lines(),
                                       [](const lumen::ContourLine& line) { return line.picture_px; }));
    EXPECT_LT(reach_mm(view, trunk_mm, view.overlay().lines,
                       [](const OverlayLine& line) {
                         return line.role == Role::lumen ? line.px : std::vector<Vec2>{};
                       }),
              2.0 * trunk_radius_mm)
        << theta;
  }
  EXPECT_GT(before, 3.0 * trunk_radius_mm);
}

TEST_F(TwinCpr, ShowsNothingWithoutACase) {
  tube.bench.close_case();
  EXPECT_FALSE(first.ready());
  EXPECT_EQ(first.image().width, 0);
  EXPECT_TRUE(first.overlay().lines.empty());
}

}  // namespace
}  // namespace ostia::view
