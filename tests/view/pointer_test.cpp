#include "ostia/view/pointer.h"

#include "bench_case.h"

#include "ostia/core/error.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::view {
namespace {

using session::Tool;
using testing::TubeCase;

struct Hand : ::testing::Test {
  TubeCase tube;
  CurvedView cpr{tube.bench, CurvedView::Which::first, std::make_shared<CurvedFrame>()};
  SectionView section{tube.bench, 0.0};
  SliceView slice{tube.bench, SliceKind::axial};
  Pointer on_cpr{cpr}, on_section{section}, on_slice{slice};
  Hand() {
    cpr.set_size(300, 600, 1.0);
    section.set_size(400, 400, 1.0);
    slice.set_size(400, 400, 1.0);
    tube.bench.cursor_mm.set(15.0);
  }
  static PointerEvent at(const Vec2& px, Button button = Button::left) { return {px, button}; }
  static void drag(Pointer& hand, const std::vector<Vec2>& way, Button button = Button::left,
                   bool shift = false) {
    PointerEvent event{way.front(), button};
    event.shift = shift;
    hand.press(event);
    for (const Vec2& px : way) {
      event.px = px;
      hand.move(event);
    }
    hand.release(event);
  }
  /// Where the wall is on the CPR at an abscissa, to the right of the axis.
  Vec2 wall_at(double s_mm) {
    return *[&] {
      const auto shown = cpr.project(
          tube.bench.axis()->place(s_mm, cpr.theta_deg() * M_PI / 180.0, testing::tube_radius_mm));
      return shown ? std::optional(shown->px) : std::nullopt;
    }();
  }
  /// Where the CPR marks an abscissa: at the end of a measurement along the vessel.
  Vec2 end_at(double s_mm) { return {cpr.width() - 12.0, cpr.row_of(s_mm)}; }
  std::vector<analysis::Measurement> made() const {
    return tube.bench.session().file().annotations()->measurements;
  }
  double first_value(std::size_t which = 0) const {
    return tube.bench.measured(made().at(which)).front().value;
  }
  /// A stretch that is made on the CPR with a tool, which is then put away.
  void make_stretch(Tool tool, double from_mm, double to_mm) {
    tube.bench.tool.set(tool);
    drag(on_cpr, {{150.0, cpr.row_of(from_mm)}, {150.0, cpr.row_of(to_mm)}});
    tube.bench.tool.set(Tool::browse);
  }
  bool cpr_says(const std::string& text) {
    for (const OverlayText& one : cpr.overlay().texts)
      if (one.text.find(text) != std::string::npos) return true;
    return false;
  }
  std::vector<session::JournalEntry> steps() const { return tube.bench.session().file().journal(); }
  std::size_t edits() const { return tube.bench.session().file().edits().size(); }
};

TEST_F(Hand, ClickOnTheCprTakesTheCursorAlong) {
  drag(on_cpr, {{150.0, cpr.row_of(9.0)}});
  EXPECT_NEAR(tube.bench.cursor_mm.get(), 9.0, 1e-6);
  EXPECT_NEAR((tube.bench.place.get() - tube.bench.axis()->point(9.0)).norm(), 0.0, 1e-6);
}

TEST_F(Hand, ClickOnASliceMovesTheCrosshairAndTheCursorWhereItIsOnTheVessel) {
  const Vec2 on_axis = slice.project(tube.bench.axis()->point(15.0))->px;
  drag(on_slice, {on_axis});
  EXPECT_NEAR(tube.bench.cursor_mm.get(), 15.0, 0.05);
  drag(on_slice, {on_axis + Vec2(120.0, 0.0)});
  EXPECT_NEAR(tube.bench.cursor_mm.get(), 15.0, 0.05);
  EXPECT_NEAR((tube.bench.place.get() - *slice.world(on_axis + Vec2(120.0, 0.0))).norm(), 0.0, 1e-6);
}

TEST_F(Hand, ShiftTurnsBothCprs) {
  drag(on_cpr, {{100.0, 100.0}, {160.0, 100.0}}, Button::left, true);
  EXPECT_NEAR(tube.bench.theta_deg.get(), 30.0, 1e-9);
}

TEST_F(Hand, TheRightButtonIsWindowAndLevel) {
  const session::GreyWindow before = tube.bench.grey.get();
  drag(on_slice, {{100.0, 100.0}, {150.0, 80.0}}, Button::right);
  EXPECT_GT(tube.bench.grey.get().width_hu, before.width_hu);
  EXPECT_LT(tube.bench.grey.get().level_hu, before.level_hu);
}

TEST_F(Hand, PullingTheContourMovesTheWallThereAsOneStep) {
  tube.bench.tool.set(Tool::drag);
  const Vec2 wall = wall_at(15.0);
  const double pixels = 0.7 / cpr.pixel_mm();
  drag(on_cpr, {wall, wall + Vec2(0.3 * pixels, 0), wall + Vec2(0.6 * pixels, 0), wall + Vec2(pixels, 0)});
  EXPECT_EQ(edits(), 1U);
  const Vec3 target = *cpr.world(wall + Vec2(pixels, 0));
  EXPECT_NEAR(tube.bench.session().live().surface(tube.bench.vessel.get())->value(target), 0.0, 0.02);
  ASSERT_TRUE(tube.bench.undo());
  EXPECT_EQ(edits(), 0U);
}

TEST_F(Hand, TwoPullsAtOnePlaceAreTwoSteps) {
  tube.bench.tool.set(Tool::drag);
  for (int i = 0; i < 2; ++i) {
    const Vec2 wall = wall_at(10.0 + 8.0 * i);
    drag(on_cpr, {wall, wall + Vec2(4.0, 0.0), wall + Vec2(8.0, 0.0)});
  }
  EXPECT_EQ(edits(), 2U);
}

TEST_F(Hand, AwayFromTheContourThePullBrowses) {
  tube.bench.tool.set(Tool::drag);
  drag(on_cpr, {{20.0, cpr.row_of(6.0)}});
  EXPECT_EQ(edits(), 0U);
  EXPECT_NEAR(tube.bench.cursor_mm.get(), 6.0, 1e-6);
}

TEST_F(Hand, ATremblingClickIsNoPull) {
  tube.bench.tool.set(Tool::drag);
  const Vec2 wall = wall_at(15.0);
  drag(on_cpr, {wall, wall + Vec2(0.5, 0.5)});
  EXPECT_EQ(edits(), 0U);
}

TEST_F(Hand, DrawingOnTheCprIsAStrokeWithItsAngle) {
  tube.bench.tool.set(Tool::draw);
  std::vector<Vec2> way;
  for (double s = 10.0; s <= 20.0; s += 0.5) way.push_back(wall_at(s) + Vec2(0.4 / cpr.pixel_mm(), 0.0));
  drag(on_cpr, way);
  ASSERT_EQ(edits(), 1U);
  const auto stroke = std::get<lumen::CprStroke>(tube.bench.session().file().edits().front());
  EXPECT_EQ(stroke.vessel, tube.bench.vessel.get());
  EXPECT_DOUBLE_EQ(stroke.theta_deg, cpr.theta_deg());
  EXPECT_NEAR(tube.bench.section(stroke.vessel, 15.0)->largest_diameter_mm,
              2.0 * testing::tube_radius_mm + 0.4, 0.1);
  EXPECT_TRUE(cpr.animating());  // dismissed samples fade
}

TEST_F(Hand, DrawingAroundTheSectionIsAClosedContour) {
  tube.bench.tool.set(Tool::draw);
  std::vector<Vec2> way;
  for (int i = 0; i <= 60; ++i) {
    const double a = 2.0 * M_PI * i / 60.0;
    way.push_back(Vec2(200.0, 200.0) + 1.0 / section.pixel_mm() * Vec2(std::cos(a), std::sin(a)));
  }
  drag(on_section, way);
  ASSERT_EQ(edits(), 1U);
  const auto contour = std::get<lumen::SectionContour>(tube.bench.session().file().edits().front());
  EXPECT_TRUE(contour.closed);
  EXPECT_DOUBLE_EQ(contour.s_mm, 15.0);
  EXPECT_NEAR(tube.bench.section(contour.vessel, 15.0)->diameter_mm, 2.0, 0.06);
}

TEST_F(Hand, AnArcOnTheSectionIsAPartialContour) {
  tube.bench.tool.set(Tool::draw);
  std::vector<Vec2> way;
  for (int i = 0; i <= 20; ++i) {
    const double a = M_PI * i / 40.0;
    way.push_back(Vec2(200.0, 200.0) + 1.8 / section.pixel_mm() * Vec2(std::cos(a), std::sin(a)));
  }
  drag(on_section, way);
  ASSERT_EQ(edits(), 1U);
  EXPECT_FALSE(std::get<lumen::SectionContour>(tube.bench.session().file().edits().front()).closed);
}

TEST_F(Hand, TheBrushPushesTheWallAsOneStep) {
  tube.bench.tool.set(Tool::brush);
  tube.bench.brush_mm.set(1.0);
  std::vector<Vec2> way;
  for (double r = 0.0; r <= 1.2; r += 0.1)
    way.push_back(Vec2(200.0, 200.0) + Vec2(r / section.pixel_mm(), 0.0));
  drag(on_section, way);
  EXPECT_EQ(edits(), 1U);
  EXPECT_GT(tube.bench.section(tube.bench.vessel.get(), 15.0)->largest_diameter_mm,
            2.0 * testing::tube_radius_mm + 0.4);
}

TEST_F(Hand, TheCenterlineIsPulledOnTheSectionAtOnceAndOnTheCprAtTheEnd) {
  tube.bench.tool.set(Tool::axis);
  drag(on_section, {{200.0, 200.0}, {205.0, 200.0}, {215.0, 200.0}});
  EXPECT_EQ(edits(), 1U);
  on_cpr.press(at(cpr.axis_at(8.0)));
  on_cpr.move(at(cpr.axis_at(8.0) + Vec2(5.0, 0.0)));
  EXPECT_EQ(edits(), 1U);
  on_cpr.release(at(cpr.axis_at(8.0) + Vec2(5.0, 0.0)));
  EXPECT_EQ(edits(), 2U);
}

TEST_F(Hand, WhatTheCoreRefusesThrowsAndLeavesTheCase) {
  tube.bench.tool.set(Tool::draw);
  const std::string before = lumen::digest(*tube.bench.model());
  std::vector<Vec2> across;  // a stroke that crosses the axis
  for (int i = 0; i <= 10; ++i) across.push_back({100.0 + 10.0 * i, cpr.row_of(15.0) + i});
  EXPECT_THROW(drag(on_cpr, across), InvalidInput);
  EXPECT_EQ(lumen::digest(*tube.bench.model()), before);
  EXPECT_FALSE(on_cpr.busy());
}

TEST_F(Hand, EscapeDropsAStroke) {
  tube.bench.tool.set(Tool::draw);
  on_cpr.press(at(wall_at(10.0)));
  on_cpr.move(at(wall_at(12.0)));
  on_cpr.cancel();
  on_cpr.release(at(wall_at(14.0)));
  EXPECT_EQ(edits(), 0U);
}

TEST_F(Hand, DistanceAngleAndAreaAreMeasuredAndMoved) {
  tube.bench.tool.set(Tool::distance);
  drag(on_slice, {{100.0, 100.0}, {180.0, 160.0}});
  tube.bench.tool.set(Tool::angle);
  for (const Vec2& px : {Vec2(50.0, 300.0), Vec2(50.0, 350.0), Vec2(100.0, 350.0)}) {
    on_slice.press(at(px));
    on_slice.release(at(px));
  }
  auto found = tube.bench.session().file().annotations();
  ASSERT_EQ(found->measurements.size(), 2U);
  EXPECT_NEAR(tube.bench.measured(found->measurements[0]).front().value, 100.0 * slice.pixel_mm(), 1e-6);
  EXPECT_NEAR(tube.bench.measured(found->measurements[1]).front().value, 90.0, 1e-6);
  tube.bench.tool.set(Tool::browse);
  drag(on_slice, {{180.0, 160.0}, {190.0, 180.0}, {220.0, 260.0}});
  found = tube.bench.session().file().annotations();
  EXPECT_NEAR(tube.bench.measured(found->measurements[0]).front().value, 200.0 * slice.pixel_mm(), 1e-6);
  ASSERT_TRUE(tube.bench.undo());  // the move alone
  found = tube.bench.session().file().annotations();
  EXPECT_NEAR(tube.bench.measured(found->measurements[0]).front().value, 100.0 * slice.pixel_mm(), 1e-6);
}

constexpr double area_of_tube = M_PI * testing::tube_radius_mm * testing::tube_radius_mm;

TEST_F(Hand, AStretchOnTheCprIsAVolume) {
  tube.bench.tool.set(Tool::volume);
  drag(on_cpr, {{150.0, cpr.row_of(20.0)}, {150.0, cpr.row_of(15.0)}, {150.0, cpr.row_of(10.0)}});
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(first_value() / area_of_tube, 10.0, 0.015 * 10.0);
  EXPECT_TRUE(cpr_says("mm\u00b3"));  // and the CPR shows where it is
  // Either end is moved, with any tool, the distal one first.
  drag(on_cpr, {end_at(20.0), end_at(22.0), end_at(24.0)});
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(made()[0].to_mm, 24.0, 1e-9);
  EXPECT_NEAR(made()[0].from_mm, 10.0, 1e-9);
  EXPECT_NEAR(first_value() / area_of_tube, 14.0, 0.015 * 14.0);
  tube.bench.tool.set(Tool::draw);
  drag(on_cpr, {end_at(10.0), end_at(7.0), end_at(4.0)});
  EXPECT_NEAR(made()[0].from_mm, 4.0, 1e-9);
  EXPECT_NEAR(first_value() / area_of_tube, 20.0, 0.015 * 20.0);
  EXPECT_EQ(edits(), 0U);
  // Each move is a step of its own.
  ASSERT_TRUE(tube.bench.undo());
  EXPECT_NEAR(made()[0].from_mm, 10.0, 1e-9);
  EXPECT_NEAR(made()[0].to_mm, 24.0, 1e-9);
  ASSERT_TRUE(tube.bench.undo());
  EXPECT_NEAR(made()[0].to_mm, 20.0, 1e-9);
  EXPECT_FALSE(on_cpr.erase(at({150.0, cpr.row_of(20.0)}, Button::none)));
  EXPECT_TRUE(on_cpr.erase(at(end_at(20.0), Button::none)));
  EXPECT_TRUE(made().empty());
}

TEST_F(Hand, AnEndOfAStretchShowsThatItCanBeTakenAndFollowsTheHandAtOnce) {
  make_stretch(Tool::volume, 10.0, 20.0);
  for (const double s : {10.0, 20.0}) {
    on_cpr.move(at(end_at(s), Button::none));
    EXPECT_EQ(on_cpr.shape(), CursorShape::grab) << s;
  }
  for (const Vec2& px : {end_at(15.0), Vec2(150.0, cpr.row_of(20.0))}) {
    on_cpr.move(at(px, Button::none));
    EXPECT_EQ(on_cpr.shape(), CursorShape::arrow);
  }
  on_cpr.press(at(end_at(20.0)));
  EXPECT_EQ(on_cpr.shape(), CursorShape::grab);
  on_cpr.move(at(end_at(25.0)));
  EXPECT_NEAR(first_value() / area_of_tube, 15.0, 0.015 * 15.0);
  EXPECT_TRUE(cpr_says(analysis::to_text(tube.bench.measured(made()[0]).front())));
  EXPECT_FALSE(cpr.overlay().bands.empty());  // the stretch across the view
  on_cpr.release(at(end_at(25.0)));
  EXPECT_TRUE(cpr.overlay().bands.empty());
  tube.bench.marks_shown.set(false);
  on_cpr.move(at(end_at(25.0), Button::none));
  EXPECT_EQ(on_cpr.shape(), CursorShape::arrow);
}

TEST_F(Hand, EndsOfAStretchStayOnTheVesselAndInOrder) {
  make_stretch(Tool::volume, 10.0, 20.0);
  drag(on_cpr, {end_at(20.0), end_at(28.0), end_at(20.0) + Vec2(0.0, 5000.0)});
  EXPECT_DOUBLE_EQ(made()[0].to_mm, tube.bench.axis()->length());
  drag(on_cpr, {end_at(10.0), end_at(3.0), Vec2(290.0, -4000.0)});
  EXPECT_DOUBLE_EQ(made()[0].from_mm, 0.0);
  drag(on_cpr, {end_at(0.0), end_at(10.0), end_at(0.0) + Vec2(0.0, 5000.0)});
  EXPECT_LT(made()[0].from_mm, made()[0].to_mm);
  EXPECT_NEAR(made()[0].from_mm, made()[0].to_mm, 1.0);
  EXPECT_DOUBLE_EQ(made()[0].to_mm, tube.bench.axis()->length());
  drag(on_cpr, {end_at(30.0), end_at(3.0)});
  EXPECT_GT(made()[0].to_mm, made()[0].from_mm);
}

TEST_F(Hand, AClickOnAnEndChoosesItAndADragBesideItMovesItAsFar) {
  make_stretch(Tool::volume, 10.0, 20.0);
  tube.bench.selected_measurement.set(0);
  const std::size_t before = steps().size();
  const Vec2 beside = end_at(20.0) + Vec2(0.0, 5.0);
  drag(on_cpr, {beside, beside + Vec2(0.5, 0.5)});
  EXPECT_EQ(tube.bench.selected_measurement.get(), made()[0].id);
  EXPECT_EQ(steps().size(), before);
  drag(on_cpr, {beside, beside + Vec2(3.0, 40.0)});
  EXPECT_NEAR(made()[0].to_mm, 20.0 + 40.0 * cpr.pixel_mm(), 1e-9);
}

TEST_F(Hand, TheReferencesOfAStenosisAreMovedOnBothCprsInBothModes) {
  tube.bench.edit(testing::outline_of(tube.bench, 15.0, 0.5 * testing::tube_radius_mm));
  make_stretch(Tool::stenosis, 8.0, 20.0);
  EXPECT_NEAR(first_value(), 50.0, 4.0);
  drag(on_cpr, {end_at(8.0), end_at(14.0), end_at(18.0)});
  EXPECT_NEAR(made()[0].from_mm, 18.0, 1e-9);
  EXPECT_NEAR(first_value(), 0.0, 3.0);  // the narrow place is no longer between them
  CurvedView twin(tube.bench, CurvedView::Which::second, std::make_shared<CurvedFrame>());
  twin.set_size(200, 900, 2.0);
  tube.bench.curved_mode.set(reformat::CurvedMode::stretched);
  Pointer on_twin(twin);
  const auto mark = [&](double s) { return Vec2(twin.width() - 30.0, twin.row_of(s)); };
  drag(on_twin, {mark(18.0), mark(12.0), mark(9.0)});
  EXPECT_NEAR(made()[0].from_mm, 9.0, 0.02);
  EXPECT_NEAR(first_value(), 50.0, 4.0);
  EXPECT_TRUE(on_twin.erase(at(mark(20.0), Button::none)));
  EXPECT_TRUE(made().empty());
}

TEST_F(Hand, ARingOfCtNumbersHasOnePlaceWhichIsMovedWithItsOwnTool) {
  tube.bench.tool.set(Tool::ring_hu);
  drag(on_cpr, {{150.0, cpr.row_of(9.0)}});
  ASSERT_EQ(made().size(), 1U);
  on_cpr.move(at(end_at(9.0), Button::none));
  EXPECT_EQ(on_cpr.shape(), CursorShape::grab);
  drag(on_cpr, {end_at(9.0), end_at(15.0), end_at(21.0)});
  ASSERT_EQ(made().size(), 1U) << "another ring was placed";
  EXPECT_NEAR(made()[0].from_mm, 21.0, 1e-9);
  EXPECT_DOUBLE_EQ(made()[0].to_mm, made()[0].from_mm);
  EXPECT_LT(first_value(), 0.0);
  drag(on_cpr, {end_at(21.0), end_at(21.0) + Vec2(0.0, 9000.0)});
  EXPECT_DOUBLE_EQ(made()[0].from_mm, tube.bench.axis()->length());
  ASSERT_TRUE(tube.bench.undo());
  ASSERT_TRUE(tube.bench.undo());
  EXPECT_NEAR(made()[0].from_mm, 9.0, 1e-9);
  EXPECT_TRUE(on_cpr.erase(at(end_at(9.0), Button::none)));
  EXPECT_TRUE(made().empty());
}

TEST_F(Hand, OfTwoStretchesTheNearerEndIsTaken) {
  make_stretch(Tool::volume, 10.0, 20.0);
  make_stretch(Tool::volume, 12.0, 20.2);  // the second end stands 4 pixels below the first one's
  ASSERT_EQ(made().size(), 2U);
  drag(on_cpr, {end_at(20.2) + Vec2(0.0, 2.0), end_at(26.0)});
  EXPECT_NEAR(made()[0].to_mm, 20.0, 1e-9);
  EXPECT_GT(made()[1].to_mm, 25.0);
}

TEST_F(Hand, DeleteTakesAMeasurementAway) {
  tube.bench.tool.set(Tool::distance);
  drag(on_slice, {{100.0, 100.0}, {180.0, 160.0}});
  EXPECT_FALSE(on_slice.erase(at({300.0, 300.0}, Button::none)));
  EXPECT_TRUE(on_slice.erase(at({180.0, 160.0}, Button::none)));
  EXPECT_TRUE(tube.bench.session().file().annotations()->measurements.empty());
}

TEST_F(Hand, AddVesselTellsThePlace) {
  tube.bench.tool.set(Tool::add_vessel);
  std::optional<Vec3> told;
  const auto kept = on_slice.end_chosen.observe([&](const Vec3& place) { told = place; });
  drag(on_slice, {{120.0, 130.0}});
  ASSERT_TRUE(told);
  EXPECT_NEAR((*told - *slice.world({120.0, 130.0})).norm(), 0.0, 1e-9);
}

TEST_F(Hand, TheWheelZoomsWithControl) {
  PointerEvent event{{200.0, 200.0}, Button::none};
  event.control = true;
  const double before = section.pixel_mm();
  on_section.wheel(2.0, event);
  EXPECT_NEAR(section.pixel_mm(), before / 1.44, 1e-9);
  event.control = false;
  on_section.wheel(-2.0, event);
  EXPECT_DOUBLE_EQ(tube.bench.cursor_mm.get(), 16.0);
}

}  // namespace
}  // namespace ostia::view
