// From a case's walls, or a tree of lines, to a network of flow.

#include "report_cases.h"

#include "ostia/core/error.h"
#include "ostia/session/pressure_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace ostia::session::testing {
namespace {

using ::testing::HasSubstr;

PressureTree tree_of_walls(const lumen::LumenModel& model) {
  return pressure_tree(model, solved_surfaces(model, core::no_task()));
}

TEST(PressureTree, OfATubeHasItsSections) {
  const lumen::LumenModel model = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.8);
  const PressureTree walls = tree_of_walls(model), lines = pressure_tree(model.tree);
  for (const PressureTree* tree : {&walls, &lines}) {
    ASSERT_EQ(tree->network.branches.size(), 1u);
    EXPECT_EQ(tree->network.branches[0].parent, -1);
    EXPECT_EQ(tree->network.branches[0].name, "LAD");
    ASSERT_EQ(tree->lesions.size(), 1u);
    EXPECT_NEAR(tree->lesions[0].throat.s_mm, 25.0, 0.6);
    double least = HUGE_VAL;
    for (const auto& station : tree->network.branches[0].stations) {
      least = std::min(least, station.diameter_mm());
      EXPECT_LT(station.shape.viscous, 1.02);
      EXPECT_NEAR(station.curvature_per_mm, 0.0, 1e-3);
    }
    EXPECT_NEAR(least, 1.6, 0.06);
  }
}

TEST(PressureTree, OfAForkLeavesOutWhatIsInTheParent) {
  const lumen::LumenModel model = named_y();
  const PressureTree walls = tree_of_walls(model), lines = pressure_tree(model.tree);
  for (const PressureTree* tree : {&walls, &lines}) {
    const auto& branches = tree->network.branches;
    ASSERT_EQ(branches.size(), 3u);
    EXPECT_EQ(branches[0].parent, -1);
    EXPECT_EQ(branches[1].parent, 0);
    EXPECT_EQ(branches[2].parent, 0);
    // On arcs until 70 degrees lie between them; about a diameter on, the most of that. On different sides.
    const double between = std::abs(branches[1].angle_rad - branches[2].angle_rad);
    EXPECT_GT(between, 45.0 * std::numbers::pi / 180.0);
    EXPECT_LT(between, 72.0 * std::numbers::pi / 180.0);
    EXPECT_LT(branches[1].angle_rad * branches[2].angle_rad, 0.0);
    for (const auto& branch : branches)
      for (const auto& station : branch.stations)
        EXPECT_GT(station.area_mm2, 3.0) << branch.name << station.s_mm;
  }
  // The second vessel's part begins where it is out of the trunk's lumen.
  const auto& side = walls.network.branches[2];
  EXPECT_GT(side.stations.front().s_mm, walls.vessels.at(side.vessel).own_from_mm);
}

TEST(PressureTree, WallsAndLinesOfAForkGiveThePressuresOfEachOther) {
  const lumen::LumenModel model = narrowed_y(1, 12.0, 0.5);
  const PressureReport walls = make_pressure_report(tree_of_walls(model), {});
  const PressureReport lines = make_pressure_report(pressure_tree(model.tree), {});
  ASSERT_EQ(walls.network->outlets().size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t outlet = walls.network->outlets()[k];
    EXPECT_NEAR(walls.hyperaemia.solution.to_pa[outlet] / walls.hyperaemia.solution.inlet_pa,
                lines.hyperaemia.solution.to_pa[outlet] / lines.hyperaemia.solution.inlet_pa, 0.03);
  }
}

TEST(PressureTree, AWallThatIsShutIsAnOcclusion) {
  const lumen::LumenModel model = shut_tube();
  const PressureReport report = make_pressure_report(tree_of_walls(model), {});
  EXPECT_TRUE(report.network->beyond_occlusion(0));
  EXPECT_EQ(report.hyperaemia.solution.flow_ml_s[0], 0.0);
  EXPECT_THAT(report.warnings, ::testing::Contains(HasSubstr("occluded")));
  EXPECT_THAT(pressure_json(report), ::testing::Not(HasSubstr("nan")));
}

TEST(PressureTree, AfterAnEditIsWhatAWholeMeasurementGives) {
  const lumen::LumenModel before = narrowed_tube("LAD", 60.0, 1.6, 25.0, 1.2);
  const lumen::LumenModel after = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.8);
  PressureTree tree = tree_of_walls(before);
  const auto changed = update_pressure_tree(tree, after, solved_surfaces(after, core::no_task()),
                                            tree.network.branches[0].vessel, 18.0, 32.0);
  ASSERT_EQ(changed, std::vector<std::size_t>{0});
  const PressureTree whole = tree_of_walls(after);
  const auto &a = tree.network.branches[0].stations, &b = whole.network.branches[0].stations;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].s_mm, b[i].s_mm, 1e-9);
    EXPECT_NEAR(a[i].area_mm2, b[i].area_mm2, 0.02 * b[i].area_mm2) << a[i].s_mm;
  }
}

TEST(PressureTree, RefusesATreeWithAFault) {
  lumen::LumenModel model = named_y();
  geometry::VesselTree tree = model.tree;
  tree.segments[1].from = 999;
  EXPECT_THROW(pressure_tree(tree), InvalidInput);
  EXPECT_THROW(pressure_tree(geometry::VesselTree()), InvalidInput);
  PressureTreeOptions options;
  options.bend_chord_mm = 0.0;
  EXPECT_THROW(pressure_tree(model.tree, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::session::testing
