#include "ostia/imaging/volume.h"

#include "image_files.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {
using testing::oblique_grid;

TEST(Geometry, WorldAndIndexAreInverse) {
  const Geometry grid = oblique_grid(5, 6, 7);
  const Vec3 index(1.25, 3.5, -2.0);
  EXPECT_LT((grid.index(grid.world(index)) - index).norm(), 1e-12);
}

TEST(Geometry, FollowsItsDefinition) {
  const Geometry grid = oblique_grid(5, 6, 7);
  const Vec3 expected = grid.origin + 2.0 * 0.5 * grid.direction.col(0) + 3.0 * 0.7 * grid.direction.col(1) +
                        4.0 * 1.1 * grid.direction.col(2);
  EXPECT_LT((grid.world({2, 3, 4}) - expected).norm(), 1e-12);
  EXPECT_EQ(grid.offset(2, 3, 4), 2 + 5 * (3 + 6 * 4));
}

TEST(Geometry, ContainsHalfAVoxelMoreThanTheCentres) {
  const Geometry grid = oblique_grid(5, 6, 7);
  EXPECT_TRUE(grid.contains(grid.world({-0.49, 0, 0})));
  EXPECT_FALSE(grid.contains(grid.world({-0.51, 0, 0})));
  EXPECT_TRUE(grid.contains(grid.world({0, 0, 6.49})));
  EXPECT_FALSE(grid.contains(grid.world({0, 0, 6.51})));
  EXPECT_FALSE(grid.contains(Vec3::Constant(std::nan(""))));
}

TEST(SameGrid, ComparesCornersInMillimetres) {
  const Geometry grid = oblique_grid(50, 60, 70);
  Geometry other = grid;
  other.origin[0] += 5e-4;
  EXPECT_TRUE(same_grid(grid, other));
  other.origin[0] += 1e-3;
  EXPECT_FALSE(same_grid(grid, other));
  other = grid;
  other.spacing[2] += 1e-4;  // 7 um at the far end
  EXPECT_FALSE(same_grid(grid, other));
  other = grid;
  other.size[1] = 59;
  EXPECT_FALSE(same_grid(grid, other));
}

TEST(Cropped, KeepsEachVoxelAtItsPlace) {
  const ImageVolume image = testing::patterned<std::int16_t>(oblique_grid(6, 5, 4));
  const ImageVolume part = cropped(image, {{1, 2, 1}, {5, 4, 4}});
  ASSERT_EQ(part.geometry.size, (std::array<std::int64_t, 3>{4, 2, 3}));
  for (std::int64_t k = 0; k < 3; ++k)
    for (std::int64_t j = 0; j < 2; ++j)
      for (std::int64_t i = 0; i < 4; ++i) EXPECT_EQ(part(i, j, k), image(i + 1, j + 2, k + 1));
  EXPECT_LT((part.geometry.world({0, 0, 0}) - image.geometry.world({1, 2, 1})).norm(), 1e-12);
}

TEST(Cropped, RefusesEmptyAndOutside) {
  const ImageVolume image = testing::patterned<std::int16_t>(oblique_grid(6, 5, 4));
  EXPECT_THROW(cropped(image, {{1, 2, 1}, {1, 4, 4}}), InvalidInput);
  EXPECT_THROW(cropped(image, {{-1, 2, 1}, {3, 4, 4}}), InvalidInput);
  EXPECT_THROW(cropped(image, {{1, 2, 1}, {3, 4, 5}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::imaging
