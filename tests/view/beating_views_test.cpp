// The 2D views at another phase of the heart: where a known motion takes wall and axes.
#include "bench_case.h"
#include "known_motion.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/session/beating.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"
#include "ostia/view/pointer.h"
#include "ostia/view/profile_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::view {
namespace {

using session::testing::known_motion;
using session::testing::moved;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::TubeCase;

/// Half a cycle from the template's phase: 20 % thinner, 10 % shorter, 4 mm farther along x.
constexpr double far_phase = 0.25;

std::shared_ptr<const session::Beating> beating(session::Workbench& bench) {
  geometry::TriMesh wall = bench.session().live().wall(0.35);
  geometry::Box3 box;
  for (const Vec3& p : wall.points) box.extend(p);
  const Vec3 by = Vec3::Constant(3.0);
  return session::Beating::made(known_motion(box.min() - by, box.max() + by), bench.session().file().model(),
                                std::move(wall));
}

/// A quarter of a circle of 20 mm.
geometry::VesselTree bent_vessel() {
  geometry::Centerline line;
  for (int i = 0; i <= 60; ++i) {
    const double a = 0.5 * std::numbers::pi * i / 60.0;
    line.points.emplace_back(20.0 * std::sin(a) - 8.0, 0.0, 20.0 * (1.0 - std::cos(a)));
    line.radius.push_back(1.5);
  }
  geometry::complete(line);
  return lumen::testing::tree_of(line);
}

std::string all_texts(PictureView& view) {
  std::string all;
  for (const OverlayText& text : view.overlay().texts) all += text.text + "\n";
  return all;
}

TEST(BeatingViews, ASectionGoesWithTheVesselAndItsLumen) {
  TubeCase tube;
  SectionView section(tube.bench, 0.0);
  section.set_size(400, 400, 1.0);
  tube.bench.cursor_mm.set(12.0);
  section.prepare();
  tube.bench.show_phase(beating(tube.bench)->at(far_phase));
  const auto lines = section.contour_lines();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines.front().closed());
  for (const Vec2& p : lines.front().picture_px)
    EXPECT_NEAR((p - Vec2(200.0, 200.0)).norm() * section.pixel_mm(), 0.8 * testing::tube_radius_mm, 0.03);
  EXPECT_NEAR(section.plane()->origin.z(), 0.9 * 12.0, 2e-3);
  EXPECT_THAT(all_texts(section), HasSubstr("12.0 mm"));  // the place of the vessel, as its profile has it
  tube.bench.show_phase(nullptr);
  ASSERT_EQ(section.contour_lines().size(), 1U);
  for (const Vec2& p : section.contour_lines().front().picture_px)
    EXPECT_NEAR((p - Vec2(200.0, 200.0)).norm() * section.pixel_mm(), testing::tube_radius_mm, 0.02);
}

TEST(BeatingViews, ASliceStaysAndTheVesselGoesThroughIt) {
  TubeCase tube;
  SliceView slice(tube.bench, SliceKind::axial);
  slice.set_size(300, 300, 1.0);
  tube.bench.cursor_mm.set(12.0);
  tube.bench.show_phase(beating(tube.bench)->at(far_phase));
  ASSERT_EQ(slice.contour_lines().size(), 1U);
  for (const Vec3& p : slice.contour_lines().front().world)
    EXPECT_NEAR(std::hypot(p.x() - 4.0, p.y()), 1.2, 0.03);
  const Vec2 centre = slice.project(Vec3(4.0, 0.0, 10.8))->px;
  bool axis = false;
  for (const OverlayMark& mark : slice.overlay().marks)
    axis = axis || (mark.role == Role::axis && (mark.px - centre).norm() < 0.1);
  EXPECT_TRUE(axis) << "the axis goes through the slice where the vessel does";
}

TEST(BeatingViews, CprsShowTheLumenAsItIsThere) {
  for (const auto mode : {reformat::CurvedMode::straightened, reformat::CurvedMode::stretched}) {
    TubeCase tube(bent_vessel());
    tube.bench.curved_mode.set(mode);
    const auto shown = beating(tube.bench)->at(far_phase);
    CurvedView view(tube.bench, CurvedView::Which::first, std::make_shared<CurvedFrame>());
    view.set_size(300, 700, 1.0);
    view.fit();
    for (const double theta : {0.0, 35.0, 90.0}) {
      tube.bench.theta_deg.set(theta);
      tube.bench.show_phase(shown);
      double length = 0.0;
      for (const lumen::ContourLine& line : view.contour_lines())
        for (std::size_t i = 0; i < line.picture_px.size(); ++i) {
          const auto there = view.world(line.picture_px[i]);
          ASSERT_TRUE(there);
          // Straight over a triangle of 0.35 mm, and on the wall.
          EXPECT_LT((*there - line.world[i]).norm(), 0.05) << theta;
          if (i > 0) length += (line.world[i] - line.world[i - 1]).norm();
        }
      // Both sides of a vessel that is 31.4 mm long at first.
      EXPECT_GT(length, 2 * 0.78 * 31.4) << theta;
    }
  }
}

