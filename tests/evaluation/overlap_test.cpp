#include "ostia/evaluation/overlap.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::evaluation {
namespace {

using imaging::FloatVolume;
using imaging::MaskVolume;
using imaging::Vec3;

imaging::Geometry grid() {
  imaging::Geometry g;
  g.size = {20, 18, 16};
  g.spacing = Vec3(0.5, 0.6, 0.7);
  g.origin = Vec3(-4, -4, -4);
  return g;
}

MaskVolume slab(std::int64_t from, std::int64_t to) {
  MaskVolume mask{grid(), std::vector<std::uint8_t>(static_cast<std::size_t>(grid().voxels()), 0)};
  for (std::int64_t k = 0; k < 16; ++k) {
    for (std::int64_t j = 0; j < 18; ++j) {
      for (std::int64_t i = from; i < to; ++i) mask(i, j, k) = 3;
    }
  }
  return mask;
}

TEST(Dice, CountsSharedVoxels) {
  EXPECT_DOUBLE_EQ(dice(slab(0, 10), slab(0, 10)), 1.0);
  EXPECT_DOUBLE_EQ(dice(slab(0, 10), slab(5, 15)), 0.5);
  EXPECT_DOUBLE_EQ(dice(slab(0, 5), slab(10, 15)), 0.0);
}

TEST(Dice, CountsOnlyWhereItIsAsked) {
  const auto right = [](const Vec3& p) { return p.x() > -4 + 0.5 * 4.5; };
  EXPECT_DOUBLE_EQ(dice(slab(0, 10), slab(5, 10), right), 1.0);
}

TEST(Dice, RefusesDifferentGridsAndNothing) {
  MaskVolume other = slab(0, 5);
  other.geometry.origin.x() += 1.0;
  EXPECT_THROW(dice(slab(0, 5), other), InvalidInput);
  EXPECT_THROW(dice(slab(0, 0), slab(0, 0)), InvalidInput);
}

TEST(MaskOf, HoldsTheVoxelsInside) {
  FloatVolume phi{grid(), std::vector<float>(static_cast<std::size_t>(grid().voxels()))};
  imaging::Geometry larger = grid();
  larger.size = {40, 18, 16};
  std::int64_t expected = 0;
  for (std::int64_t k = 0; k < 16; ++k) {
    for (std::int64_t j = 0; j < 18; ++j) {
      for (std::int64_t i = 0; i < 20; ++i) {
        const Vec3 p =
            phi.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        phi(i, j, k) = static_cast<float>(p.norm() - 2.05);
        expected += p.norm() < 2.05;
      }
    }
  }
  const MaskVolume mask = mask_of(phi, larger);
  std::int64_t inside = 0;
  for (const std::uint8_t v : mask.voxels) inside += v;
  EXPECT_EQ(inside, expected);
  EXPECT_EQ(mask(30, 5, 5), 0);
}

}  // namespace
}  // namespace ostia::evaluation
