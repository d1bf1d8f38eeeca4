#include "line_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace ostia::centerline::detail {
namespace {

using geometry::Vec3;

std::vector<Vec3> coil(int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double t = 0.02 * i;
    points.emplace_back(5.0 * std::cos(t), 5.0 * std::sin(t), 0.3 * t);
  }
  return points;
}

/// The first of the nearest, asked one by one.
std::int32_t nearest_of_all(const std::vector<Vec3>& points, const Vec3& query, double within_squared) {
  std::int32_t best = -1;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double squared = (points[i] - query).squaredNorm(); squared < within_squared) {
      within_squared = squared;
      best = static_cast<std::int32_t>(i);
    }
  return best;
}

TEST(LinePoints, find_what_asking_each_point_finds_wherever_they_begin) {
  for (const int count : {1, 15, 16, 17, 256, 257, 1900}) {
    const std::vector<Vec3> points = coil(count);
    const LinePoints line(points);
    std::size_t run = 0;
    for (int k = 0; k < 400; ++k) {
      const Vec3 query(6.0 * std::sin(0.7 * k), 6.0 * std::cos(0.31 * k), 0.03 * k - 1.0);
      for (const double within : {1.0, 25.0, std::numeric_limits<double>::infinity()}) {
        const std::int32_t expected = nearest_of_all(points, query, within);
        ASSERT_EQ(line.nearest(query, within, run), expected) << count << " points, query " << k;
        std::size_t beyond_all = 1000;
        ASSERT_EQ(line.nearest(query, within, beyond_all), expected);
      }
    }
  }
}

TEST(LinePoints, of_equally_near_ones_give_the_first) {
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) points.emplace_back(i % 2 == 0 ? 1.0 : -1.0, 0.0, 0.0);
  const LinePoints line(points);
  for (std::size_t begin : {0u, 3u, 6u}) EXPECT_EQ(line.nearest(Vec3(0.0, 2.0, 0.0), 100.0, begin), 0);
}

}  // namespace
}  // namespace ostia::centerline::detail
