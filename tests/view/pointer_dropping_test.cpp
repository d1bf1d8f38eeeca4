// What is begun and not finished: taken back, let go unseen, or overtaken by another case, image or vessel.

#include "bench_case.h"

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"
#include "ostia/view/pointer.h"

#include <gtest/gtest.h>

#include <functional>

namespace ostia::view {
namespace {

using session::Tool;
using testing::TubeCase;

PointerEvent pointer_dropping_at(const Vec2& px, Button button = Button::none) {
  PointerEvent event;
  event.px = px;
  event.button = button;
  return event;
}

struct Begun : ::testing::Test {
  explicit Begun(const geometry::VesselTree& tree = lumen::testing::straight_vessel(testing::tube_length_mm,
                                                                                    testing::tube_radius_mm))
      : tube(tree) {
    cpr.set_size(300, 600, 1.0);
    section.set_size(400, 400, 1.0);
    slice.set_size(400, 400, 1.0);
    bench.cursor_mm.set(15.0);
  }
  TubeCase tube;
  session::Workbench& bench = tube.bench;
  CurvedView cpr{bench, CurvedView::Which::first, std::make_shared<CurvedFrame>()};
  SectionView section{bench, 0.0};
  SliceView slice{bench, SliceKind::axial};
  Pointer on_cpr{cpr}, on_section{section}, on_slice{slice};

