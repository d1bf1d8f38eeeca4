#include "level_set/sparse_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::segmentation::detail {
namespace {

using geometry::Vec3;

imaging::FloatVolume sphere(double radius, const Vec3& spacing, const std::array<std::int64_t, 3>& size) {
  imaging::FloatVolume out;
  out.geometry.size = size;
  out.geometry.spacing = spacing;
  out.voxels.resize(static_cast<std::size_t>(out.geometry.voxels()));
  const Vec3 centre = out.geometry.world(Vec3(size[0] - 1.0, size[1] - 1.0, size[2] - 1.0) * 0.5);
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        out(i, j, k) =
            static_cast<float>((out.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j),
                                                        static_cast<double>(k))) -
                                centre)
                                   .norm() -
                               radius);
  return out;
}

TEST(SparseField, LayersCarryTheDistanceInTheSpacingOfEachAxis) {
  const auto exact = sphere(6.0, Vec3(0.5, 0.5, 0.8), {40, 40, 30});
  const SparseField field(exact);
  ASSERT_GT(field.active().size(), 500U);
  double worst = 0.0;
  double sum = 0.0;
  std::size_t seen = 0;
  for (std::size_t n = 0; n < exact.voxels.size(); ++n) {
    EXPECT_EQ(field.values()[n] < 0.0F, exact.voxels[n] < 0.0F);
    if (std::abs(exact.voxels[n]) > 0.9) continue;
    ++seen;
    const double error = std::abs(static_cast<double>(field.values()[n]) - exact.voxels[n]);
    worst = std::max(worst, error);
    sum += error;
  }
  EXPECT_GT(seen, 2000U);
  EXPECT_LT(worst, 0.4);  // half a voxel of the coarse axis
  EXPECT_LT(sum / static_cast<double>(seen), 0.08);
}

TEST(SparseField, MovingOutBySteadyStepsKeepsTheShape) {
  SparseField field(sphere(6.0, Vec3::Constant(0.5), {50, 50, 50}));
  for (int step = 0; step < 16; ++step)
    field.advance(std::vector<float>(field.active().size(), -0.125F));  // 2 mm in all
  const auto exact = sphere(8.0, Vec3::Constant(0.5), {50, 50, 50});
  double sum = 0.0;
  for (const std::int64_t n : field.active())
    sum += std::abs(field.value(n) - exact.voxels[static_cast<std::size_t>(n)]);
  EXPECT_LT(sum / static_cast<double>(field.active().size()), 0.1);
}

TEST(SparseField, TheRimOfTheGridIsOutside) {
  const SparseField field(sphere(30.0, Vec3::Ones(), {12, 12, 12}));  // covers the grid
  EXPECT_GT(field.value(0), 0.0F);
  EXPECT_FALSE(field.active().empty());
}

}  // namespace
}  // namespace ostia::segmentation::detail
