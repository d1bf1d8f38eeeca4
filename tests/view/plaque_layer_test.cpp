#include "ostia/view/plaque_layer.h"

#include "bench_case.h"

#include "ostia/session/plaque_sampling.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"
#include "ostia/view/profile_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::view {
namespace {

using analysis::PlaqueClass;

using std::numbers::pi;
constexpr double lumen_mm = 1.5, outer_mm = 2.7, from_mm = 5.0, to_mm = 25.0;
constexpr std::array class_hu{0.0, 80.0, 200.0, 700.0};

/// A class a quarter of the turn, each of another one 10 mm on.
int true_class(double s_mm, double theta) {
  const double turns = theta / (2.0 * pi);
  return (static_cast<int>((turns - std::floor(turns)) * 4.0) + (s_mm >= 15.0 ? 1 : 0)) % 4;
}

/// Walls and plaque as of an image without blur.
session::VesselWalls plaque_layer_walls_of(const session::OuterWallWork& work) {
  session::VesselWalls walls;
  walls.vessel = work.vessel;
  walls.axis = lumen::vessel(*work.model, work.vessel).axis;
  for (auto* rows : {&walls.lumen, &walls.outer.surface}) {
    rows->from_mm = from_mm;
    rows->step_mm = 1.0;
    rows->around = 32;
    rows->radius_mm.assign(21 * 32, rows == &walls.lumen ? lumen_mm : outer_mm);
  }
  analysis::PlaqueOptions options;
  options.blur_sigma_mm = 0.0;
  analysis::WallRadii radii;
  radii.from_mm = from_mm;
  radii.to_mm = to_mm;
  radii.lumen_mm = [](double, double) { return lumen_mm; };
  radii.outer_mm = [](double, double) { return outer_mm; };
  const auto hu_at = [&](const Vec3& place) {
    const geometry::AxisFoot foot = walls.axis->nearest_foot(place);
    return class_hu[static_cast<std::size_t>(true_class(foot.s_mm, foot.theta))];
  };
  walls.plaque = analysis::plaque_profile(*walls.axis, radii, hu_at, options);
  for (const analysis::PlaqueSlab& slab : walls.plaque.slabs)
    walls.maps.push_back(analysis::plaque_map(*walls.axis, radii, slab.s_mm, hu_at, options));
  return walls;
}

class PlaqueLayerTest : public ::testing::Test {
 protected:
  session::Workbench& bench() { return tube_.bench; }
  void find() {
    const auto work = board_.work();
    ASSERT_TRUE(work);
    ASSERT_TRUE(board_.take(*work, plaque_layer_walls_of(*work)));
  }
  /// Every pixel of the view against what is truly there; those within a pixel and a half of a border between
  /// two of them may be either. Counts what is coloured.
  int expect_true(PictureView& view, PlaqueLayer& layer) {
    const OverlayTint* tint = layer.tint().get();
    const double margin = 1.5 * view.pixel_mm();
    int colored = 0, wrong = 0;
    for (int y = 0; y < view.height(); ++y)
      for (int x = 0; x < view.width(); ++x) {
        int shown = 0;
        if (tint && x >= tint->left && y >= tint->top && x < tint->left + tint->width &&
            y < tint->top + tint->height)
          shown = tint->what[static_cast<std::size_t>(y - tint->top) * static_cast<std::size_t>(tint->width) +
                             static_cast<std::size_t>(x - tint->left)];
        if (shown > 0) ++colored;
        const geometry::AxisFoot foot = bench().axis()->nearest_foot(*view.world({x + 0.5, y + 0.5}));
        const double quarter = std::remainder(foot.theta, pi / 2.0) * foot.rho_mm;
        const auto near = [&](double value, double border) { return std::abs(value - border) < margin; };
        if (near(foot.rho_mm, lumen_mm) || near(foot.rho_mm, outer_mm)) continue;
        const bool between = foot.rho_mm > lumen_mm && foot.rho_mm < outer_mm && !foot.past_end &&
                             foot.s_mm > from_mm && foot.s_mm < to_mm;
        if (between && (std::abs(quarter) < margin + 0.5 * foot.rho_mm * 2.0 * pi / 96.0 ||
                        std::abs(foot.s_mm - 15.0) < 0.125 + margin || near(foot.s_mm, from_mm) ||
                        near(foot.s_mm, to_mm)))
          continue;
        const int expected = between ? 1 + true_class(foot.s_mm, foot.theta) : 0;
        if (shown != expected && wrong++ < 5)
          ADD_FAILURE() << x << ", " << y << ": " << shown << " instead of " << expected << " at "
                        << foot.s_mm << " mm, " << foot.rho_mm << " mm from the axis";
      }
    EXPECT_EQ(wrong, 0);
    return colored;
  }
  testing::TubeCase tube_;
  session::OuterWallBoard board_{tube_.bench};
};

TEST_F(PlaqueLayerTest, OnASectionEachPixelBetweenTheWallsHasItsClass) {
  SectionView view(bench(), 0.0);
  view.set_size(330, 300, 1.0);
  PlaqueLayer layer(view, board_);
  EXPECT_FALSE(layer.tint());
  find();
  for (const double s : {9.0, 20.0}) {
    bench().cursor_mm.set(s);
    const double ring_mm2 = pi * (outer_mm * outer_mm - lumen_mm * lumen_mm);
    EXPECT_NEAR(expect_true(view, layer) * view.pixel_mm() * view.pixel_mm(), ring_mm2, 0.02 * ring_mm2);
  }
  view.zoom(3.0, {40.0, 60.0});  // a part of it, no longer in the middle
  EXPECT_GT(expect_true(view, layer), 1000);
  bench().cursor_mm.set(27.0);  // beyond what was measured
  EXPECT_FALSE(layer.tint());
}

TEST_F(PlaqueLayerTest, OnANeighbourTheClassesAreThoseOfItsOwnPlace) {
  SectionView view(bench(), 2.0, 12.0);
  view.set_size(100, 100, 1.0);
  PlaqueLayer layer(view, board_);
  find();
  bench().cursor_mm.set(13.5);  // the neighbour lies beyond 15 mm
  EXPECT_GT(expect_true(view, layer), 500);
}

TEST_F(PlaqueLayerTest, OnCprsAsOnSections) {
  for (const auto mode : {reformat::CurvedMode::straightened, reformat::CurvedMode::stretched})
    for (const auto which : {CurvedView::Which::first, CurvedView::Which::second}) {
      CurvedView view(bench(), which, std::make_shared<CurvedFrame>());
      view.set_size(300, 500, 1.0);
      bench().curved_mode.set(mode);
      bench().theta_deg.set(20.0);
      view.fit();
      PlaqueLayer layer(view, board_);
      if (!board_.of_selected()) find();
      const double both_mm2 = 2.0 * (outer_mm - lumen_mm) * (to_mm - from_mm);
      EXPECT_NEAR(expect_true(view, layer) * view.pixel_mm() * view.pixel_mm(), both_mm2, 0.06 * both_mm2);
      view.pan({37.0, -20.0});
      expect_true(view, layer);
    }
}

TEST_F(PlaqueLayerTest, IsInThePictureOnlyWhileItIsSwitchedOnAndIsMadeOnce) {
  SectionView view(bench(), 0.0);
  view.set_size(330, 330, 1.0);
  PlaqueLayer layer(view, board_);
  find();
  bench().cursor_mm.set(9.0);
  EXPECT_TRUE(view.overlay().tints.empty());
  board_.plaque_shown.set(true);
  ASSERT_EQ(view.overlay().tints.size(), 1U);
  const auto first = view.overlay().tints.front();
  EXPECT_EQ(first->roles,
            (std::vector<Role>{Role::low_attenuation, Role::fibrofatty, Role::fibrous, Role::calcified}));
  EXPECT_LT(first->opacity, 0.6);  // the image is to be seen below
  // A legend with every class' colour.
  for (const Role role : first->roles)
    EXPECT_EQ(std::count_if(view.overlay().bands.begin(), view.overlay().bands.end(),
                            [&](const OverlayBand& band) { return band.role == role; }),
              1);
  bench().theta_deg.set(30.0);  // the overlay is another, the picture is not
  EXPECT_EQ(view.overlay().tints.front(), first);
  bench().cursor_mm.set(9.5);
  EXPECT_NE(view.overlay().tints.front(), first);
  view.set_size(90, 90, 1.0);  // no room for words
  EXPECT_TRUE(view.overlay().bands.empty());
  EXPECT_EQ(view.overlay().tints.size(), 1U);
  board_.plaque_shown.set(false);
  EXPECT_TRUE(view.overlay().tints.empty());
}

TEST_F(PlaqueLayerTest, ASliceShowsNone) {
  SliceView view(bench(), SliceKind::axial);
  view.set_size(300, 300, 1.0);
  PlaqueLayer layer(view, board_);
  find();
  board_.plaque_shown.set(true);
  EXPECT_TRUE(view.overlay().tints.empty());
  EXPECT_TRUE(view.overlay().bands.empty());
}

TEST_F(PlaqueLayerTest, WhileAHandTurnsAStretchedReformationItWaits) {
  CurvedView view(bench(), CurvedView::Which::first, std::make_shared<CurvedFrame>());
  view.set_size(200, 300, 1.0);
  bench().curved_mode.set(reformat::CurvedMode::stretched);
  PlaqueLayer layer(view, board_);
  find();
  board_.plaque_shown.set(true);
  EXPECT_EQ(view.overlay().tints.size(), 1U);
  bench().turning.set(true);
  EXPECT_TRUE(view.overlay().tints.empty());
  bench().turning.set(false);
  EXPECT_EQ(view.overlay().tints.size(), 1U);
}

TEST_F(PlaqueLayerTest, AThinWallHasNoColour) {
  const auto work = board_.work();
  ASSERT_TRUE(work);
  session::VesselWalls walls = plaque_layer_walls_of(*work);
  for (analysis::PlaqueMap& map : walls.maps) std::fill(map.pieces.begin(), map.pieces.end(), std::nullopt);
  ASSERT_TRUE(board_.take(*work, std::move(walls)));
  SectionView view(bench(), 0.0);
  view.set_size(200, 200, 1.0);
  PlaqueLayer layer(view, board_);
  bench().cursor_mm.set(9.0);
  ASSERT_TRUE(layer.tint());
  EXPECT_EQ(std::count(layer.tint()->what.begin(), layer.tint()->what.end(), 0),
            static_cast<std::ptrdiff_t>(layer.tint()->what.size()));
}

TEST_F(PlaqueLayerTest, TheProfileHasTheOuterWallsDiameterWhileItIsShown) {
  ProfileView view(bench());
  view.set_size(600, 200, 1.0);
  view.set_walls(&board_);
  const auto line = [&]() -> std::vector<Vec2> {
    for (const OverlayLine& one : view.overlay().lines)
      if (one.role == Role::outer_wall) return one.px;
    return {};
  };
  find();
  EXPECT_TRUE(line().empty());
  board_.plaque_shown.set(true);
  const std::vector<Vec2> shown = line();
  ASSERT_GT(shown.size(), 10U);
  EXPECT_NEAR(shown.front().x(), view.x_of(from_mm + 0.125), 0.5);
  EXPECT_NEAR(shown.back().x(), view.x_of(to_mm - 0.125), 0.5);
  double lumen_y = 0.0;
  for (const OverlayLine& one : view.overlay().lines)
    if (one.role == Role::diameter) lumen_y = one.px[one.px.size() / 2].y();
  const double bottom = 200.0 - 26.0;
  EXPECT_NEAR((bottom - shown[shown.size() / 2].y()) / (bottom - lumen_y), outer_mm / lumen_mm, 0.02);
  board_.plaque_shown.set(false);
  EXPECT_TRUE(line().empty());
  view.set_walls(nullptr);
}

TEST_F(PlaqueLayerTest, TheProfileKnowsTheStenosisUnderAPlace) {
  bench().edit(testing::outline_of(bench(), 15.0, 0.6));
  ProfileView view(bench());
  view.set_size(600, 200, 1.0);
  view.overlay();
  const auto& known = bench().stenoses(bench().vessel.get());
  ASSERT_FALSE(known.empty());
  const auto found = view.lesion_at({view.x_of(known.front().throat_mm), 100.0});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->throat_mm, known.front().throat_mm);
  EXPECT_FALSE(view.lesion_at({view.x_of(2.0), 100.0}));
  EXPECT_FALSE(view.lesion_at({view.x_of(known.front().throat_mm), 195.0}));  // below the plot
}

}  // namespace
}  // namespace ostia::view
