#include "region_builder.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::segmentation::detail {
namespace {

imaging::Geometry grid() {
  imaging::Geometry geometry;
  geometry.size = {30, 20, 20};
  geometry.spacing = Vec3(0.5, 0.6, 0.7);
  geometry.origin = Vec3(-3, 4, 5);
  return geometry;
}

TEST(RegionBuilder, KeepsThePartThatHoldsBothSeeds) {
  BlockGrid<float> values(grid().size, 1.0F);
  for (std::int32_t i = 3; i < 20; ++i) values.at(Voxel{i, 10, 10}) = -0.5F;
  values.at(Voxel{5, 14, 10}) = -0.5F;
  RegionBuilder builder(grid());
  EXPECT_FALSE(builder.add_connected(values, Voxel{3, 10, 10}, Voxel{5, 14, 10}));
  EXPECT_TRUE(builder.add_connected(values, Voxel{3, 10, 10}, Voxel{19, 10, 10}));
  const InitialRegion region = builder.finish(2);
  EXPECT_EQ(region.voxels, 17);
  EXPECT_EQ(region.region.lower, (std::array<std::int64_t, 3>{1, 8, 8}));
  EXPECT_EQ(region.region.upper, (std::array<std::int64_t, 3>{22, 13, 13}));
  EXPECT_FALSE(region.touches_border);
  EXPECT_TRUE(region.level_set.geometry.origin.isApprox(grid().world(Vec3(1, 8, 8))));
  EXPECT_EQ(region.level_set(2, 2, 2), -0.5F);
  EXPECT_GT(region.level_set(4, 5, 2), 0.0F);
}

TEST(RegionBuilder, FillsPitsButNothingConvex) {
  RegionBuilder builder(grid());
  for (std::int32_t k = 5; k < 10; ++k) {
    for (std::int32_t j = 5; j < 10; ++j) {
      for (std::int32_t i = 5; i < 10; ++i) {
        if (i == 7 && j == 7 && k >= 7) continue;  // a shaft three voxels deep
        builder.add(Voxel{i, j, k}, -1.0F);
      }
    }
  }
  EXPECT_EQ(builder.finish(1).voxels, 125);
}

TEST(RegionBuilder, SeesTheBorderAndRefusesNothing) {
  RegionBuilder builder(grid());
  EXPECT_THROW(builder.finish(1), GeometryError);
  builder.add(Voxel{0, 5, 5}, -1.0F);
  EXPECT_TRUE(builder.finish(1).touches_border);
}

}  // namespace
}  // namespace ostia::segmentation::detail
