#include "support/masks.h"

#include "ostia/centerline/skeleton_edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::centerline {
namespace {

SkeletonGraph one_line(const std::vector<Vec3>& points) {
  SkeletonGraph graph;
  graph.nodes = {{0, points.front(), SkeletonNodeKind::end, 1.0},
                 {1, points.back(), SkeletonNodeKind::end, 1.0}};
  graph.edges = {{0, 0, 1, points, std::vector<double>(points.size(), 1.0)}};
  return graph;
}

Vec3 helix(double t) {
  return {6.0 * std::cos(t), 6.0 * std::sin(t), 4.0 * t};
}

TEST(Smoothed, StepsOfVoxelsGoAndTheCurveComesOut) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 160; ++i) {
    const Vec3 p = helix(0.03 * i);
    const Vec3 voxel(std::round(p.x() / 0.6) * 0.6, std::round(p.y() / 0.6) * 0.6,
                     std::round(p.z() / 0.6) * 0.6);
    if (points.empty() || (voxel - points.back()).norm() > 0.0) points.push_back(voxel);
  }
  const SkeletonGraph before = one_line(points);
  const SkeletonGraph after = smoothed(before);
  const double truth = 0.03 * 160.0 * std::hypot(6.0, 4.0);
  EXPECT_GT(length_mm(before.edges[0]), 1.1 * truth);
  EXPECT_NEAR(length_mm(after.edges[0]), truth, 0.015 * truth);
  EXPECT_EQ(after.edges[0].points.front(), points.front());
  EXPECT_EQ(after.edges[0].points.back(), points.back());
  double worst = 0.0;
  for (const Vec3& p : after.edges[0].points) {
    double best = 1e9;
    for (int i = 0; i <= 1600; ++i) best = std::min(best, (helix(0.003 * i) - p).norm());
    worst = std::max(worst, best);
  }
  EXPECT_LT(worst, 0.55);
}

TEST(Smoothed, AStraightLineStays) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 40; ++i) points.emplace_back(0.5 * i, 0.0, 0.25 * i);
  const SkeletonGraph straight = smoothed(one_line(points), {.knot_spacing_mm = 3.0, .step_mm = 0.0});
  ASSERT_EQ(straight.edges[0].points.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((straight.edges[0].points[i] - points[i]).norm(), 1e-6);
}

TEST(Smoothed, CloserKnotsFollowMoreClosely) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 120; ++i) points.push_back({0.25 * i, 1.5 * std::sin(0.25 * i), 0.0});
  const auto worst = [&](double spacing) {
    const SkeletonGraph graph = smoothed(one_line(points), {.knot_spacing_mm = spacing, .step_mm = 0.0});
    double most = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      most = std::max(most, (graph.edges[0].points[i] - points[i]).norm());
    return most;
  };
  EXPECT_LT(worst(1.5), 0.12);
  EXPECT_GT(worst(15.0), 0.8);
}

TEST(Smoothed, BifurcationsStay) {
  const auto mask = test::random_blobs(9, 32);
  const SkeletonGraph before = skeleton_graph(thinned(mask, {.fill_cavities = true}));
  const SkeletonGraph after = smoothed(before);
  EXPECT_EQ(find_fault(after), std::nullopt);
  ASSERT_EQ(after.nodes.size(), before.nodes.size());
  for (std::size_t i = 0; i < before.nodes.size(); ++i)
    if (before.nodes[i].kind != SkeletonNodeKind::loop_anchor) {
      EXPECT_EQ(after.nodes[i].position, before.nodes[i].position);
    }
  EXPECT_EQ(loop_count(after), loop_count(before));
}

}  // namespace
}  // namespace ostia::centerline
