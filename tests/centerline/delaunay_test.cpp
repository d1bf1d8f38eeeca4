#include "ostia/centerline/delaunay.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>

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

/// Of small whole coordinates: no product is rounded. Positive where the last point is inside the sphere.
std::int64_t inside_by(const std::vector<Vec3>& p, const std::array<std::int32_t, 4>& cell,
                       const Vec3& point) {
  std::array<std::array<std::int64_t, 4>, 4> rows{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 edge = p[static_cast<std::size_t>(cell[k])] - point;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto whole = static_cast<std::int64_t>(edge[i]);
      rows[k][static_cast<std::size_t>(i)] = whole;
      rows[k][3] += whole * whole;
    }
  }
  const auto minor = [&](std::size_t a, std::size_t b, std::size_t c) {
    const auto& [x, y, z] = std::tie(rows[a], rows[b], rows[c]);
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
           x[2] * (y[0] * z[1] - y[1] * z[0]);
  };
  return rows[0][3] * minor(1, 2, 3) - rows[1][3] * minor(0, 2, 3) + rows[2][3] * minor(0, 1, 3) -
         rows[3][3] * minor(0, 1, 2);
}

/// Without numbering: corners in order, cells in order.
std::vector<std::array<std::int32_t, 4>> as_set(std::vector<std::array<std::int32_t, 4>> cells) {
  for (auto& cell : cells) std::ranges::sort(cell);
  std::ranges::sort(cells);
  return cells;
}

TEST(Delaunay, is_right_and_one_alone_where_most_points_share_spheres) {
  std::mt19937 generator(11);
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> points;
    for (int corner = 0; corner < 8; ++corner)
      points.emplace_back(6 * (corner & 1), 6 * (corner >> 1 & 1), 6 * (corner >> 2 & 1));
    for (int i = 0; i < 10 + round; ++i)
      points.emplace_back(generator() % 7, generator() % 7, generator() % 7);
    std::vector<Vec3> distinct;
    for (const Vec3& p : points)
      if (std::ranges::find(distinct, p) == distinct.end()) distinct.push_back(p);
    const Delaunay cells = delaunay(distinct);
    double volume = 0.0;
    for (const auto& cell : cells.cells) {
      volume += volume6(distinct, cell);
      ASSERT_GT(volume6(distinct, cell), 0.0);
      for (const Vec3& p : distinct) ASSERT_LE(inside_by(distinct, cell, p), 0);
    }
    EXPECT_EQ(volume, 6.0 * 216.0);

    std::vector<std::int32_t> shuffled(distinct.size());
    std::iota(shuffled.begin(), shuffled.end(), 0);
    std::ranges::shuffle(shuffled, generator);
    std::vector<Vec3> other;
    for (const std::int32_t i : shuffled) other.push_back(distinct[static_cast<std::size_t>(i)]);
    std::vector<std::array<std::int32_t, 4>> renamed = delaunay(other).cells;
    for (auto& cell : renamed)
      for (std::int32_t& v : cell) v = shuffled[static_cast<std::size_t>(v)];
    EXPECT_EQ(as_set(renamed), as_set(cells.cells));
  }
}

// The last point's hollow has hundreds of faces: all cells but those about the middle go through it.
TEST(Delaunay, fills_a_wide_hollow) {
  std::vector<Vec3> points;
  for (Vec3 p : random_points(700)) points.push_back((p - Vec3::Constant(0.5)).normalized());
  points.emplace_back(0.0, 0.0, 0.0);
  const Delaunay cells = delaunay(points);
  std::size_t at_the_middle = 0;
  double volume = 0.0;
  for (const auto& cell : cells.cells) {
    at_the_middle += std::ranges::count(cell, 700) == 1;
    volume += volume6(points, cell) / 6.0;
  }
  EXPECT_EQ(at_the_middle, 2u * 700u - 4u);  // Euler: the faces of the hull
  EXPECT_EQ(cells.cells.size(), at_the_middle);
  EXPECT_LT(volume, 4.0 / 3.0 * M_PI);  // flat faces under a sphere
  EXPECT_GT(volume, 0.97 * 4.0 / 3.0 * M_PI);
}

TEST(Delaunay, takes_very_small_and_very_large_coordinates) {
  for (const double scale : {1e-110, 1e-30, 1e30, 1e60}) {
    std::vector<Vec3> points = random_points(100);
    const std::vector<std::array<std::int32_t, 4>> plain = as_set(delaunay(points).cells);
    const double power_of_two = std::exp2(std::round(std::log2(scale)));  // rounds nothing
    for (Vec3& p : points) p *= power_of_two;
    EXPECT_EQ(as_set(delaunay(points).cells), plain) << scale;
  }
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