  Vec2 wall() {
    return cpr.project(bench.axis()->place(15.0, cpr.theta_deg() * M_PI / 180.0, testing::tube_radius_mm))
        ->px;
  }
  /// The wall is pulled and the button is still down.
  void begin_pull() {
    bench.tool.set(Tool::drag);
    on_cpr.press(pointer_dropping_at(wall(), Button::left));
    for (const double by : {4.0, 8.0}) on_cpr.move(pointer_dropping_at(wall() + Vec2(by, 0.0)));
  }
  std::string digest() const { return lumen::digest(*bench.model()); }
  std::size_t edits() const { return bench.session().file().edits().size(); }
  const std::vector<analysis::Measurement>& made() const {
    return bench.session().file().annotations()->measurements;
  }
  void open_another(double radius_mm) {
    bench.set_session(session::Session(session::CaseFile::create(
        tube.folder / "another.ostia",
        lumen::model_of_tubes(lumen::testing::straight_vessel(testing::tube_length_mm, radius_mm)))));
  }
};

/// Begins on a view, and what the case was before is there again after Escape; what the hand does until it
/// lets go does nothing.
void expect_taken_back(Begun& on, Pointer& hand, const std::vector<Vec2>& way) {
  const std::string before = on.digest();
  hand.press(pointer_dropping_at(way.front(), Button::left));
  for (const Vec2& px : way) hand.move(pointer_dropping_at(px));
  const std::string pulled = on.digest();
  ASSERT_NE(pulled, before);
  ASSERT_EQ(on.edits(), 1U);
  hand.cancel();
  EXPECT_EQ(on.digest(), before);
  EXPECT_FALSE(hand.busy());
  hand.move(pointer_dropping_at(way.back() + Vec2(6.0, 0.0)));
  hand.release(pointer_dropping_at(way.back() + Vec2(6.0, 0.0), Button::left));
  EXPECT_EQ(on.digest(), before);
  EXPECT_EQ(on.edits(), 0U);
  ASSERT_TRUE(on.bench.redo());
  EXPECT_EQ(on.digest(), pulled);
  EXPECT_FALSE(on.bench.redo());
  ASSERT_TRUE(on.bench.undo());
  EXPECT_EQ(on.digest(), before);
}

TEST_F(Begun, EscapeTakesAPullBack) {
  bench.tool.set(Tool::drag);
  expect_taken_back(*this, on_cpr, {wall(), wall() + Vec2(4.0, 0.0), wall() + Vec2(8.0, 0.0)});
}

TEST_F(Begun, EscapeTakesAPushOfTheBallBack) {
  bench.tool.set(Tool::brush);
  const double mm = 1.0 / section.pixel_mm();
  expect_taken_back(*this, on_section,
                    {{200.0, 200.0}, {200.0 + 0.6 * mm, 200.0}, {200.0 + 1.2 * mm, 200.0}});
}

TEST_F(Begun, EscapeTakesAMoveOfTheCenterlineBack) {
  bench.tool.set(Tool::axis);
  expect_taken_back(*this, on_section, {{200.0, 200.0}, {205.0, 200.0}, {212.0, 200.0}});
}

TEST_F(Begun, EscapeTakesTheEndOfAMeasurementBack) {
  bench.tool.set(Tool::distance);
  on_slice.press(pointer_dropping_at({100.0, 100.0}, Button::left));
  on_slice.release(pointer_dropping_at({200.0, 100.0}, Button::left));
  ASSERT_EQ(made().size(), 1U);
  const Vec3 end = made()[0].points[1];
  on_slice.press(pointer_dropping_at({200.0, 100.0}, Button::left));
  on_slice.move(pointer_dropping_at({220.0, 130.0}));
  on_slice.move(pointer_dropping_at({240.0, 150.0}));
  ASSERT_GT((made()[0].points[1] - end).norm(), 1.0);
  on_slice.cancel();
  on_slice.move(pointer_dropping_at({260.0, 150.0}));
  on_slice.release(pointer_dropping_at({260.0, 150.0}, Button::left));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_EQ(made()[0].points[1], end);
}

TEST_F(Begun, EscapeTakesNothingBackThatTheDragHasNotDone) {
  begin_pull();
  on_cpr.release(pointer_dropping_at(wall() + Vec2(8.0, 0.0), Button::left));
  const std::string pulled = digest();
  bench.cursor_mm.set(6.0);
  on_cpr.press(pointer_dropping_at({20.0, cpr.row_of(24.0)}, Button::left));  // beside the wall: the cursor
  on_cpr.cancel();
  const auto hit = cpr.wall_near(
      cpr.project(bench.axis()->place(24.0, cpr.theta_deg() * M_PI / 180.0, testing::tube_radius_mm))->px,
      20.0);
  ASSERT_TRUE(hit);
  on_cpr.press(pointer_dropping_at(hit->px, Button::left));
  on_cpr.move(pointer_dropping_at(hit->px + Vec2(0.5, 0.0)));  // trembles
  on_cpr.cancel();
  EXPECT_EQ(digest(), pulled);
  EXPECT_EQ(edits(), 1U);
}

TEST_F(Begun, EscapeLeavesWhatAnotherHasDoneMeanwhile) {
  begin_pull();
  bench.edit(lumen::VesselRename{bench.vessel.get(), "renamed"});
  const std::string both = digest();
  on_cpr.cancel();
  EXPECT_EQ(digest(), both);
  EXPECT_EQ(edits(), 2U);
}

TEST_F(Begun, AButtonThatWentUpUnseenLeavesThePullAsItIs) {
  begin_pull();
  const std::string pulled = digest();
  ASSERT_TRUE(on_cpr.holding());
  on_cpr.let_go();
  EXPECT_FALSE(on_cpr.holding());
  on_cpr.move(pointer_dropping_at(wall() + Vec2(30.0, 0.0)));
  on_cpr.release(pointer_dropping_at(wall() + Vec2(30.0, 0.0), Button::left));
  EXPECT_EQ(digest(), pulled);
  EXPECT_EQ(edits(), 1U);
}

TEST_F(Begun, LettingGoAfterAnotherStepAddsNone) {
  begin_pull();
  bench.edit(lumen::VesselRename{bench.vessel.get(), "renamed"});
  on_cpr.let_go();
  EXPECT_EQ(edits(), 2U);
}

TEST_F(Begun, ClicksGoOnWithoutAButton) {
  bench.tool.set(Tool::angle);
  for (const Vec2& px : {Vec2(100.0, 100.0), Vec2(200.0, 100.0)}) {
    on_slice.press(pointer_dropping_at(px, Button::left));
    on_slice.release(pointer_dropping_at(px, Button::left));
  }
  EXPECT_FALSE(on_slice.holding());
  on_slice.let_go();
  EXPECT_TRUE(on_slice.busy());
  on_slice.press(pointer_dropping_at({200.0, 200.0}, Button::left));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(bench.measured(made()[0]).front().value, 90.0, 0.1);
}

TEST_F(Begun, AnAngleDoesNotGoOnInAnotherCase) {
  bench.tool.set(Tool::angle);
  for (const Vec2& px : {Vec2(100.0, 100.0), Vec2(200.0, 100.0)})
    on_slice.press(pointer_dropping_at(px, Button::left));
  open_another(1.2);
  EXPECT_FALSE(on_slice.busy());
  on_slice.press(pointer_dropping_at({200.0, 200.0}, Button::left));
  EXPECT_TRUE(made().empty());
}

TEST_F(Begun, AnAngleDoesNotGoOnInAnotherImage) {
  bench.tool.set(Tool::angle);
  for (const Vec2& px : {Vec2(100.0, 100.0), Vec2(200.0, 100.0)})
    on_slice.press(pointer_dropping_at(px, Button::left));
  bench.close_image();
  EXPECT_FALSE(on_slice.busy());
}

TEST_F(Begun, APullDoesNotGoOnInAnotherCase) {
  begin_pull();
  open_another(testing::tube_radius_mm);
  const std::string before = digest();
  EXPECT_FALSE(on_cpr.busy());
  on_cpr.move(pointer_dropping_at(wall() + Vec2(20.0, 0.0)));
  on_cpr.cancel();
  EXPECT_EQ(digest(), before);
  EXPECT_EQ(edits(), 0U);
}

struct BegunOnY : Begun {
  BegunOnY() : Begun(lumen::testing::tree_of(geometry::y_junction(20.0, 30.0, 2.0, 1.5, 80.0))) {}
  std::int32_t other() const { return bench.model()->vessels[1]->vessel; }
};

TEST_F(BegunOnY, AnotherVesselEndsAPullInItsPictureAndLeavesWhatWasDone) {
  ASSERT_NE(bench.vessel.get(), other());
  bench.tool.set(Tool::drag);
  const auto hit =
      cpr.wall_near(cpr.project(bench.axis()->place(10.0, cpr.theta_deg() * M_PI / 180.0, 2.0))->px, 20.0);
  ASSERT_TRUE(hit);
  on_cpr.press(pointer_dropping_at(hit->px, Button::left));
  on_cpr.move(pointer_dropping_at(hit->px + Vec2(6.0, 0.0)));
  ASSERT_EQ(edits(), 1U);
  const std::string pulled = digest();
  bench.vessel.set(other());
  EXPECT_FALSE(on_cpr.busy());
  on_cpr.move(pointer_dropping_at(hit->px + Vec2(20.0, 0.0)));
  on_cpr.release(pointer_dropping_at(hit->px + Vec2(20.0, 0.0), Button::left));
  EXPECT_EQ(digest(), pulled);
}

TEST_F(BegunOnY, ASliceIsNoVesselsPictureAndItsAngleGoesOn) {
  bench.tool.set(Tool::angle);
  for (const Vec2& px : {Vec2(100.0, 100.0), Vec2(200.0, 100.0)})
    on_slice.press(pointer_dropping_at(px, Button::left));
  on_section.press(pointer_dropping_at({200.0, 200.0}, Button::left));
  bench.vessel.set(other());
  EXPECT_TRUE(on_slice.busy());
  EXPECT_FALSE(on_section.busy());
}

}  // namespace
}  // namespace ostia::view