TEST(BeatingViews, CprsShowBranchesWhereTheyLeave) {
  TubeCase tube(lumen::testing::tree_of(geometry::y_junction(15.0, 15.0, 2.0, 1.4, 70.0)));
  session::Workbench& bench = tube.bench;
  const auto shown = beating(bench)->at(far_phase);
  const geometry::AabbTree wall(*shown->wall());
  CurvedView view(bench, CurvedView::Which::first, std::make_shared<CurvedFrame>());
  view.set_size(400, 700, 1.0);
  for (const auto& vessel : bench.model()->vessels) {
    bench.vessel.set(vessel->vessel);
    view.fit();
    for (const double theta : {0.0, 90.0}) {
      bench.theta_deg.set(theta);
      bench.show_phase(shown);
      std::size_t seen = 0;
      for (const lumen::ContourLine& line : view.contour_lines())
        for (std::size_t i = 0; i < line.picture_px.size(); ++i) {
          EXPECT_LT(wall.closest(line.world[i]).distance, 1e-6);
          if (bench.axis()->nearest_foot(line.world[i]).rho_mm > 4.0) continue;
          ++seen;
          EXPECT_LT((*view.world(line.picture_px[i]) - line.world[i]).norm(), 0.08) << theta;
        }
      EXPECT_GT(seen, 150U) << theta;
      bench.show_phase(nullptr);
    }
  }
}

TEST(BeatingViews, SayOfWhichPhaseImageAndTreeAre) {
  TubeCase tube;
  SectionView section(tube.bench, 0.0);
  section.set_size(400, 400, 1.0);
  const auto beats = beating(tube.bench);
  EXPECT_THAT(all_texts(section), ::testing::Not(HasSubstr("tree")));
  tube.bench.show_phase(beats->at(far_phase));
  EXPECT_THAT(all_texts(section), HasSubstr("image 75 %, tree 25 %"));
  auto image = std::make_shared<imaging::ImageVolume>(*tube.bench.image().volume);
  for (std::int16_t& hu : image->voxels) hu = 123;
  tube.bench.show_phase(beats->at(far_phase),
                        std::make_shared<const session::PhaseImage>(session::PhaseImage{image, 0.25}));
  EXPECT_THAT(all_texts(section), AllOf(HasSubstr("25 %"), ::testing::Not(HasSubstr("tree"))));
  EXPECT_DOUBLE_EQ(*section.value_at(Vec2(200.5, 200.5)), 123.0) << "the phase's own image";
}

TEST(BeatingViews, NothingIsEditedOrMeasuredButTheViewsAreWalkedThrough) {
  TubeCase tube;
  session::Workbench& bench = tube.bench;
  CurvedView view(bench, CurvedView::Which::first, std::make_shared<CurvedFrame>());
  view.set_size(300, 700, 1.0);
  view.fit();
  Pointer hand(view);
  const std::string before = lumen::digest(*bench.model());
  bench.show_phase(beating(bench)->at(far_phase));
  PointerEvent event;
  event.button = Button::left;
  for (const session::Tool tool : {session::Tool::drag, session::Tool::draw, session::Tool::brush,
                                   session::Tool::axis, session::Tool::distance, session::Tool::ring_hu}) {
    bench.tool.set(tool);
    event.px = view.contour_lines().front().picture_px[4];
    EXPECT_THROW(hand.press(event), InvalidInput);
    hand.cancel();
  }
  EXPECT_EQ(lumen::digest(*bench.model()), before);
  bench.tool.set(session::Tool::browse);
  event.px = view.axis_at(9.0);  // of 27 mm: a third of the way
  hand.press(event);
  hand.release(event);
  EXPECT_NEAR(bench.own_mm(bench.cursor_mm.get()), 10.0, 0.05);
}

TEST(BeatingViews, TheProfileStaysThatOfTheCase) {
  TubeCase tube;
  ProfileView profile(tube.bench);
  profile.set_size(600, 200, 1.0);
  tube.bench.cursor_mm.set(15.0);
  const auto cursor_x = [&] {
    for (const OverlayLine& line : profile.overlay().lines)
      if (line.role == Role::cursor) return line.px.front().x();
    return -1.0;
  };
  const double own = cursor_x();
  tube.bench.show_phase(beating(tube.bench)->at(far_phase));
  EXPECT_NEAR(cursor_x(), own, 0.01) << "the same place of the vessel";
}

}  // namespace
}  // namespace ostia::view
