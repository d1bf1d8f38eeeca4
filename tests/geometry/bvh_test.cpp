#include "bvh.h"

#include "test_meshes.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace ostia::geometry::detail {
namespace {

std::vector<BvhBox> boxes_of(const std::vector<Vec3>& lower, double width) {
  std::vector<BvhBox> boxes(lower.size(), BvhBox::nothing());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].extend(lower[i].data());
    boxes[i].extend(Vec3(lower[i] + Vec3::Constant(width)).data());
  }
  return boxes;
}

bool holds(const BvhBox& outer, const BvhBox& inner) {
  for (int a = 0; a < 3; ++a) {
    if (inner.lower[a] < outer.lower[a] || inner.upper[a] > outer.upper[a]) return false;
  }
  return true;
}

/// Walks the tree, checks that boxes hold what is below, and returns the depth.
int check(const Bvh& bvh, const std::vector<BvhBox>& boxes, std::size_t node, std::vector<int>& seen) {
  const BvhNode& n = bvh.nodes[node];
  if (n.count > 0) {
    for (std::int32_t place = n.next; place < n.next + n.count; ++place) {
      const auto item = static_cast<std::size_t>(bvh.order[static_cast<std::size_t>(place)]);
      ++seen[item];
      EXPECT_TRUE(holds(n.box, boxes[item]));
    }
    return 1;
  }
  const auto right = static_cast<std::size_t>(n.next);
  EXPECT_TRUE(holds(n.box, bvh.nodes[node + 1].box));
  EXPECT_TRUE(holds(n.box, bvh.nodes[right].box));
  return 1 + std::max(check(bvh, boxes, node + 1, seen), check(bvh, boxes, right, seen));
}

void expect_sound(const std::vector<BvhBox>& boxes, int deepest) {
  const Bvh bvh = build_bvh(boxes);
  std::vector<int> seen(boxes.size(), 0);
  EXPECT_LE(check(bvh, boxes, 0, seen), deepest);
  EXPECT_THAT(seen, ::testing::Each(1));
}

TEST(Bvh, HoldsEveryItemOnce) {
  expect_sound(boxes_of(test::random_points(1, 1.0, 1), 0.1), 1);
  expect_sound(boxes_of(test::random_points(5000, 1.0, 2), 0.1), 30);
  expect_sound(boxes_of(std::vector<Vec3>(5000, Vec3(1, 2, 3)), 0.1), 12);  // nothing to split by
  EXPECT_TRUE(build_bvh({}).nodes.empty());
}

TEST(Bvh, DepthStaysWithinTheTraversalStacks) {
  // Each point a tenth as far out as the one before: the heuristic would peel them off a few at a time.
  std::vector<Vec3> points;
  double x = 1e300;
  for (int i = 0; i < 600; ++i, x *= 0.1) points.emplace_back(x, 0, 0);
  expect_sound(boxes_of(points, 0.0), bvh_stack_size);
}

TEST(Bvh, DistanceAndOverlapOfBoxes) {
  const BvhBox box = boxes_of({{0, 0, 0}}, 1.0)[0];
  EXPECT_EQ(box.squared_distance({0.5, 0.5, 0.5}), 0.0);
  EXPECT_EQ(box.squared_distance({3, 0.5, -1}), 5.0);
  EXPECT_TRUE(box.overlaps(boxes_of({{1, 1, 1}}, 1.0)[0]));  // touching counts
  EXPECT_FALSE(box.overlaps(boxes_of({{0, 1.1, 0}}, 1.0)[0]));
}

}  // namespace
}  // namespace ostia::geometry::detail
