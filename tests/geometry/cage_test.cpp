#include "ostia/geometry/cage.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::geometry {
namespace {

std::vector<Vec3> random_points(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-size, size);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = Vec3(unit(random), 2.0 * unit(random), unit(random));
  return points;
}

std::vector<Vec3> shaken(std::vector<Vec3> points, double by, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-by, by);
  for (Vec3& p : points) p += Vec3(unit(random), unit(random), unit(random));
  return points;
}

TEST(Cage, AtRestCarriesNothing) {
  const std::vector<Vec3> points = random_points(500, 20.0, 1);
  const CageGrid grid = cage_around(points, 4);
  EXPECT_EQ(grid.cells, 16);
  EXPECT_EQ(grid.point_count(), 4913U);  // as in [Yi] 5.1.2
  const std::vector<Vec3> rest = rest_points(grid);
  for (const Vec3& p : points) EXPECT_NEAR((carried(grid, cage_point(grid, p), rest) - p).norm(), 0.0, 1e-12);
}

TEST(Cage, CarriesAffineMapsExactly) {
  const std::vector<Vec3> points = random_points(100, 20.0, 2);
  const CageGrid grid = cage_around(points, 3);
  Mat3 a;
  a << 1.1, 0.2, 0.0, -0.1, 0.9, 0.3, 0.05, 0.0, 1.2;
  std::vector<Vec3> moved = rest_points(grid);
  for (Vec3& p : moved) p = a * p + Vec3(1, 2, 3);
  for (const Vec3& p : points)
    EXPECT_NEAR((carried(grid, cage_point(grid, p), moved) - (a * p + Vec3(1, 2, 3))).norm(), 0.0, 1e-11);
}

TEST(Cage, RefiningChangesNothing) {
  const std::vector<Vec3> points = random_points(300, 10.0, 3);
  const CageGrid coarse = cage_around(points, 2), fine = refined(coarse);
  const std::vector<Vec3> moved = shaken(rest_points(coarse), 1.0, 4);
  const std::vector<Vec3> moved_fine = refined(coarse, moved);
  for (const Vec3& p : points)
    EXPECT_NEAR(
        (carried(coarse, cage_point(coarse, p), moved) - carried(fine, cage_point(fine, p), moved_fine))
            .norm(),
        0.0, 1e-12);
}

TEST(Cage, PointsOutsideGoWithTheNearestInside) {
  CageGrid grid;
  grid.cells = 2;
  const CagePoint p = cage_point(grid, Vec3(-5, 1.5, 9));
  EXPECT_NEAR((carried(grid, p, rest_points(grid)) - Vec3(0, 1.5, 2)).norm(), 0.0, 1e-14);
}

TEST(Cage, JacobianBoundsHoldEverywhereInside) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    CageGrid grid;
    grid.cell_mm = Vec3(1.0, 2.0, 0.5);
    const std::vector<Vec3> moved = shaken(rest_points(grid), seed % 2 == 0 ? 0.15 : 0.6, seed);
    std::array<Vec3, 8> corners;
    std::copy(moved.begin(), moved.end(), corners.begin());
    const auto [least, most] = jacobian_bounds(corners, grid.cell_mm);
    double seen_least = 1e9, seen_most = -1e9;
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j <= 8; ++j)
        for (int k = 0; k <= 8; ++k) {
          const Vec3 p = grid.cell_mm.cwiseProduct(Vec3(i, j, k) / 8.0);
          Mat3 d;
          for (int axis = 0; axis < 3; ++axis) {  // central differences of a map linear along each axis
            Vec3 a = p, b = p;
            a[axis] = 0.0;
            b[axis] = grid.cell_mm[axis];
            d.col(axis) =
                (carried(grid, cage_point(grid, b), moved) - carried(grid, cage_point(grid, a), moved)) /
                grid.cell_mm[axis];
          }
          seen_least = std::min(seen_least, d.determinant());
          seen_most = std::max(seen_most, d.determinant());
        }
    EXPECT_LE(least, seen_least + 1e-12);
    EXPECT_GE(most, seen_most - 1e-12);
    EXPECT_GE(least, seen_least - 0.8 * (seen_most - seen_least) - 1e-9);  // and are no loose ones
  }
}

TEST(Cage, AnInvertedCellHasNoPositiveBound) {
  CageGrid grid;
  std::array<Vec3, 8> corners;
  for (std::int32_t i = 0; i < 8; ++i) corners[static_cast<std::size_t>(i)] = grid.place(i);
  EXPECT_NEAR(jacobian_bounds(corners, grid.cell_mm)[0], 1.0, 1e-15);
  corners[7] = Vec3(-0.2, -0.2, -0.2);
  EXPECT_LT(jacobian_bounds(corners, grid.cell_mm)[0], 0.0);
}

TEST(Cage, RefusesWhatItCannotBeAround) {
  EXPECT_THROW(cage_around({}, 2), InvalidInput);
  EXPECT_THROW(cage_around({Vec3(0, 0, std::nan(""))}, 2), InvalidInput);
  EXPECT_THROW(cage_around({Vec3::Zero()}, 9), InvalidInput);
  EXPECT_THROW(cage_around({Vec3::Zero()}, 2, -1.0), InvalidInput);
  EXPECT_GT(cage_around({Vec3::Zero()}, 2).cell_mm.minCoeff(), 0.0);
}

}  // namespace
}  // namespace ostia::geometry
