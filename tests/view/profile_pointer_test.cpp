#include "ostia/view/profile_pointer.h"

#include "bench_case.h"

#include <gtest/gtest.h>

namespace ostia::view {
namespace {

using testing::TubeCase;

struct HandOnProfile : ::testing::Test {
  TubeCase tube;
  ProfileView profile{tube.bench};
  ProfilePointer hand{profile};
  HandOnProfile() { profile.set_size(600, 160, 1.0); }
  std::int32_t add(analysis::MeasureKind kind, double from_mm, double to_mm) {
    analysis::Measurement one;
    one.kind = kind;
    one.vessel = tube.bench.vessel.get();
    one.from_mm = from_mm;
    one.to_mm = to_mm;
    return tube.bench.annotate(session::MeasureAdd{one}).annotations.measurements.front();
  }
  const std::vector<analysis::Measurement>& made() const {
    return tube.bench.session().file().annotations()->measurements;
  }
  /// On the line by which the profile shows an abscissa of a measurement: the last one that it draws there.
  Vec2 end_at(double s_mm) {
    double bottom = 0.0;
    for (const OverlayLine& line : profile.overlay().lines)
      if (line.role == Role::measurement || line.role == Role::selected) bottom = line.px.front().y();
    return {profile.x_of(s_mm), bottom - 4.0};
  }
  void drag(const std::vector<Vec2>& way) {
    hand.press({way.front(), Button::left});
    for (const Vec2& px : way) hand.move({px});
    hand.release({way.back(), Button::left});
  }
};

TEST_F(HandOnProfile, TheCursorGoesWhereTheHandIs) {
  drag({{profile.x_of(9.0), 60.0}});
  EXPECT_NEAR(tube.bench.cursor_mm.get(), 9.0, 1e-9);
  drag({{profile.x_of(9.0), 60.0}, {profile.x_of(12.0), 20.0}, {profile.x_of(14.0), 20.0}});
  EXPECT_NEAR(tube.bench.cursor_mm.get(), 14.0, 1e-9);
  hand.move({{profile.x_of(20.0), 60.0}});
  EXPECT_NEAR(tube.bench.cursor_mm.get(), 14.0, 1e-9);
  EXPECT_EQ(hand.shape(), CursorShape::arrow);
}

TEST_F(HandOnProfile, AReferenceIsMovedAsOneStepAndTheCursorStays) {
  tube.bench.cursor_mm.set(5.0);
  const std::int32_t id = add(analysis::MeasureKind::stenosis, 10.0, 20.0);
  hand.move({end_at(20.0)});
  EXPECT_EQ(hand.shape(), CursorShape::grab);
  drag({end_at(20.0) + Vec2(3.0, 0.0), end_at(22.0), end_at(25.0) + Vec2(3.0, -50.0)});
  EXPECT_NEAR(made()[0].to_mm, 25.0, 1e-9);
  EXPECT_EQ(made()[0].from_mm, 10.0);
  EXPECT_EQ(tube.bench.selected_measurement.get(), id);
  EXPECT_EQ(tube.bench.cursor_mm.get(), 5.0);
  drag({end_at(10.0), {profile.x_of(40.0), 80.0}});
  EXPECT_LT(made()[0].from_mm, made()[0].to_mm);
  EXPECT_GT(made()[0].from_mm, 24.0);
  drag({end_at(25.0), {5000.0, 80.0}});
  EXPECT_DOUBLE_EQ(made()[0].to_mm, tube.bench.axis()->length());
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(tube.bench.undo());
  EXPECT_EQ(made()[0].from_mm, 10.0);
  EXPECT_EQ(made()[0].to_mm, 20.0);
}

TEST_F(HandOnProfile, ARingIsMovedAndAnyIsErasedOverAnEnd) {
  add(analysis::MeasureKind::ring_hu, 8.0, 8.0);
  add(analysis::MeasureKind::volume, 12.0, 26.0);
  drag({end_at(8.0), end_at(3.0)});
  EXPECT_NEAR(made()[0].from_mm, 3.0, 1e-9);
  EXPECT_FALSE(hand.erase({{profile.x_of(19.0), 60.0}}));
  EXPECT_TRUE(hand.erase({end_at(12.0)}));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_TRUE(hand.erase({end_at(3.0)}));
  EXPECT_TRUE(made().empty());
}

TEST_F(HandOnProfile, AClickOnAnEndMovesNothingAndNothingIsTakenThatIsNotShown) {
  add(analysis::MeasureKind::volume, 12.0, 26.0);
  const std::size_t steps = tube.bench.session().file().journal().size();
  drag({end_at(12.0), end_at(12.0) + Vec2(1.0, 1.0)});
  EXPECT_EQ(tube.bench.session().file().journal().size(), steps);
  const Vec2 there = end_at(12.0);
  tube.bench.marks_shown.set(false);
  drag({there, end_at(5.0)});
  EXPECT_EQ(made()[0].from_mm, 12.0);
  EXPECT_FALSE(hand.erase({there}));
}

TEST_F(HandOnProfile, EscapeBringsAnEndBackAndNoMoreIsDoneUntilTheRelease) {
  add(analysis::MeasureKind::volume, 12.0, 26.0);
  hand.press({end_at(12.0), Button::left});
  hand.move({end_at(8.0)});
  hand.move({end_at(5.0)});
  ASSERT_NEAR(made()[0].from_mm, 5.0, 1e-9);
  hand.cancel();
  EXPECT_FALSE(hand.holding());
  hand.move({end_at(3.0)});
  hand.release({end_at(3.0), Button::left});
  EXPECT_EQ(made()[0].from_mm, 12.0);
  ASSERT_TRUE(tube.bench.redo());
  EXPECT_NEAR(made()[0].from_mm, 5.0, 1e-9);
}

TEST_F(HandOnProfile, AButtonThatWentUpUnseenLeavesTheEndWhereItIs) {
  add(analysis::MeasureKind::volume, 12.0, 26.0);
  hand.press({end_at(12.0), Button::left});
  hand.move({end_at(5.0)});
  hand.let_go();
  hand.move({end_at(3.0)});
  EXPECT_NEAR(made()[0].from_mm, 5.0, 1e-9);
}

TEST_F(HandOnProfile, WhatIsInTheHandDoesNotGoOnWithoutItsCaseOrImage) {
  hand.press({{profile.x_of(9.0), 60.0}, Button::left});
  tube.bench.close_image();
  EXPECT_FALSE(hand.holding());
  hand.release({{profile.x_of(9.0), 60.0}, Button::left});
  hand.press({{profile.x_of(9.0), 60.0}, Button::left});
  ASSERT_TRUE(hand.holding());
  tube.bench.close_case();
  EXPECT_FALSE(hand.holding());
}

TEST_F(HandOnProfile, WithoutACaseNothingHappens) {
  tube.bench.close_case();
  EXPECT_NO_THROW(drag({{100.0, 150.0}, {200.0, 150.0}}));
  EXPECT_FALSE(hand.erase({{100.0, 150.0}}));
}

}  // namespace
}  // namespace ostia::view
