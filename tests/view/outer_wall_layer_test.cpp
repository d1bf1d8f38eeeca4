#include "ostia/view/outer_wall_layer.h"

#include "bench_case.h"

#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::view {
namespace {

using std::numbers::pi;

/// Grows along the vessel, so that between rows it is between them.
double outer(double s) {
  return 2.0 + 0.02 * s;
}

/// Walls from 5 to 25 mm, as if they had been found.
session::VesselWalls walls_of(const session::OuterWallWork& work) {
  session::VesselWalls walls;
  walls.vessel = work.vessel;
  walls.axis = lumen::vessel(*work.model, work.vessel).axis;
  segmentation::LumenBoundary& rows = walls.outer.surface;
  rows.from_mm = 5.0;
  rows.step_mm = 1.0;
  rows.around = 32;
  for (int row = 0; row <= 20; ++row)
    for (int a = 0; a < rows.around; ++a) rows.radius_mm.push_back(outer(5.0 + row));
  return walls;
}

class OuterWallLayerTest : public ::testing::Test {
 protected:
  session::Workbench& bench() { return tube_.bench; }
  void find() {
    const auto work = board_.work();
    ASSERT_TRUE(work);
    ASSERT_TRUE(board_.take(*work, walls_of(*work)));
  }
  testing::TubeCase tube_;
  session::OuterWallBoard board_{tube_.bench};
};

TEST_F(OuterWallLayerTest, OnACprItRunsOnBothSides) {
  CurvedView view(bench(), CurvedView::Which::first, std::make_shared<CurvedFrame>());
  view.set_size(400, 700, 1.0);
  view.fit();
  OuterWallLayer layer(view, board_);
  EXPECT_TRUE(layer.lines().empty());
  find();
  ASSERT_EQ(layer.lines().size(), 2U);
  for (const auto& line : layer.lines()) {
    double first = 1e9, last = -1e9;
    for (const Vec2& px : line) {
      const double s = view.abscissa_at(px.y());
      EXPECT_NEAR(std::abs(px.x() - view.axis_at(s).x()) * view.pixel_mm(), outer(s), 0.01) << s;
      first = std::min(first, s);
      last = std::max(last, s);
    }
    EXPECT_NEAR(first, 5.0, 1e-3);
    EXPECT_NEAR(last, 25.0, 1e-3);
  }
}

TEST_F(OuterWallLayerTest, OnASectionItIsADashedRingWhileItIsShown) {
  SectionView view(bench(), 0.0);
  view.set_size(400, 400, 1.0);
  OuterWallLayer layer(view, board_);
  find();
  bench().cursor_mm.set(12.5);
  const auto drawn = [&] {
    std::vector<OverlayLine> found;
    for (const OverlayLine& line : view.overlay().lines)
      if (line.role == Role::outer_wall) found.push_back(line);
    return found;
  };
  EXPECT_TRUE(drawn().empty());
  board_.shown.set(true);
  const std::vector<OverlayLine> rings = drawn();
  ASSERT_EQ(rings.size(), 1U);
  EXPECT_TRUE(rings.front().dashed);
  for (const Vec2& px : rings.front().px)
    EXPECT_NEAR(bench().axis()->nearest_foot(*view.world(px)).rho_mm, outer(12.5), 0.01);
  bench().cursor_mm.set(27.0);  // beyond what was found
  EXPECT_TRUE(drawn().empty());
  bench().cursor_mm.set(12.5);
  board_.shown.set(false);
  EXPECT_TRUE(drawn().empty());
}

TEST_F(OuterWallLayerTest, WhatIsKnownEndsWithTheModelItWasFoundOn) {
  const auto old = board_.work();
  ASSERT_TRUE(old);
  find();
  EXPECT_TRUE(board_.of_selected());
  EXPECT_FALSE(board_.work());  // nothing is left to do
  const std::uint64_t before = board_.revision();
  bench().edit(testing::outline_of(bench(), 15.0, 1.2));
  EXPECT_FALSE(board_.of_selected());
  EXPECT_NE(board_.revision(), before);
  EXPECT_FALSE(board_.take(*old, walls_of(*old)));  // found on what is no more
  EXPECT_FALSE(board_.of_selected());
  find();
  EXPECT_TRUE(board_.of_selected());
  bench().close_case();
  EXPECT_TRUE(board_.known().empty());
  EXPECT_FALSE(board_.work());
}

TEST_F(OuterWallLayerTest, WhatWasNotFoundIsNotLookedForAgain) {
  const auto work = board_.work();
  ASSERT_TRUE(work);
  EXPECT_TRUE(board_.take(*work, std::nullopt));
  EXPECT_FALSE(board_.of_selected());
  EXPECT_FALSE(board_.work());
  bench().close_image();
  EXPECT_FALSE(board_.work());  // and nothing without an image
}

}  // namespace
}  // namespace ostia::view
