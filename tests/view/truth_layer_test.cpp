#include "ostia/view/truth_layer.h"

#include "case_tools.h"

#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::view {
namespace {

namespace tools = session::testing;

/// The wall that is known: oval, growing along the vessel, so that between contours it is between them.
double wall(double s, double theta) {
  return 1.0 + 0.04 * s + 0.2 * std::cos(2.0 * theta + 0.4);
}

class TruthLayerTest : public ::testing::Test {
 protected:
  TruthLayerTest() {
    bench_.set_session(session::Session(session::CaseFile::create(folder_ / "a.ostia", tools::tube_model())));
    const auto axis = bench_.axis();
    geometry::ContourSection section;
    section.section = "s01";
    section.vessel = bench_.vessel_name(tools::tube_vessel);
    section.observer = "truth";
    for (double s = 5.0; s <= 25.0; s += 1.0) {
      geometry::Contour contour{s, {}};
      for (int i = 0; i < 96; ++i)
        contour.points.push_back(axis->place(s, 2 * M_PI * i / 96, wall(s, 2 * M_PI * i / 96)));
      section.contours.push_back(contour);
    }
    check_.set_truth({{section}});
  }
  tools::TempFolder folder_;
  session::Workbench bench_;
  session::QualityCheck check_{bench_};
};

TEST_F(TruthLayerTest, OnACprItIsTheWallAtTheViewsAngle) {
  CurvedView view(bench_, CurvedView::Which::second, std::make_shared<CurvedFrame>());
  view.set_size(400, 700, 1.0);
  view.fit();
  TruthLayer layer(view, check_);
  for (const double turn : {0.0, 33.0, 120.0}) {
    bench_.theta_deg.set(turn);
    ASSERT_EQ(layer.lines().size(), 2U) << turn;  // both sides
    const double theta = view.theta_deg() * M_PI / 180.0;
    for (const auto& line : layer.lines()) {
      double first = 1e9, last = -1e9;
      for (const Vec2& px : line) {
        const double s = view.abscissa_at(px.y());
        const double rho = (px.x() - view.axis_at(s).x()) * view.pixel_mm();
        EXPECT_NEAR(std::abs(rho), wall(s, rho > 0 ? theta : theta + M_PI), 0.004) << s;
        first = std::min(first, s);
        last = std::max(last, s);
      }
      EXPECT_NEAR(first, 5.0, 1e-6);
      EXPECT_NEAR(last, 25.0, 1e-6);
    }
  }
}

TEST_F(TruthLayerTest, OnASectionBetweenTwoContoursItIsBetweenThem) {
  SectionView view(bench_, 0.0);
  view.set_size(400, 400, 1.0);
  TruthLayer layer(view, check_);
  bench_.cursor_mm.set(12.4);
  ASSERT_EQ(layer.lines().size(), 1U);
  const auto& line = layer.lines().front();
  EXPECT_EQ(line.front(), line.back());
  const auto axis = bench_.axis();
  for (const Vec2& px : line) {
    const geometry::AxisFoot foot = axis->nearest_foot(*view.world(px));
    EXPECT_NEAR(foot.s_mm, 12.4, 1e-6);
    EXPECT_NEAR(foot.rho_mm, wall(12.4, foot.theta), 0.004);
  }
  bench_.cursor_mm.set(27.0);
  EXPECT_TRUE(layer.lines().empty());
}

TEST_F(TruthLayerTest, ComesAndGoesWithItsSwitchAndStaysThroughEdits) {
  SectionView view(bench_, 0.0);
  view.set_size(400, 400, 1.0);
  bench_.cursor_mm.set(12.0);
  const auto count = [&] {
    const Overlay& shown = view.overlay();
    return std::count_if(shown.lines.begin(), shown.lines.end(),
                         [](const OverlayLine& line) { return line.role == Role::truth; });
  };
  EXPECT_EQ(count(), 0);
  {
    TruthLayer layer(view, check_);
    EXPECT_EQ(count(), 1);
    bench_.edit(tools::drag(12.0, 0.3));
    EXPECT_EQ(count(), 1);
    check_.shown.set(false);
    EXPECT_EQ(count(), 0);
    check_.shown.set(true);
    EXPECT_EQ(count(), 1);
    check_.close();
    EXPECT_EQ(count(), 0);
  }
  EXPECT_EQ(count(), 0);
}

TEST(LinesOfCut, JoinsCutsAndLeavesOutJumps) {
  // A strip of four triangles across out = 0; px.x runs along it.
  geometry::TriMesh strip;
  std::vector<std::optional<ViewPlace>> places;
  for (int i = 0; i < 3; ++i)
    for (const double out : {-1.0, 1.0}) {
      strip.points.emplace_back(i, out, 0.0);
      places.push_back(ViewPlace{Vec2(10.0 * i, 5.0 * out), out});
    }
  for (std::int32_t i = 0; i < 4; i += 2) {
    strip.triangles.push_back({i, i + 1, i + 2});
    strip.triangles.push_back({i + 1, i + 3, i + 2});
  }
  const auto lines = lines_of_cut(strip, places, 100.0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 5U);
  for (const Vec2& px : lines[0]) EXPECT_NEAR(px.y(), 0.0, 1e-12);
  EXPECT_TRUE(lines_of_cut(strip, places, 1.0).empty());
  places[2].reset();
  const auto rest = lines_of_cut(strip, places, 100.0);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].size(), 2U);
}

}  // namespace
}  // namespace ostia::view
