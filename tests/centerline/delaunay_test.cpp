#include "ostia/centerline/delaunay.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

std::vector<Vec3> random_points(std::size_t count) {
  std::mt19937 generator(7);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (Eigen::Index k = 0; k < 3; ++k) p[k] = static_cast<double>(generator()) / 4294967296.0;
  return points;
}

double volume6(const std::vector<Vec3>& p, const std::array<std::int32_t, 4>& c) {
  const auto at = [&](std::size_t k) { return p[static_cast<std::size_t>(c[k])]; };
  return (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0));
}

TEST(Delaunay, fills_a_cube_exactly) {
  std::vector<Vec3> points = random_points(200);
  for (int corner = 0; corner < 8; ++corner)
    points.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
  const Delaunay cells = delaunay(points);
  double volume = 0.0;
  for (const auto& cell : cells.cells) {
    EXPECT_GT(volume6(points, cell), 0.0);
    volume += volume6(points, cell) / 6.0;
  }
  EXPECT_NEAR(volume, 1.0, 1e-12);
  EXPECT_EQ(cells.dropped_points, 0u);
}

TEST(Delaunay, circumspheres_are_empty) {
  const std::vector<Vec3> points = random_points(60);
  for (const auto& cell : delaunay(points).cells) {
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(cell[k])]; };
    Eigen::Matrix3d rows;
    Vec3 right;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Vec3 edge = at(static_cast<std::size_t>(k) + 1) - at(0);
      rows.row(k) = edge.transpose();
      right[k] = 0.5 * edge.squaredNorm();
    }
    const Vec3 centre = at(0) + rows.inverse() * right;
    const double radius = (centre - at(0)).norm();
    for (const Vec3& p : points) EXPECT_GE((p - centre).norm(), radius * (1.0 - 1e-6));
  }
}

TEST(Delaunay, neighbours_share_three_points_and_know_each_other) {
  const Delaunay cells = delaunay(random_points(100));
  std::size_t hull = 0;
  for (std::size_t c = 0; c < cells.cells.size(); ++c)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t n = cells.neighbours[c][k];
      if (n < 0) {
        ++hull;
        continue;
      }
      const auto& other = cells.cells[static_cast<std::size_t>(n)];
      std::size_t shared = 0;
      for (const std::int32_t v : cells.cells[c]) shared += std::count(other.begin(), other.end(), v) > 0;
      EXPECT_EQ(shared, 3u);
      const auto& back = cells.neighbours[static_cast<std::size_t>(n)];
      EXPECT_NE(std::find(back.begin(), back.end(), static_cast<std::int32_t>(c)), back.end());
    }
  EXPECT_GT(hull, 0u);
}

TEST(Delaunay, keeps_all_cospherical_points) {
  std::vector<Vec3> points;
  for (int ring = 0; ring < 6; ++ring)
    for (int k = 0; k < 12; ++k)
      points.emplace_back(std::cos(k * M_PI / 6.0), std::sin(k * M_PI / 6.0), static_cast<double>(ring));
  const Delaunay cells = delaunay(points);
  EXPECT_EQ(cells.dropped_points, 0u);
  std::vector<bool> used(points.size(), false);
  for (const auto& cell : cells.cells)
    for (const std::int32_t v : cell) used[static_cast<std::size_t>(v)] = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

TEST(Delaunay, counts_equal_points) {
  std::vector<Vec3> points = random_points(20);
  points.push_back(points[3]);
  points.push_back(points[4]);
  EXPECT_EQ(delaunay(points).dropped_points, 2u);
}

TEST(Delaunay, gives_the_same_cells_each_time) {
  const std::vector<Vec3> points = random_points(500);
  const Delaunay a = delaunay(points), b = delaunay(points);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.neighbours, b.neighbours);
}

TEST(Delaunay, refuses_what_spans_no_volume) {
  EXPECT_THROW(delaunay({}), GeometryError);
  EXPECT_THROW(delaunay({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}}), GeometryError);
  EXPECT_THROW(delaunay({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::quiet_NaN()}}),
               InvalidInput);
}

TEST(Delaunay, can_be_cancelled) {
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(delaunay(random_points(100), task), Cancelled);
}

}  // namespace
}  // namespace ostia::centerline
