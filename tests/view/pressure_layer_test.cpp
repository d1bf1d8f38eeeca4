// FFR over the CPRs and in the profile: the board's numbers, where they belong, and nothing of them unasked.

#include "ostia/view/pressure_layer.h"

#include "report_cases.h"

#include "ostia/core/quantity_text.h"
#include "ostia/view/profile_view.h"
#include "ostia/view/value_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::view {
namespace {

class PressureLayerTest : public ::testing::Test {
 protected:
  PressureLayerTest() {
    session::CaseFile::create(folder_ / "a.ostia",
                              session::testing::narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.4));
    bench_.set_session(session::Session::open(folder_ / "a.ostia"));
    bench_.cursor_mm.set(50.0);
  }
  void compute() {
    board_.shown.set(true);
    while (const auto work = board_.begin()) board_.take(*work, work->found());
  }
  static std::vector<OverlayText> of_role(const Overlay& overlay, Role role) {
    std::vector<OverlayText> out;
    for (const OverlayText& text : overlay.texts)
      if (text.role == role) out.push_back(text);
    return out;
  }
  static std::vector<OverlayLine> lines(const Overlay& overlay, Role role) {
    std::vector<OverlayLine> out;
    for (const OverlayLine& line : overlay.lines)
      if (line.role == role) out.push_back(line);
    return out;
  }
  session::testing::TempFolder folder_;
  session::Workbench bench_;
  session::PressureBoard board_{bench_};
};

TEST_F(PressureLayerTest, TellsFfrBesideTheCursorAndWhereItFallsToTheThreshold) {
  CurvedView view(bench_, CurvedView::Which::first, std::make_shared<CurvedFrame>());
  view.set_size(300, 800, 1.0);
  const PressureLayer layer(view, board_);
  EXPECT_TRUE(of_role(view.overlay(), Role::pressure).empty());
  compute();
  const double ffr = *session::ffr_at(*board_.now(), session::testing::tube_vessel, 50.0);
  ASSERT_LT(ffr, 0.8);
  const auto shown = of_role(view.overlay(), Role::pressure);
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[0].text.rfind("FFR (research) " + core::ratio_text(ffr) + " (0.", 0), 0U) << shown[0].text;
  EXPECT_NEAR(view.abscissa_at(shown[0].px.y()), 50.0, 1.0);
  EXPECT_EQ(shown[1].text, "0.80");
  const auto marks = lines(view.overlay(), Role::pressure);
  ASSERT_EQ(marks.size(), 1U);
  const double falls = view.abscissa_at(marks[0].px[0].y());
  EXPECT_NEAR(*session::ffr_at(*board_.now(), session::testing::tube_vessel, falls), 0.80, 0.01);
  EXPECT_TRUE(of_role(view.overlay(), Role::what_if).empty());
  board_.add_what_if({session::testing::tube_vessel, 18.0, 32.0, session::WhatIfKind::open, 0.0});
  compute();
  ASSERT_EQ(of_role(view.overlay(), Role::what_if).size(), 1U);
  EXPECT_EQ(of_role(view.overlay(), Role::what_if)[0].text.rfind("what if 0.9", 0), 0U);
  board_.shown.set(false);
  EXPECT_TRUE(of_role(view.overlay(), Role::pressure).empty());
  EXPECT_TRUE(lines(view.overlay(), Role::pressure).empty());
}

TEST_F(PressureLayerTest, TheProfileHasTheCurveBeforeAndAfterOverTheSamePlaces) {
  ProfileView view(bench_);
  view.set_size(700, 260, 1.0);
  view.set_pressure(&board_);
  EXPECT_FALSE(of_role(view.overlay(), Role::area).empty());
  EXPECT_TRUE(lines(view.overlay(), Role::pressure).empty());
  compute();
  EXPECT_TRUE(of_role(view.overlay(), Role::area).empty()) << "its axis has the room of the area's";
  const auto along = session::ffr_along(*board_.now(), session::testing::tube_vessel);
  const auto curves = lines(view.overlay(), Role::pressure);
  ASSERT_EQ(curves.size(), 3U);  // threshold, curve, axis
  const OverlayLine& curve = curves[1];
  ASSERT_EQ(curve.px.size(), along.size());
  for (std::size_t i = 0; i < along.size(); ++i) EXPECT_NEAR(curve.px[i].x(), view.x_of(along[i].s_mm), 1e-6);
  int bands = 0;
  for (const OverlayBand& band : view.overlay().bands) bands += band.role == Role::pressure ? 1 : 0;
  EXPECT_EQ(bands, static_cast<int>(along.size()) - 1) << "how sure it is";
  // 0.80 is where the threshold's line is.
  const auto falls = session::falls_to_threshold_mm(along, 0.8);
  ASSERT_TRUE(falls);
  const double line = curves[0].px[0].y(), x = view.x_of(*falls);
  for (std::size_t i = 1; i < curve.px.size(); ++i)
    if (curve.px[i - 1].x() <= x && x < curve.px[i].x()) {
      EXPECT_LE(curve.px[i - 1].y(), line + 1e-6) << "above before";
      EXPECT_GE(curve.px[i].y(), line - 1e-6) << "below behind";
    }
  board_.add_what_if({session::testing::tube_vessel, 18.0, 32.0, session::WhatIfKind::open, 0.0});
  compute();
  const auto after = lines(view.overlay(), Role::what_if);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_LT(after[0].px.back().y(), lines(view.overlay(), Role::pressure)[1].px.back().y()) << "higher";
  view.set_pressure(nullptr);
  EXPECT_TRUE(lines(view.overlay(), Role::pressure).empty());
}

TEST(FallingScale, IsTheDivergingOneFromItsOtherEnd) {
  for (const double t : {0.0, 0.2, 0.5, 1.0}) {
    const figure::Color a = scale_color(ColorScale::falling, t),
                        b = scale_color(ColorScale::diverging, 1 - t);
    EXPECT_EQ(a.r, b.r);
    EXPECT_EQ(a.b, b.b);
  }
  const figure::Color low = scale_color(ColorScale::falling, 0.0);
  EXPECT_GT(low.r, low.b) << "low ratios are vermilion";
}

}  // namespace
}  // namespace ostia::view
