#include "ostia/geometry/vessel_tree.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::geometry {
namespace {

TreeSegment straight(std::int32_t id, const TreeNode& from, const TreeNode& to) {
  TreeSegment s{id, from.id, to.id, {}};
  for (int i = 0; i <= 4; ++i)
    s.axis.points.push_back(from.position + 0.25 * i * (to.position - from.position));
  s.axis.radius.assign(5, 1.0 + 0.1 * id);
  complete(s.axis);
  return s;
}

// A trunk that splits in two; ids on purpose neither from 0 nor in order.
VesselTree y_tree() {
  VesselTree tree;
  tree.nodes = {{10, Vec3(0, 0, 0)}, {7, Vec3(10, 0, 0)}, {30, Vec3(16, 6, 0)}, {4, Vec3(16, -6, 3)}};
  tree.segments = {straight(3, tree.nodes[0], tree.nodes[1]), straight(9, tree.nodes[1], tree.nodes[2]),
                   straight(1, tree.nodes[1], tree.nodes[3])};
  tree.vessels = {{1, "LAD", {3, 9}}, {2, "LCX", {3, 1}}};
  return tree;
}

TEST(VesselTree, FindsByIdAndRefusesUnknown) {
  const VesselTree tree = y_tree();
  EXPECT_EQ(node(tree, 30).position, Vec3(16, 6, 0));
  EXPECT_EQ(segment(tree, 9).from, 7);
  EXPECT_THROW(node(tree, 0), InvalidInput);
  EXPECT_THROW(segment(tree, 2), InvalidInput);
}

TEST(VesselTree, RootsAndEnds) {
  const VesselTree tree = y_tree();
  EXPECT_EQ(roots(tree), std::vector<std::int32_t>{10});
  EXPECT_EQ(ends(tree), (std::vector<std::int32_t>{30, 4}));
}

TEST(VesselTree, VesselAxisJoinsSegmentsWithSharedPointsOnce) {
  const VesselTree tree = y_tree();
  const Centerline axis = vessel_axis(tree, tree.vessels[0]);
  ASSERT_EQ(axis.size(), 9u);
  EXPECT_EQ(axis.points.front(), Vec3(0, 0, 0));
  EXPECT_EQ(axis.points[4], Vec3(10, 0, 0));
  EXPECT_EQ(axis.points.back(), Vec3(16, 6, 0));
  EXPECT_NEAR(axis.abscissa.back(), 10.0 + std::sqrt(72.0), 1e-12);
  EXPECT_EQ(axis.radius.size(), 9u);
  EXPECT_EQ(axis.frames.size(), 9u);
  // Both vessels start with the frame of the segment they share.
  const Centerline other = vessel_axis(tree, tree.vessels[1]);
  EXPECT_LT((other.frames[0].normal - axis.frames[0].normal).norm(), 1e-12);
}

TEST(VesselTree, SoundTreeHasNoFault) {
  EXPECT_EQ(find_fault(y_tree()), std::nullopt);
}

TEST(VesselTree, EmptyTreeHasNoFault) {
  EXPECT_EQ(find_fault(VesselTree{}), std::nullopt);
}

template <class Damage>
void expect_fault(const Damage& damage, const std::string& words) {
  VesselTree tree = y_tree();
  damage(tree);
  const std::optional<std::string> fault = find_fault(tree);
  ASSERT_TRUE(fault.has_value()) << "expected: " << words;
  EXPECT_NE(fault->find(words), std::string::npos) << *fault;
}

TEST(VesselTree, FindsEachFault) {
  expect_fault([](VesselTree& t) { t.nodes[1].id = 10; }, "two nodes");
  expect_fault([](VesselTree& t) { t.segments[1].id = 3; }, "two segments");
  expect_fault([](VesselTree& t) { t.vessels[1].id = 1; }, "two vessels");
  expect_fault([](VesselTree& t) { t.segments[2].to = 99; }, "unknown node 99");
  expect_fault([](VesselTree& t) { t.segments[2].to = 7; }, "returns to its own node");
  expect_fault([](VesselTree& t) { t.segments[2].to = 30; }, "both lead to node 30");
  expect_fault([](VesselTree& t) { t.nodes[0].position.x() += 0.1; }, "does not begin at its node");
  expect_fault([](VesselTree& t) { t.nodes[3].position.x() += 0.1; }, "does not end at its node");
  expect_fault([](VesselTree& t) { t.segments[0].axis.radius.pop_back(); }, "differ in number");
  expect_fault([](VesselTree& t) { t.segments[0].axis.radius[2] = -1.0; }, "negative radius");
  expect_fault([](VesselTree& t) { t.segments[0].axis.points[2].x() = std::nan(""); }, "not finite");
  expect_fault([](VesselTree& t) { t.segments[0].axis.abscissa[2] = 0.0; }, "do not increase");
  expect_fault([](VesselTree& t) { t.vessels[0].segments.clear(); }, "no segments");
  expect_fault([](VesselTree& t) { t.vessels[0].segments[1] = 55; }, "unknown segment 55");
  expect_fault([](VesselTree& t) { t.vessels[0].segments = {9, 3}; }, "do not join");
  expect_fault([](VesselTree& t) { t.vessels[0].segments = {9}; }, "root");
  expect_fault(
      [](VesselTree& t) {
        for (Vessel& vessel : t.vessels) vessel.segments = {3};
      },
      "end of the tree");
}

TEST(VesselTree, AVesselMayEndWhereAnotherGoesOn) {
  VesselTree tree = y_tree();
  tree.vessels[0].segments = {3};
  EXPECT_EQ(find_fault(tree), std::nullopt);
  tree.vessels.pop_back();  // the other one
  EXPECT_TRUE(find_fault(tree).has_value());
}

TEST(VesselTree, FindsALoop) {
  VesselTree tree;
  tree.nodes = {{1, Vec3(0, 0, 0)}, {2, Vec3(5, 0, 0)}, {3, Vec3(0, 5, 0)}};
  tree.segments = {straight(1, tree.nodes[0], tree.nodes[1]), straight(2, tree.nodes[1], tree.nodes[2]),
                   straight(3, tree.nodes[2], tree.nodes[0])};
  const std::optional<std::string> fault = find_fault(tree);
  ASSERT_TRUE(fault.has_value());
  EXPECT_NE(fault->find("loop"), std::string::npos);
}

TEST(VesselTree, AxisOfABadVesselIsRefused) {
  VesselTree tree = y_tree();
  EXPECT_THROW(vessel_axis(tree, {5, "none", {}}), InvalidInput);
  EXPECT_THROW(vessel_axis(tree, {5, "none", {77}}), InvalidInput);
  tree.segments[0].axis.radius.clear();
  EXPECT_THROW(vessel_axis(tree, tree.vessels[0]), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
