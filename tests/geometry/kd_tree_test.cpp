#include "ostia/geometry/kd_tree.h"

#include "test_meshes.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace ostia::geometry {
namespace {

using test::random_points;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::int32_t> by_distance(const std::vector<Vec3>& points, const Vec3& query) {
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return (points[static_cast<std::size_t>(a)] - query).squaredNorm() <
           (points[static_cast<std::size_t>(b)] - query).squaredNorm();
  });
  return order;
}

TEST(KdTree, AgreesWithBruteForce) {
  const auto points = random_points(2000, 10.0, 1);
  const KdTree tree(points);
  for (const Vec3& query : random_points(200, 14.0, 2)) {
    auto truth = by_distance(points, query);
    EXPECT_EQ(tree.nearest(query), truth[0]);
    const auto within =
        std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return (p - query).norm() <= 3; });
    std::vector<std::int32_t> inside(truth.begin(), truth.begin() + within);
    std::sort(inside.begin(), inside.end());
    EXPECT_EQ(tree.within(query, 3.0), inside);
    truth.resize(17);
    EXPECT_EQ(tree.nearest(query, 17), truth);
  }
}

TEST(KdTree, RadiusIncludesItsSphereAndCountIsCapped) {
  const KdTree tree({{0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  EXPECT_THAT(tree.within({0, 0, 0}, 1.0), ElementsAre(0, 2, 3));
  EXPECT_THAT(tree.within({0, 0, 0}, 0.0), ElementsAre(0));
  EXPECT_THAT(tree.within({0, 9, 0}, 1.0), IsEmpty());
  EXPECT_THAT(tree.nearest({0, 0, 0}, 9), ElementsAre(0, 2, 3, 1));
  EXPECT_THAT(tree.nearest({0, 0, 0}, 0), IsEmpty());
}

TEST(KdTree, ManyEqualPointsAndMoves) {
  KdTree tree(std::vector<Vec3>(1000, Vec3(1, 2, 3)));
  EXPECT_EQ(tree.within({1, 2, 3}, 0.1).size(), 1000U);
  KdTree other({{0, 0, 0}});
  other = std::move(tree);
  EXPECT_EQ(other.points().size(), 1000U);
  EXPECT_EQ(other.nearest({5, 5, 5}, 3).size(), 3U);
}

TEST(KdTree, RefusesBadInput) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(KdTree({}), InvalidInput);
  EXPECT_THROW(KdTree({{0, 0, 0}, {0, nan, 0}}), InvalidInput);
  const KdTree tree({{0, 0, 0}});
  EXPECT_THROW(tree.nearest({nan, 0, 0}), InvalidInput);
  EXPECT_THROW(tree.within({0, 0, 0}, -1.0), InvalidInput);
  EXPECT_THROW(tree.within({0, 0, 0}, nan), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
