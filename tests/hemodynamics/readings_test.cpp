// What is read off: behind lesions, along pullbacks, and marks.

#include "ostia/hemodynamics/readings.h"

#include "flow_networks.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::hemodynamics {
namespace {

using ::testing::HasSubstr;
using testing::narrowed, testing::tube_of, testing::vessel_of;

struct Tree {
  PreparedNetwork network;
  FlowState state;
};

Tree tree_of(Network network) {
  PreparedNetwork prepared(std::move(network), {});
  const RestingFlow resting = resting_flow(prepared.network(), {});
  FlowState state = flow_state(prepared, {}, resting, State::hyperaemia);
  return {std::move(prepared), std::move(state)};
}

Network focal(double least = 0.5) {
  Network network;
  network.branches = {vessel_of(30.0, narrowed(1.7, 15.0, 10.0, least)), tube_of(40.0, 1.5, 0),
                      tube_of(30.0, 0.9, 0)};
  network.branches[0].name = network.branches[1].name = "LAD";
  network.branches[2].name = "D1";
  network.branches[2].angle_rad = 0.8;
  return network;
}

bool has(const TreeReadings& readings, FlowMark::Kind kind) {
  return std::any_of(readings.marks.begin(), readings.marks.end(),
                     [=](const FlowMark& m) { return m.kind == kind; });
}

TEST(Readings, ALesionIsReadBehindItOnTheLargestWay) {
  const Tree tree = tree_of(focal());
  const TreeReadings readings =
      read_tree(tree.network, tree.state, {{"S1", {0, 10.0}, {0, 15.0}, {0, 20.0}}});
  const LesionReading& lesion = readings.lesions.at(0);
  EXPECT_EQ(lesion.read_at.branch, 1u);
  EXPECT_NEAR(lesion.read_at.s_mm, 15.0, 1e-9);  // 10 mm left of the trunk, 15 of its continuation
  EXPECT_NEAR(lesion.distance_mm, 25.0, 1e-9);
  EXPECT_LT(lesion.behind, lesion.before);
  EXPECT_NEAR(lesion.delta(), lesion.before - lesion.behind, 1e-15);
  EXPECT_NEAR(lesion.behind, pressure_at(tree.network, readings, lesion.read_at) / readings.aortic_pa, 1e-12);
}

TEST(Readings, WhereTheTreeEndsTheDistanceSaysSo) {
  const Tree tree = tree_of(focal());
  const TreeReadings readings =
      read_tree(tree.network, tree.state, {{"S1", {1, 20.0}, {1, 25.0}, {1, 30.0}}});
  EXPECT_NEAR(readings.lesions[0].distance_mm, 10.0, 1e-9);
  EXPECT_NEAR(readings.lesions[0].read_at.s_mm, 40.0, 1e-9);
}

TEST(Readings, ThePullbackIndexTellsFocalFromDiffuse) {
  const Tree one = tree_of(focal(0.42));
  const double sharp = read_tree(one.network, one.state, {}).pullbacks[0].ppg_index;
  Network thin;
  thin.branches = {vessel_of(80.0, [](double s) { return s < 10.0 ? 1.6 : 0.9; })};
  const Tree diffuse = tree_of(thin);
  const Pullback flat = read_tree(diffuse.network, diffuse.state, {}).pullbacks[0];
  EXPECT_GT(sharp, 0.6);
  EXPECT_LT(flat.ppg_index, 0.45);
  EXPECT_NEAR(flat.points.back().from_aorta_mm, 80.0, 1e-9);
}

TEST(Readings, AnOcclusionIsMarkedAndNotANumberNowhere) {
  Network network = focal();
  network.branches[1].stations[40].area_mm2 = 0.0;
  const Tree tree = tree_of(std::move(network));
  const TreeReadings readings =
      read_tree(tree.network, tree.state, {{"S1", {1, 15.0}, {1, 20.0}, {1, 25.0}}});
  EXPECT_TRUE(readings.lesions[0].occluded);
  ASSERT_TRUE(has(readings, FlowMark::Kind::occlusion));
  for (std::size_t b = 0; b < tree.network.size(); ++b)
    for (std::size_t i = 0; i < readings.stations[b].size(); ++i)
      EXPECT_TRUE(std::isfinite(readings.ratio(b, i)));
}

TEST(Readings, MarksWhereTheModelDoesNotHold) {
  Network wide = focal();
  wide.branches[1] = vessel_of(40.0, narrowed(1.5, 20.0, 10.0, 2.2), 0);
  Tree tree = tree_of(std::move(wide));
  EXPECT_TRUE(has(read_tree(tree.network, tree.state, {}), FlowMark::Kind::ectasia));
  tree = tree_of(focal(0.15));
  const TreeReadings narrow = read_tree(tree.network, tree.state, {});
  EXPECT_TRUE(has(narrow, FlowMark::Kind::narrow));
  Network graft = focal();
  graft.branches[2].name = "SVG to OM1";
  tree = tree_of(std::move(graft));
  const TreeReadings readings = read_tree(tree.network, tree.state, {});
  ASSERT_TRUE(has(readings, FlowMark::Kind::graft));
  EXPECT_TRUE(std::any_of(readings.marks.begin(), readings.marks.end(), [](const FlowMark& mark) {
    return mark.kind == FlowMark::Kind::graft && mark.text.find("graft") != std::string::npos;
  }));
  Tree healthy = tree_of(focal(0.9));
  EXPECT_TRUE(read_tree(healthy.network, healthy.state, {}).marks.empty());
}

TEST(Readings, RefusesBadOptions) {
  const Tree tree = tree_of(focal());
  ReadingOptions options;
  options.behind_mm = 100.0;
  EXPECT_THROW(read_tree(tree.network, tree.state, {}, options), InvalidInput);
  EXPECT_THROW(read_tree(tree.network, tree.state, {{"S1", {9, 0.0}, {9, 0.0}, {9, 0.0}}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::hemodynamics
