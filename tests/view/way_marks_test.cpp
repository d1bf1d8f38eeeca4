// The parent's part of a vessel's way on CPR and profile, and the colours of vessels.

#include "bench_case.h"
#include "vessel_trees.h"

#include "ostia/lumen/edit.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/pointer.h"
#include "ostia/view/profile_view.h"
#include "ostia/view/vessel_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace ostia::view {
namespace {

constexpr std::int32_t main_id = 7, lcx_id = 9;
constexpr double joint_mm = 12.0;

/// LAD along z; at 12 mm an LCX leaves it at 45 degrees.
geometry::VesselTree left_tree() {
  lumen::testing::YTree y;
  y.joint_mm = joint_mm, y.main_length_mm = 30.0, y.side_length_mm = 16.0;
  y.main_radius_mm = 1.5, y.side_radius_mm = 1.0;
  y.main_id = main_id, y.side_id = lcx_id, y.side_name = "LCX";
  return y.tree();
}

struct WayMarks : ::testing::Test {
  testing::TubeCase tube{left_tree()};
  CurvedView curved{tube.bench, CurvedView::Which::first, std::make_shared<CurvedFrame>()};
  ProfileView profile{tube.bench};
  WayMarks() {
    curved.set_size(300, 500, 1.0);
    profile.set_size(500, 200, 1.0);
    tube.bench.vessel.set(lcx_id);
  }
  static bool says(const Overlay& overlay, const std::string& text) {
    return std::any_of(overlay.texts.begin(), overlay.texts.end(),
                       [&](const OverlayText& one) { return one.text == text; });
  }
  static int of_color(const Overlay& overlay, const figure::Color& color) {
    return static_cast<int>(std::count_if(overlay.lines.begin(), overlay.lines.end(),
                                          [&](const OverlayLine& one) { return one.color == color; }));
  }
};

TEST_F(WayMarks, TheParentsPartIsBracketedAndNamedOnTheCpr) {
  const figure::Color parent = vessel_color("LAD", main_id);
  EXPECT_TRUE(says(curved.overlay(), "LM (5)"));
  EXPECT_EQ(of_color(curved.overlay(), parent), 2);
  for (const OverlayLine& one : curved.overlay().lines) {
    if (one.color != parent || one.px.size() != 4) continue;
    EXPECT_NEAR(curved.abscissa_at(one.px.front().y()), 0.0, 0.01);
    EXPECT_NEAR(curved.abscissa_at(one.px.back().y()), joint_mm, 0.05);
  }
  tube.bench.vessel.set(main_id);
  EXPECT_FALSE(says(curved.overlay(), "LM (5)"));
  EXPECT_EQ(of_color(curved.overlay(), parent), 0);
}

TEST_F(WayMarks, AndTintedAndNamedOnTheProfileWhoseCurvesDoNotJump) {
  const Overlay& overlay = profile.overlay();
  EXPECT_TRUE(says(overlay, "LM (5)"));
  const auto tint = std::find_if(overlay.bands.begin(), overlay.bands.end(), [](const OverlayBand& band) {
    return band.color == vessel_color("LAD", main_id) && band.opacity < 0.5;
  });
  ASSERT_NE(tint, overlay.bands.end());
  EXPECT_NEAR(*profile.abscissa_at(tint->high.x()), joint_mm, 0.05);
  for (const OverlayLine& line : overlay.lines) {
    if (line.role != Role::diameter && line.role != Role::reference) continue;
    for (std::size_t i = 3; i + 4 < line.px.size(); ++i)  // clear of the vessel's ends
      EXPECT_LT(std::abs(line.px[i].y() - line.px[i - 1].y()), 20.0) << line.px[i].x();
  }
}

TEST_F(WayMarks, WhatIsPulledOnTheParentsPartIsTheParents) {
  const auto samples = [&](std::int32_t id) { return lumen::vessel(*tube.bench.model(), id).samples; };
  const auto edited = [&](std::int32_t id) {
    const auto all = samples(id);
    return std::any_of(all.begin(), all.end(),
                       [](const auto& one) { return one.origin == lumen::SampleOrigin::edit; });
  };
  const Vec3 wall = tube.bench.axis()->place(6.0, 0.0, 1.5), out = tube.bench.axis()->place(6.0, 0.0, 1.9);
  const auto from = curved.project_near(wall, 6.0), to = curved.project_near(out, 6.0);
  ASSERT_TRUE(from && to);
  tube.bench.tool.set(session::Tool::drag);
  Pointer pointer(curved);
  PointerEvent event;
  event.px = from->px;
  event.button = Button::left;
  pointer.press(event);
  event.px = to->px;
  pointer.move(event);
  pointer.release(event);
  EXPECT_TRUE(edited(main_id));
  EXPECT_FALSE(edited(lcx_id));
}

TEST(VesselColors, BelongToNamesAndElseToTheVesselItself) {
  const auto key = [](const figure::Color& c) { return std::tuple(c.r, c.g, c.b); };
  std::set<std::tuple<double, double, double>> all;
  const std::vector<std::string> names{"LM",  "LAD", "D1",  "D2", "RI",  "LCX",
                                       "OM1", "OM2", "RCA", "AM", "PDA", "PLB"};
  for (const std::string& name : names) {
    EXPECT_EQ(key(vessel_color(name, 1)), key(vessel_color(name, 77))) << name;
    all.insert(key(vessel_color(name, 1)));
  }
  for (std::int32_t id = 0; id < 4; ++id) all.insert(key(vessel_color("V1", id)));
  EXPECT_EQ(all.size(), names.size() + 4);
  EXPECT_EQ(key(vessel_color("lad", 3)), key(vessel_color("LAD", 1)));
  EXPECT_EQ(key(vessel_color("V1", 6)), key(vessel_color("graft", 6)));
  EXPECT_NO_THROW(vessel_color("", -2147483647 - 1));
}

TEST_F(WayMarks, ColoursStayWhenVesselsGoAndComeBack) {
  const auto key = [](const figure::Color& c) { return std::tuple(c.r, c.g, c.b); };
  const auto lad = key(vessel_color(tube.bench, main_id)), lcx = key(vessel_color(tube.bench, lcx_id));
  tube.bench.edit(lumen::BranchDelete{lcx_id});
  EXPECT_EQ(key(vessel_color(tube.bench, main_id)), lad);
  lumen::BranchAdd add{main_id, "LCX", {}, {}, {}};
  for (int i = 1; i <= 20; ++i) {
    add.points.push_back(Vec3(0, 0, joint_mm) + 0.7 * i * Vec3(1, 0, 1).normalized());
    add.radius_mm.push_back(1.0);
  }
  tube.bench.edit(add);
  const std::int32_t again = tube.bench.model()->tree.vessels.back().id;
  EXPECT_NE(again, lcx_id);
  EXPECT_EQ(key(vessel_color(tube.bench, again)), lcx);
}

}  // namespace
}  // namespace ostia::view
