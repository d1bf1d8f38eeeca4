#include "grid_matrix.h"

#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::motion {
namespace {

using geometry::Mat3;
using geometry::Vec3;
using Neighbours = std::vector<std::array<std::int32_t, GridMatrix::row_blocks>>;

constexpr std::size_t count = 300;

/// Points in a row along x.
Neighbours row_of_points() {
  Neighbours neighbours(count);
  for (std::size_t i = 0; i < count; ++i) {
    neighbours[i].fill(-1);
    neighbours[i][GridMatrix::diagonal] = static_cast<std::int32_t>(i);
    if (i > 0) neighbours[i][block_at(-1, 0, 0)] = static_cast<std::int32_t>(i) - 1;
    if (i + 1 < count) neighbours[i][block_at(1, 0, 0)] = static_cast<std::int32_t>(i) + 1;
  }
  return neighbours;
}

/// -x'' by differences with both ends held, times a symmetric matrix that couples the axes.
GridMatrix second_differences(const Neighbours& neighbours) {
  Mat3 axes;
  axes << 4.0, 1.0, 0.0, 1.0, 3.0, -1.0, 0.0, -1.0, 5.0;
  GridMatrix matrix(neighbours);
  for (std::size_t i = 0; i < count; ++i) {
    Mat3* row = &matrix.blocks[GridMatrix::row_blocks * i];
    row[GridMatrix::diagonal] = 2.0 * axes;
    if (i > 0) row[block_at(-1, 0, 0)] = -axes;
    if (i + 1 < count) row[block_at(1, 0, 0)] = -axes;
  }
  return matrix;
}

/// What the matrix makes of x(i) = sin(pi (i + 1) / (count + 1)) along `way`: its eigenvector.
std::vector<Vec3> image_of_wave(const Vec3& way, std::vector<Vec3>& wave) {
  const double turn = std::acos(-1.0) / static_cast<double>(count + 1);
  Mat3 axes;
  axes << 4.0, 1.0, 0.0, 1.0, 3.0, -1.0, 0.0, -1.0, 5.0;
  std::vector<Vec3> image;
  for (std::size_t i = 0; i < count; ++i) {
    wave.push_back(std::sin(turn * static_cast<double>(i + 1)) * way);
    image.push_back((2.0 - 2.0 * std::cos(turn)) * (axes * wave.back()));
  }
  return image;
}

TEST(GridMatrix, ItsEquationsAreSolved) {
  const Neighbours neighbours = row_of_points();
  std::vector<Vec3> wave;
  const std::vector<Vec3> right = image_of_wave({1.0, -2.0, 0.5}, wave);
  const std::vector<Vec3> found = solved(second_differences(neighbours), right, 1e-10, 5000);
  for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR((found[i] - wave[i]).norm(), 0.0, 1e-6);
}

TEST(GridMatrix, OfNothingNothingComes) {
  const Neighbours neighbours = row_of_points();
  const std::vector<Vec3> right(count, Vec3::Zero());
  EXPECT_EQ(solved(second_differences(neighbours), right, 1e-6, 100), right);
}

TEST(GridMatrix, DoesNotDependOnThreads) {
  const Neighbours neighbours = row_of_points();
  std::vector<Vec3> right;
  for (std::size_t i = 0; i < count; ++i)
    right.emplace_back(std::sin(7.0 * static_cast<double>(i)), std::cos(3.0 * static_cast<double>(i)), 1.0);
  const GridMatrix matrix = second_differences(neighbours);
  core::set_max_threads(1);
  const std::vector<Vec3> one = solved(matrix, right, 1e-4, 200);
  core::set_max_threads(0);
  EXPECT_EQ(one, solved(matrix, right, 1e-4, 200));
}

}  // namespace
}  // namespace ostia::motion
